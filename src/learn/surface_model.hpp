#pragma once

#include "learn/calibration.hpp"
#include "learn/campaign_surface.hpp"

#include <memory>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// The inputs of a campaign that can be free in a calibration: those that do not describe how the machine was
/// set. Their priors are the ranges of the surface.
std::vector<FreeParameter> surface_parameters(std::vector<atlas::SurfaceInput> const& inputs);

/// The surface of a simulated layer as a model of measured speeds, with its own uncertainty. What a
/// measurement says of the machine (frequency, amplitude, angles) chooses the place on the surface; the free
/// parameters are its other inputs.
/// @param maker  of the campaign; what it does not vary must be as in the measurements
/// @param free   whole keys among surface_parameters()
/// @param numerics  CampaignPoints::numerics of the surface's cases
/// @throws core::InputError when an input is neither free nor part of a measurement, or a measurement differs
/// from the campaign in what the campaign does not vary, or lies outside the range of the surface
CalibrationModel surface_model(std::shared_ptr<atlas::Surface const> surface,
                               scenario::CaseMaker const& maker, std::vector<std::string> const& free,
                               std::vector<MeasuredSpeed> const& speeds, double numerics);

/// The places on the surface at which a posterior lies: for each measurement those of up to 40 of its draws.
/// That is where a finer surface would help the calibration.
/// @param free  as for surface_model()
std::vector<atlas::Place> posterior_places(std::vector<atlas::SurfaceInput> const& inputs,
                                           std::vector<std::string> const& free,
                                           Calibration const& calibration,
                                           std::vector<MeasuredSpeed> const& speeds);

}  // namespace vibrotrough::learn
