#pragma once

#include "atlas/surface.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/reader/case_maker.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::learn {

/// The trend of a campaign's surface: the atlas over its whole domain if its layers are of the atlas' kind,
/// and the plastic point mass otherwise.
class CampaignTrend {
  public:
    /// @param words  values of varied keys that are words, such as grains.rotation; the same everywhere
    CampaignTrend(scenario::CaseMaker maker, std::vector<atlas::SurfaceInput> inputs,
                  std::map<std::string, scenario::Content> words);

    /// The case at a place. @throws core::InputError when there is none
    scenario::Scenario scenario_at(atlas::Place const& place) const;
    /// Velocity efficiency of the trend at a place; nothing when the atlas or the point mass has no mean
    /// speed, or the place has no case. Beyond its ranges the atlas has the value of the nearest place within
    /// them.
    std::optional<double> efficiency_at(atlas::Place const& place) const;
    /// The same of a case.
    std::optional<double> efficiency_of(prepare::PreparedCase const& prepared) const;

    /// Whether the trend is the atlas.
    bool is_atlas() const { return is_atlas_; }
    /// What is taken of the surface before its points are known. Of the difference from the atlas more is
    /// known than of that from the theory: its size, and that it varies over lengths like those of the atlas'
    /// own process.
    atlas::SurfacePrior prior() const;
    std::vector<atlas::SurfaceInput> const& inputs() const { return inputs_; }  ///< of the surface

  private:
    std::optional<atlas::Place> atlas_place_at(atlas::Place const& place) const;
    bool is_of_atlas_kind() const;

    scenario::CaseMaker maker_;
    std::vector<atlas::SurfaceInput> inputs_;
    std::map<std::string, scenario::Content> words_;
    bool is_atlas_;
};

/// Velocity efficiency of the plastic point mass of a case; nothing when it has no mean speed.
std::optional<double> theory_of(prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::learn
