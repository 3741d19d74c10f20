#include "atlas/tables.hpp"

#include "core/csv.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::atlas {
namespace {

/// The columns of a table by their names.
class Columns {
  public:
    explicit Columns(core::CsvReader& reader) : reader_(reader) {}

    std::size_t index(std::string_view name) const {
        auto const& all = reader_.columns();
        auto const found = std::find(all.begin(), all.end(), name);
        if (found == all.end())
            reader_.fail(fmt::format("there is no column {}", name), "write the columns of the atlas' table");
        return static_cast<std::size_t>(found - all.begin());
    }
    double number(std::string_view name) const { return reader_.number(index(name)); }
    std::string text(std::string_view name) const { return std::string(reader_.cells()[index(name)]); }
    Place place() const {
        Place place;
        for (SurfaceInput const& input : inputs()) place.push_back(number(input.key));
        return place;
    }

  private:
    core::CsvReader& reader_;
};

core::CsvFormat format() {
    return {.comments = true};
}

}  // namespace

std::vector<SurfaceInput> const& inputs() {
    static std::vector<SurfaceInput> const all{
        {"throw_number", 0.7, 3.2},   {"tan_vibration_angle", 0.3, 1}, {"tan_inclination", -0.18, 0.1},
        {"friction", 0.15, 0.6},      {"amplitude", 0.1, 4, true},     {"depth", 2, 20, true},
        {"grain_friction", 0.3, 0.8}, {"rolling_friction", 0, 0.2},    {"restitution", 0.3971, 0.8081},
    };
    return all;
}

std::vector<SurfaceInput> const& surface_inputs() {
    static std::vector<SurfaceInput> const all = [] {
        std::vector<SurfaceInput> found = inputs();
        found.push_back({"trend", 0, 1});
        return found;
    }();
    return all;
}

SurfacePrior prior_of_atlas(std::vector<SurfaceInput> const& of) {
    return {.longest = std::vector<double>(of.size(), 50)};
}

Place with_trend(Place place, double trend) {
    place.push_back(trend);
    return place;
}

std::vector<SurfacePoint> with_trends(std::vector<SurfacePoint> points) {
    for (SurfacePoint& one : points) one.place.push_back(one.theory);
    return points;
}

double middle_of(Input input) {
    return inputs()[input].value_at(0.5);
}

Place place_of(KnownNumbers const& numbers) {
    Place place;
    for (std::size_t input = 0; input < numbers.size(); ++input)
        place.push_back(numbers[input].value_or(middle_of(static_cast<Input>(input))));
    return place;
}

double trend_of(double rolling_layer, double theory) {
    return std::min(rolling_layer, std::max(theory, 1.0));
}

std::vector<SurfacePoint> read_layers(std::string_view text, std::string const& file, LayerModel model) {
    core::CsvReader reader(text, file, format());
    Columns const columns(reader);
    std::vector<SurfacePoint> points;
    while (reader.next()) {
        double const law = columns.number("rolling_layer"), theory = columns.number("theory");
        double const trend = model == LayerModel::rolling_layer ? law
                             : model == LayerModel::point_mass  ? theory
                                                                : trend_of(law, theory);
        points.push_back({columns.text("case"), columns.place(), trend, columns.number("efficiency"),
                          std::hypot(columns.number("half_width"), columns.number("numerical_error"))});
    }
    return points;
}

std::vector<SurfacePoint> read_column(std::string_view text, std::string const& file,
                                      std::string_view column) {
    core::CsvReader reader(text, file, format());
    Columns const columns(reader);
    std::string const half_width = fmt::format("{}_half_width", column);
    std::vector<SurfacePoint> points;
    while (reader.next()) {
        if (columns.text(column).empty()) continue;
        points.push_back(
            {columns.text("case"), columns.place(), 0, columns.number(column), columns.number(half_width)});
    }
    return points;
}

std::vector<LayerMotion> read_motions(std::string_view text, std::string const& file) {
    core::CsvReader reader(text, file, format());
    Columns const columns(reader);
    std::vector<LayerMotion> layers;
    while (reader.next()) {
        std::string const mode = columns.text("layer_mode");
        std::optional<int> period;
        if (!columns.text("period").empty()) period = static_cast<int>(columns.number("period"));
        if (!mode.empty()) layers.push_back({columns.place(), mode, period});
    }
    return layers;
}

double read_numerical_bound(std::string_view text, std::string const& file) {
    core::CsvReader reader(text, file, format());
    Columns const columns(reader);
    double sum = 0, count = 0;
    while (reader.next()) {
        if (columns.number("depth") <= deepest_estimated) continue;
        sum += columns.number("numerical_error");
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

std::vector<inference::Hyperparameters> read_draws(std::string_view text, std::string const& file,
                                                   std::vector<SurfaceInput> const& of) {
    core::CsvReader reader(text, file, format());
    Columns const columns(reader);
    std::vector<inference::Hyperparameters> draws;
    while (reader.next()) {
        inference::Hyperparameters draw{columns.number("deviation"),
                                        Eigen::VectorXd(static_cast<Eigen::Index>(of.size())),
                                        columns.number("extra_noise")};
        Eigen::Index k = 0;
        for (SurfaceInput const& input : of) draw.lengths(k++) = columns.number(input.key);
        draws.push_back(draw);
    }
    return draws;
}

std::string draws_csv(std::vector<inference::Hyperparameters> const& draws,
                      std::vector<SurfaceInput> const& of) {
    std::string text = "deviation,extra_noise";
    for (SurfaceInput const& input : of) text += "," + input.key;
    text += '\n';
    for (inference::Hyperparameters const& draw : draws) {
        text += fmt::format("{},{}", draw.deviation, draw.extra_noise);
        for (double const length : draw.lengths) text += fmt::format(",{}", length);
        text += '\n';
    }
    return text;
}

}  // namespace vibrotrough::atlas
