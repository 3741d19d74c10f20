#include "scenario/reader/case_values.hpp"

#include "core/error.hpp"
#include "scenario/reader/given_values.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_spheres = 100'000'000;  // of a layer
constexpr double most_grains_on_floor = 1e6;

/// Puts the parts of a case together and checks what concerns several sections.
class CaseBuilder {
  public:
    explicit CaseBuilder(GivenValues const& given) : given_(given) {}

    Scenario build(std::string const& campaign) const {
        Scenario scenario{
            campaign,
            read_trough(given_),
            read_grains(given_),
            {},
            measure(),
            {},
            {given_.number("solver.rayleigh_fraction"), given_.number("solver.block_stiffness")},
            read_engine_plan(given_)};
        scenario.layer = layer(scenario);
        scenario.output = output();
        if (scenario.layer.block != Block::none) check_block(scenario);
        if (scenario.measure.rolling) check_rolling(scenario);
        check_frames(scenario);
        return scenario;
    }

  private:
    Layer layer(Scenario const& scenario) const {
        double const largest = largest_diameter(scenario.grains);
        for (char const* key : {"layer.length", "layer.width"}) {
            if (given_.number(key) < 4 * largest) {
                given_.fail(
                    key,
                    fmt::format(
                        "{:.6g} m is less than 4 diameters of the largest grains ({:.6g} m each), so that "
                        "grains would touch their own periodic images",
                        given_.number(key), largest),
                    fmt::format("write at least \"{:.6g} mm\"", 4e3 * largest));
            }
        }
        check_floor(largest);
        Layer layer{given_.number("layer.length"), given_.number("layer.width"), {}, 0, Block::none};
        if (given_.find("layer.block") != nullptr) {
            layer.grains = 1;
            layer.block = given_.word("layer.block") == "plate" ? Block::plate : Block::point;
        } else if (Value const* grains = given_.find("layer.grains")) {
            layer.grains = static_cast<int>(std::lround(grains->number()));
        } else {
            layer.height = given_.number("layer.height");
            layer.grains = grains_for(*layer.height, layer, scenario);
        }
        std::size_t const spheres =
            static_cast<std::size_t>(layer.grains) * shape_spheres(scenario.grains).size();
        if (spheres > most_spheres)
            given_.fail("grains.shape", fmt::format("the layer would need {} spheres", spheres),
                        "take fewer grains");
        return layer;
    }

    /// The floor's mesh has a triangle for every few grains on it.
    void check_floor(double diameter) const {
        double const grains =
            given_.number("layer.length") * given_.number("layer.width") / (diameter * diameter);
        if (grains <= most_grains_on_floor) return;
        given_.fail(
            "layer.length",
            fmt::format("{:.3g} grains of {:.3g} m would lie side by side on the floor, more than {:.0f}",
                        grains, diameter, most_grains_on_floor),
            "make the box smaller or the grains larger; is the unit of the diameter right?");
    }

    int grains_for(double height, Layer const& layer, Scenario const& scenario) const {
        double const diameter = scenario.grains.diameter;
        if (height < diameter) {
            given_.fail("layer.height", fmt::format("{:.6g} m is less than one grain diameter", height),
                        fmt::format("write at least \"{:.6g} mm\"", 1e3 * diameter));
        }
        double const count =
            settled_solid_fraction * layer.length * layer.width * height / mean_grain_volume(scenario.grains);
        Key const& key = *find_key("layer.grains");
        if (count > key.most) {
            given_.fail("layer.height",
                        fmt::format("the layer would need {:.3g} grains, more than {:.0f}", count, key.most),
                        "make the layer smaller or the grains larger");
        }
        return std::max(1, static_cast<int>(std::lround(count)));
    }

    /// A block represents the point mass of the theory. It has one size and no shape, and because nothing
    /// about it is random, one packing is enough.
    void check_block(Scenario& scenario) const {
        if (is_clump(scenario.grains))
            given_.fail("layer.block", "grains.shape is given, but a block has a shape of its own",
                        "remove shape");
        if (size_classes(scenario.grains).size() > 1) {
            given_.fail("layer.block", "the grains have several diameters, but a block has only one",
                        "write diameter_spread = 0, or leave it out");
        }
        double const needed = 8 * scenario.grains.diameter;
        if (scenario.layer.block == Block::plate &&
            std::min(scenario.layer.length, scenario.layer.width) < needed) {
            given_.fail("layer.block",
                        fmt::format("a plate is 5 diameters long and needs a box of {:.6g} m", needed),
                        "make length and width at least 8 diameters");
        }
        scenario.grains.rotation = scenario.layer.block == Block::point ? Rotation::blocked : Rotation::free;
        scenario.grains.rolling_friction = 0;
        scenario.measure.packings = scenario.measure.max_packings = 1;
    }

    /// The engine gives the force of a wall on each sphere, without saying of which wall, and each sphere of
    /// a clump has its own contacts but shares the clump's spin.
    void check_rolling(Scenario const& scenario) const {
        bool const is_layer = scenario.layer.block == Block::none && !is_clump(scenario.grains);
        if (is_layer && !scenario.trough.side_wall_friction) return;
        given_.fail(
            "measure.rolling",
            fmt::format("the contacts at the floor are measured only in layers of spheres, and {} is given",
                        is_clump(scenario.grains)             ? "grains.shape"
                        : scenario.layer.block != Block::none ? "layer.block"
                                                              : "trough.side_wall_friction"),
            "leave one of the two out");
    }

    OutputPlan output() const {
        OutputPlan plan{given_.integer("output.frames_per_cycle"),
                        given_.integer("output.checkpoint_cycles")};
        plan.contacts = given_.number("output.contacts") != 0;
        Value const* const packings = given_.find("output.frame_packings");
        if (packings == nullptr) return plan;
        plan.frame_packings.clear();
        if (auto const* const numbers = std::get_if<std::vector<double>>(&packings->content)) {
            for (double const number : *numbers)
                plan.frame_packings.push_back(static_cast<int>(std::lround(number)));
        }
        return plan;
    }

    void check_frames(Scenario const& scenario) const {
        OutputPlan const& plan = scenario.output;
        bool const lists = given_.find("output.frame_packings") != nullptr;
        if ((lists || plan.contacts) && plan.frames_per_cycle == 0)
            given_.fail(lists ? "output.frame_packings" : "output.contacts",
                        "there are no frames, because frames_per_cycle is 0",
                        "write frames_per_cycle = 20, or remove this key");
        std::vector<int> const& packings = plan.frame_packings;
        int const most = scenario.measure.max_packings;
        if (lists && !packings.empty() && packings.back() > most)
            given_.fail(
                "output.frame_packings",
                fmt::format("there is no packing {}, because there are at most {}", packings.back(), most),
                "name fewer, or raise measure.max_packings");
        if (plan.contacts && (scenario.layer.block != Block::none || is_clump(scenario.grains)))
            given_.fail("output.contacts",
                        fmt::format("contacts are written only for layers of spheres, and {} is given",
                                    is_clump(scenario.grains) ? "grains.shape" : "layer.block"),
                        "leave one of the two out");
    }

    MeasurementPlan measure() const {
        MeasurementPlan plan{given_.integer("measure.packings"), given_.number("measure.confidence"),
                             given_.number("measure.half_width"), given_.integer("measure.max_cycles"),
                             given_.integer("measure.max_packings")};
        bool const is_given = given_.find("measure.max_packings") != nullptr;
        if (plan.max_packings < plan.packings && is_given) {
            given_.fail("measure.max_packings",
                        fmt::format("{} is less than measure.packings, which is {}", plan.max_packings,
                                    plan.packings),
                        "write a number that is not smaller, or fewer packings");
        }
        plan.max_packings = std::max(plan.max_packings, plan.packings);
        if (given_.find("measure.max_core_time") != nullptr)
            plan.max_core_time = given_.number("measure.max_core_time");
        plan.rolling = given_.number("measure.rolling") != 0;
        return plan;
    }

    GivenValues const& given_;
};

}  // namespace

void throw_at(FilePosition position, std::string_view key, std::string_view wrong, std::string_view instead) {
    throw core::InputError(fmt::format("{}:{}:{}: {}: {}; {}", position.file, position.where.line,
                                       position.where.column, key, wrong, instead));
}

Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file,
                       FileSource const& source) {
    GivenValues const given(values, file, source);
    return CaseBuilder(given).build(campaign);
}

}  // namespace vibrotrough::scenario
