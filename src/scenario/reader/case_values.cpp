#include "scenario/reader/case_values.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::uintmax_t largest_named_file = 1 << 20;
constexpr std::size_t clump_cost = 100'000'000;  // spheres in all

class CaseBuilder {
  public:
    CaseBuilder(CaseValues const& values, std::string const& file, FileSource const& source)
        : values_(values), file_(file), source_(source) {}

    Scenario build(std::string const& campaign) const {
        Scenario scenario{campaign,
                          trough(),
                          grains(),
                          {},
                          measure(),
                          {integer("output.frames_per_cycle"), integer("output.checkpoint_cycles")},
                          {number("solver.rayleigh_fraction"), number("solver.block_stiffness")}};
        scenario.layer = layer(scenario);
        if (scenario.layer.block != Block::none) check_block(scenario);
        return scenario;
    }

  private:
    Value const* find(std::string_view key) const {
        auto const found = values_.find(key);
        return found == values_.end() ? nullptr : &found->second;
    }
    double number(std::string_view key) const {
        if (Value const* value = find(key)) return value->number();
        return find_key(key)->fallback.value();
    }
    int integer(std::string_view key) const { return static_cast<int>(std::lround(number(key))); }
    std::string word(std::string_view key) const {
        if (Value const* value = find(key)) return value->word();
        return std::string(choices(*find_key(key)).front());
    }
    [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view instead) const {
        Value const* const value = find(key);
        throw_at({file_, value ? value->where : Position{}}, key, wrong, instead);
    }

    double angle(std::string_view angle_key, std::string_view tangent_key) const {
        if (Value const* value = find(angle_key)) return value->number();
        return std::atan(number(tangent_key));
    }

    double frequency(Trough const& trough) const {
        if (Value const* value = find("trough.frequency")) return value->number();
        double machine_number = 0;
        if (Value const* value = find("trough.machine_number")) {
            machine_number = value->number();
        } else {
            if (trough.vibration_angle <= 0) {
                fail("trough.throw_number",
                     "a trough that shakes along itself (vibration angle 0) has throw number 0",
                     "write machine_number or frequency instead");
            }
            machine_number = number("trough.throw_number") * std::cos(trough.inclination) /
                             std::sin(trough.vibration_angle);
        }
        double const result = std::sqrt(machine_number * gravity / trough.amplitude) / (2 * std::numbers::pi);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            fail("trough.amplitude",
                 fmt::format("the drive would run at {:.4g} Hz, outside {}", result, key.range),
                 "change the amplitude or the throw number");
        }
        return result;
    }

    /// Throw and machine number follow from the frequency, or from each other; their upper bounds hold all
    /// the same.
    void check_derived(std::string_view path, double value) const {
        Key const& key = *find_key(path);
        if (value <= key.most * (1 + 1e-12)) return;
        for (std::string_view const given :
             {"trough.frequency", "trough.machine_number", "trough.throw_number"}) {
            if (find(given) == nullptr) continue;
            fail(given, fmt::format("makes the {} {:.4g}, outside {}", path.substr(7), value, key.range),
                 "lower it, or the amplitude");
        }
    }

    Trough trough() const {
        Trough trough{.inclination = angle("trough.inclination", "trough.tan_inclination"),
                      .vibration_angle = angle("trough.vibration_angle", "trough.tan_vibration_angle"),
                      .amplitude = number("trough.amplitude"),
                      .frequency = 0,
                      .friction = number("trough.friction"),
                      .restitution = number("trough.restitution"),
                      .side_wall_friction = {},
                      .along_phase = number("trough.along_phase"),
                      .harmonics = harmonics(),
                      .waveform = nullptr,
                      .given = given_drive()};
        if (Value const* value = find("trough.side_wall_friction"))
            trough.side_wall_friction = value->number();
        trough.frequency = frequency(trough);
        check_derived("trough.throw_number", throw_number(trough));
        check_derived("trough.machine_number", machine_number(trough));
        if (find("trough.waveform") != nullptr) add_waveform(trough);
        return trough;
    }

    GivenDrive given_drive() const {
        auto const given = [&](std::string_view key) {
            Value const* const value = find(key);
            return value ? std::optional(value->number()) : std::nullopt;
        };
        return {given("trough.throw_number"), given("trough.machine_number"),
                given("trough.tan_vibration_angle"), given("trough.tan_inclination")};
    }

    std::vector<DriveHarmonic> harmonics() const {
        std::vector<DriveHarmonic> harmonics;
        Value const* const value = find("trough.harmonics");
        if (value == nullptr) return harmonics;
        for (std::string const& text : value->words()) harmonics.push_back(harmonic(text));
        return harmonics;
    }

    DriveHarmonic harmonic(std::string const& text) const {
        constexpr auto instead = "write \"order, ratio, phase\", such as \"25, 0.2, 0 deg\"";
        auto const wrong = [&](std::string_view why) {
            fail("trough.harmonics", fmt::format("'{}': {}", text.substr(0, 60), why), instead);
        };
        std::size_t const first = text.find(','), second = text.find(',', first + 1);
        if (first == std::string::npos || second == std::string::npos)
            wrong("does not have three parts with commas");
        DriveHarmonic harmonic{};
        auto const plain = [&](std::size_t from, std::size_t to, auto& result) {
            from = text.find_first_not_of(' ', from);
            auto const [end, failure] =
                std::from_chars(text.data() + std::min(from, to), text.data() + to, result);
            return failure == std::errc() &&
                   text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data())) == to;
        };
        if (!plain(0, first, harmonic.order) || harmonic.order < 2 || harmonic.order > 100)
            wrong("its order is not a whole number from 2 to 100");
        if (!plain(first + 1, second, harmonic.ratio) || !(std::abs(harmonic.ratio) <= 10))
            wrong("its ratio is not a number from -10 to 10");
        try {
            std::size_t const start = text.find_first_not_of(' ', second + 1);
            harmonic.phase =
                core::parse_quantity(start == std::string::npos ? "" : text.substr(start), "radian");
        } catch (core::QuantityError const& error) {
            wrong(error.what());
        }
        if (!(std::abs(harmonic.phase) <= 4 * std::numbers::pi)) wrong("its phase is beyond 720 deg");
        return harmonic;
    }

    NamedFile named_file(std::string_view key) const {
        std::string const name = word(key);
        for (NamedFile const& given : source_.files) {
            if (given.name == name) return given;
        }
        std::filesystem::path const path = source_.folder / name;
        std::error_code failure;
        if (!std::filesystem::is_regular_file(path, failure)) {
            fail(key, fmt::format("there is no file {}", path.string()),
                 "put it beside the campaign file and write its plain name");
        }
        if (std::filesystem::file_size(path, failure) > largest_named_file)
            fail(key, fmt::format("{} is larger than 1 MiB", path.string()), "give a smaller file");
        return {name, core::read_file(path)};
    }

    /// Amplitude and vibration angle are the fundamental's: theory, throw number and efficiency rest on them.
    void add_waveform(Trough& trough) const {
        constexpr auto key = "trough.waveform";
        for (char const* other : {"trough.harmonics", "trough.along_phase"}) {
            if (find(other) != nullptr)
                fail(other, "is given beside a waveform, which is the whole motion", "keep one of the two");
        }
        try {
            auto& known = source_.read->waveforms[word(key)];
            if (!known) known = read_waveform(named_file(key));
            trough.waveform = known;
            check_samples(*known, 1 / trough.frequency);
        } catch (std::invalid_argument const& error) {
            fail(key, fmt::format("{}: {}", word(key), error.what()),
                 "write the header time_s,x_m,z_m and even samples of one cycle");
        }
        DriveMotion const& motion = trough.waveform->motion;
        auto const fundamental = [](std::vector<DriveTerm> const& terms) {
            return terms.empty() || terms.front().order != 1 ? 0.0 : terms.front().amplitude;
        };
        double const along = fundamental(motion.along), normal = fundamental(motion.normal);
        double const amplitude = std::hypot(along, normal), angle = std::atan2(normal, along);
        if (std::abs(amplitude - trough.amplitude) > 0.01 * amplitude ||
            std::abs(angle - trough.vibration_angle) > 0.01) {
            fail(key,
                 fmt::format(
                     "its fundamental has amplitude {:.6g} mm and vibration angle {:.5g} deg, not those "
                     "of the keys",
                     1e3 * amplitude, angle * 180 / std::numbers::pi),
                 fmt::format("write amplitude = \"{:.6g} mm\" and vibration_angle = \"{:.5g} deg\"",
                             1e3 * amplitude, angle * 180 / std::numbers::pi));
        }
    }

    Grains grains() const {
        Grains grains{.diameter = 0,
                      .diameter_spread = number("grains.diameter_spread"),
                      .density = number("grains.density"),
                      .youngs_modulus = number("grains.youngs_modulus"),
                      .poisson_ratio = number("grains.poisson_ratio"),
                      .friction = number("grains.friction"),
                      .restitution = number("grains.restitution"),
                      .rolling_friction = 0,
                      .rotation = Rotation::free,
                      .size_law = SizeLaw::three_classes,
                      .diameters = {},
                      .number_fractions = {},
                      .mass_fractions = {},
                      .shape = word("grains.shape"),
                      .shape_file = nullptr};
        set_rotation(grains);
        set_sizes(grains);
        if (is_clump(grains)) set_shape(grains);
        return grains;
    }

    void set_rotation(Grains& grains) const {
        std::string const rotation = word("grains.rotation");
        double const rolling_friction = number("grains.rolling_friction");
        if (rotation == "rolling") {
            grains.rotation = Rotation::rolling;
            grains.rolling_friction = rolling_friction;
            if (!(rolling_friction > 0))
                fail("grains.rotation", "rolling without a rolling_friction above 0",
                     "write rolling_friction = 0.1 or rotation = \"free\"");
        } else if (rolling_friction > 0 && find("grains.rotation") == nullptr) {
            fail("grains.rolling_friction", "has no effect on grains that rotate freely",
                 "write rotation = \"rolling\" as well");
        }
        if (rotation == "blocked") grains.rotation = Rotation::blocked;
    }

    void set_sizes(Grains& grains) const {
        std::string const law = word("grains.size_law");
        if (law == "uniform") grains.size_law = SizeLaw::uniform;
        if (law == "lognormal") grains.size_law = SizeLaw::lognormal;
        Value const* const list = find("grains.diameters");
        for (char const* fractions : {"grains.number_fractions", "grains.mass_fractions"}) {
            if (list == nullptr && find(fractions) != nullptr)
                fail(fractions, "needs a list of as many diameters",
                     "write diameters = [\"2 mm\", \"3 mm\"]");
        }
        if (list == nullptr) {
            grains.diameter = number("grains.diameter");
            return;
        }
        for (char const* other : {"grains.size_law", "grains.diameter_spread"}) {
            if (find(other) != nullptr) fail(other, "is given beside a list of diameters", "remove it");
        }
        grains.size_law = SizeLaw::listed;
        grains.diameters = list->numbers();
        grains.number_fractions = fractions("grains.number_fractions", grains.diameters.size());
        grains.mass_fractions = fractions("grains.mass_fractions", grains.diameters.size());
        if (grains.number_fractions.empty() == grains.mass_fractions.empty()) {
            fail("grains.diameters", "needs exactly one of number_fractions and mass_fractions",
                 "write mass_fractions = [0.3, 0.7]");
        }
        for (SizeClass const& size : size_classes(grains))
            grains.diameter += size.number_fraction * size.diameter;
    }

    std::vector<double> fractions(std::string_view key, std::size_t count) const {
        Value const* const value = find(key);
        if (value == nullptr) return {};
        if (value->numbers().size() != count) {
            fail(key, fmt::format("has {} values for {} diameters", value->numbers().size(), count),
                 "list one fraction for each diameter");
        }
        return value->numbers();
    }

    void set_shape(Grains& grains) const {
        try {
            if (grains.shape != "cube" && grains.shape != "rod") {
                auto& known = source_.read->shapes[grains.shape];
                if (!known) known = read_shape(named_file("grains.shape"));
                grains.shape_file = known;
            }
        } catch (std::invalid_argument const& error) {
            fail("grains.shape", fmt::format("{}: {}", grains.shape, error.what()),
                 "write the header x,y,z,radius and one sphere per line");
        }
        if (size_classes(grains).size() > 1) {
            fail("grains.shape", "clumps come in one size only",
                 "leave out diameter_spread (or write 0), or take spheres");
        }
        if (grains.rotation == Rotation::rolling) {
            fail("grains.shape", "a clump rolls as its shape lets it, without the rolling model",
                 "write rotation = \"free\" or \"blocked\"");
        }
    }

    Layer layer(Scenario const& scenario) const {
        double const largest = largest_diameter(scenario.grains);
        for (char const* key : {"layer.length", "layer.width"}) {
            if (number(key) < 4 * largest) {
                fail(
                    key,
                    fmt::format(
                        "{:.6g} m is less than 4 of the largest grains ({:.6g} m), so that grains would meet "
                        "their own images",
                        number(key), largest),
                    fmt::format("write at least \"{:.6g} mm\"", 4e3 * largest));
            }
        }
        Layer layer{number("layer.length"), number("layer.width"), {}, 0, Block::none};
        if (find("layer.block") != nullptr) {
            layer.grains = 1;
            layer.block = word("layer.block") == "plate" ? Block::plate : Block::point;
        } else if (Value const* grains = find("layer.grains")) {
            layer.grains = static_cast<int>(std::lround(grains->number()));
        } else {
            layer.height = number("layer.height");
            layer.grains = grains_for(*layer.height, layer, scenario);
        }
        std::size_t const spheres =
            static_cast<std::size_t>(layer.grains) * shape_spheres(scenario.grains).size();
        if (spheres > clump_cost)
            fail("grains.shape", fmt::format("the layer would need {} spheres", spheres),
                 "take fewer grains");
        return layer;
    }

    int grains_for(double height, Layer const& layer, Scenario const& scenario) const {
        double const diameter = scenario.grains.diameter;
        if (height < diameter) {
            fail("layer.height", fmt::format("{:.6g} m is less than one grain diameter", height),
                 fmt::format("write at least \"{:.6g} mm\"", 1e3 * diameter));
        }
        double const count =
            settled_solid_fraction * layer.length * layer.width * height / mean_grain_volume(scenario.grains);
        Key const& key = *find_key("layer.grains");
        if (count > key.most) {
            fail("layer.height",
                 fmt::format("the layer would need {:.3g} grains, more than {:.0f}", count, key.most),
                 "make the layer smaller or the grains larger");
        }
        return std::max(1, static_cast<int>(std::lround(count)));
    }

    /// A block stands for the point mass: one size, no shape, nothing random, so that one packing is all.
    void check_block(Scenario& scenario) const {
        if (is_clump(scenario.grains))
            fail("layer.block", "a block has no shape of its grains", "remove shape");
        if (size_classes(scenario.grains).size() > 1) {
            fail("layer.block", "a block has one diameter", "write diameter_spread = 0, or leave it out");
        }
        double const needed = 8 * scenario.grains.diameter;
        if (scenario.layer.block == Block::plate &&
            std::min(scenario.layer.length, scenario.layer.width) < needed) {
            fail("layer.block",
                 fmt::format("a plate is 5 diameters long and needs {:.6g} m of trough", needed),
                 "make length and width at least 8 diameters");
        }
        scenario.grains.rotation = scenario.layer.block == Block::point ? Rotation::blocked : Rotation::free;
        scenario.grains.rolling_friction = 0;
        scenario.measure.packings = 1;
    }

    MeasurementPlan measure() const {
        return {integer("measure.packings"), number("measure.confidence"), number("measure.half_width"),
                integer("measure.max_cycles")};
    }

    CaseValues const& values_;
    std::string const& file_;
    FileSource const& source_;
};

}  // namespace

void throw_at(Place place, std::string_view key, std::string_view wrong, std::string_view instead) {
    throw core::InputError(fmt::format("{}:{}:{}: {}: {}; {}", place.file, place.where.line,
                                       place.where.column, key, wrong, instead));
}

Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file,
                       FileSource const& source) {
    return CaseBuilder(values, file, source).build(campaign);
}

}  // namespace vibrotrough::scenario
