#pragma once

#include "prepare/clump.hpp"
#include "prepare/domain.hpp"
#include "prepare/numerical_errors.hpp"
#include "prepare/point_mass.hpp"
#include "prepare/time_grid.hpp"
#include "scenario/model/scenario.hpp"

#include <memory>
#include <vector>

namespace vibrotrough::prepare {

/// How many grains of one size and material a layer has.
struct ClassCount {
    double diameter;   ///< m
    int count;         ///< number of grains, at least 1
    int material = 0;  ///< index in `materials`
    double share = 0;  ///< in a feed, by number: `count`, or of a mixture the exact fraction of all grains
};

/// Everything that follows from a scenario and that more than one module needs. It is worked out once and
/// read by deck, evaluate, campaign, compare and view. SI units.
struct PreparedCase {
    scenario::Scenario scenario;  ///< the case from which the rest follows

    // Drive. That of [trough], but for what is said of all stages.
    std::vector<scenario::Stage> stages;  ///< none: the drive has no end
    scenario::DriveMotion motion;         ///< of the trough, as Fourier series
    double throw_number;                  ///< Gamma, as given where it was given
    double machine_number;                ///< K, as given where it was given
    double angular_frequency;             ///< omega, rad/s
    double velocity_scale;                ///< omega r cos(beta), m/s: the speed at velocity efficiency 1
    double largest_speed;                 ///< m/s, upper bound of the speed of the trough, in all stages
    double largest_excursion;  ///< m, upper bound of its distance from its mean position, in all stages
    int highest_order;         ///< of the harmonics of its motion, in all stages

    // Grains and layer.
    std::vector<scenario::Material> materials;  ///< that of [grains] first
    std::vector<ClassCount> classes;     ///< largest first, because large grains are the hardest to insert
    std::shared_ptr<Clump const> clump;  ///< shape of every grain; nullptr for single spheres
    int spheres_per_grain;               ///< 1 without a clump
    double mass;                         ///< kg, of all grains
    double weight;                       ///< N, normal force of the layer at rest: m g cos(alpha)
    double layer_height;                 ///< m, at rest, as given or from the number of grains
    double largest_extent;               ///< m, largest diameter of the spheres that enclose the grains
    /// How many grains there are before the drive begins, and their weight, N. In an open trough it is one of
    /// each class, because the engine cannot start with none.
    int settled_grains;
    double settled_weight;  ///< see settled_grains

    // Stiffness. Where the campaign file gives no modulus, the scenario above holds the one that was chosen.
    NumericalErrors numerics;  ///< bounds of the errors of the efficiency by softness, box and time step

    // Time.
    /// Of the run with the moving trough. All stages have the same number of steps per cycle, which is enough
    /// for each of them; the time step is that of the slowest.
    TimeGrid time;
    double settle_time_step;  ///< s, while the packing settles
    double settle_speed;      ///< m/s, the fastest impact that is expected while the packing settles

    // Simulation box.
    Domain domain;                 ///< surfaces and faces
    double fill_bottom, fill_top;  ///< m, heights between which grains are poured
    double box_top, box_bottom;    ///< m, heights of the faces of the box
    double wall_height;            ///< m, height of side walls

    // Theory.
    PointMassInputs point_mass;  ///< what the theory needs to predict the case

    /// Grain-steps of a number of cycles of one packing: spheres times time steps.
    double grain_steps(double cycles) const;

    /// relative_step_cost() of the layer's spheres.
    double step_cost() const;

    /// What these cycles cost, in grain-steps of a small layer, the unit of cost: grain_steps() times
    /// step_cost().
    double work(double cycles) const;
};

/// How much more processor time a step of a grain takes in a layer of so many spheres than in a small one,
/// whose grains stay in the processor's caches: 1 below 3000 spheres, 3 above 300,000.
///
/// A curve through what LIGGGHTS 3.8.0 took for 10,000, 100,000 and 300,000 grains on one rank of an AMD EPYC
/// (src/manual/costs.md). Between two days, and so between machines, it was off by a factor of up to 1.4.
double relative_step_cost(double spheres);

/// Works out everything that follows from a scenario.
/// @throws core::InputError when a cycle would take more than 1e8 time steps
PreparedCase prepare_case(scenario::Scenario const& scenario);

/// A stage of a case as a case of its own, whose drive has no end: for the checks and theories of a steady
/// drive. @pre the trough moves in this stage
PreparedCase of_stage(PreparedCase const& prepared, scenario::Stage const& stage);

}  // namespace vibrotrough::prepare
