#include "learn/plant.hpp"

#include "core/csv.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr double millimetre = 1e-3;
constexpr double same_force = 0.05;  // relative: what makers round
constexpr std::string_view how_to_write = "write a table like those of input_templates/plant";

/// The cells of one row, by the names of their columns.
class PlantRow {
  public:
    explicit PlantRow(core::CsvReader const& reader) : reader_(reader) {}
    std::string text(std::string_view column) const { return std::string(reader_.cells()[index(column)]); }
    double number(std::string_view column) const {
        double const value = reader_.number(index(column));
        if (value < 0) reader_.fail(fmt::format("{} is below 0", column), how_to_write);
        return value;
    }
    theory::Range range(std::string const& column, double unit = 1, std::string const& end = "") const {
        theory::Range const found{unit * number(column + "_low" + end),
                                  unit * number(column + "_high" + end)};
        if (found.low > found.high)
            reader_.fail(column + ": the low end is above the high one", how_to_write);
        return found;
    }
    [[noreturn]] void fail(std::string const& problem) const { reader_.fail(problem, how_to_write); }

  private:
    std::size_t index(std::string_view column) const {
        auto const& columns = reader_.columns();
        auto const found = std::ranges::find(columns, column);
        if (found == columns.end())
            reader_.fail(fmt::format("the column {} is missing", column), how_to_write);
        return static_cast<std::size_t>(found - columns.begin());
    }
    core::CsvReader const& reader_;
};

template <typename Made>
std::vector<Made> read_rows(std::string_view text, std::string const& file,
                            std::function<Made(PlantRow const&)> const& make) {
    core::CsvReader reader(text, file, {.comments = true, .blanks = true});
    std::vector<Made> all;
    while (reader.next()) all.push_back(make(PlantRow(reader)));
    return all;
}

}  // namespace

std::vector<BulkMaterial> read_materials(std::string_view text, std::string const& file) {
    return read_rows<BulkMaterial>(text, file, [](PlantRow const& row) {
        return BulkMaterial{row.text("material"),
                            row.range("bulk_density"),
                            row.range("friction"),
                            row.range("rolling"),
                            row.range("size", millimetre, "_mm"),
                            row.text("kind"),
                            row.text("source")};
    });
}

bool DriveKind::builds(theory::Drive const& drive) const {
    constexpr double tiny = 1e-6;
    auto const within = [](double value, theory::Range const& range) {
        return value >= range.low * (1 - tiny) && value <= range.high * (1 + tiny);
    };
    return within(2 * drive.amplitude, stroke) && within(60 * drive.frequency, rpm) &&
           drive.machine_number(9.81) <= machine_number * (1 + tiny);
}

std::vector<DriveKind> read_drives(std::string_view text, std::string const& file) {
    return read_rows<DriveKind>(text, file, [](PlantRow const& row) {
        return DriveKind{row.text("drive"), row.range("stroke", millimetre, "_mm"), row.range("rpm"),
                         row.number("machine_number"), row.text("source")};
    });
}

std::vector<Motor> read_motors(std::string_view text, std::string const& file) {
    return read_rows<Motor>(text, file, [](PlantRow const& row) {
        Motor const motor{row.number("rpm"), millimetre * row.number("static_moment_kg_mm"),
                          1000 * row.number("force_kN"), 1000 * row.number("power_kW")};
        double const force = force_of(Exciter{motor.static_moment}, motor.rpm / 60);
        if (std::abs(force - motor.force) > same_force * motor.force)
            row.fail(
                fmt::format("a static moment of {:.4g} kg mm gives {:.3g} kN at {:.4g} 1/min, not {:.3g} kN",
                            1e3 * motor.static_moment, 1e-3 * force, motor.rpm, 1e-3 * motor.force));
        return motor;
    });
}

std::vector<GrainKind> const& grain_kinds() {
    static std::vector<GrainKind> const kinds{
        {"powder", true,
         "the air between grains below about 0.2 mm cannot escape while they are thrown: it carries the "
         "layer, "
         "which is then much slower or stands still, and no model here has air; have a maker try it with "
         "your "
         "powder"},
        {"moist", true,
         "moist grains stick to each other and to the trough, by more than a throw can part, and no model of "
         "a "
         "design has such forces; simulate them with engine.cohesion, or have a maker try it"},
        {"flakes", true,
         "flakes slide on each other and sail in the air, and no layer of them was simulated; have a maker "
         "try it"},
        {"rods", false,
         "no layer of rods was simulated that decides; the answer is that of spheres as thick as they are, "
         "and "
         "how far it is off is not known (grains.shape simulates short rods)"},
        {"mix", false,
         "no layer with such a mix of sizes was simulated: small grains sink to the trough and carry the "
         "large "
         "ones; the answer is that of spheres of its middle size, and 'vibrotrough predict' says what the "
         "sizes "
         "change ('vibrotrough init mixture' simulates a mix)"}};
    return kinds;
}

}  // namespace vibrotrough::learn
