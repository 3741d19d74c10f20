#include "app/commands/material_options.hpp"

#include "app/commands/command.hpp"
#include "app/plant_files.hpp"
#include "core/nearest.hpp"
#include "core/quantity.hpp"
#include "core/text.hpp"

namespace vibrotrough::app {
namespace {

constexpr char const* size_option = "--grain-diameter";

std::vector<learn::BulkMaterial> const& materials() {
    static auto const all = learn::read_materials(plant_table("materials.csv"), "materials.csv");
    return all;
}

std::vector<std::string_view> names_of_materials() {
    std::vector<std::string_view> names;
    for (auto const& one : materials()) names.emplace_back(one.name);
    return names;
}

learn::BulkMaterial const& material_named(std::string const& name) {
    auto const found = std::ranges::find(materials(), name, &learn::BulkMaterial::name);
    if (found != materials().end()) return *found;
    auto const names = names_of_materials();
    auto const near = core::nearest_word(name, names);
    throw core::InputError(
        fmt::format("--material {}: is not in the table{}; choose from {}, or give its numbers", name,
                    near.empty() ? "" : fmt::format(" (was {} meant?)", near), fmt::join(names, ", ")));
}

/// m, the ends of "0 to 30 mm".
theory::Range read_sizes(std::string const& text) {
    return read_range(size_option, text, "\"0 to 30 mm\"", [](std::string const& one) {
        try {
            return core::parse_quantity(one, "m");
        } catch (core::QuantityError const& error) {
            throw core::InputError(fmt::format("{} {}: {}; write for example {} \"0 to 30 mm\"", size_option,
                                               one, error.problem(), size_option));
        }
    });
}

}  // namespace

std::string_view plant_table(std::string_view name) {
    return std::ranges::find(plant_files, name, [](auto const& one) { return one.first; })->second;
}

void MaterialOptions::add_to(CLI::App& command, std::string const& group) {
    command
        .add_option("--material", material_,
                    fmt::format("One of {}: its usual ranges stand in for what is not given of bulk density, "
                                "friction, rolling friction and size (input_templates/plant/materials.csv)",
                                fmt::join(names_of_materials(), ", ")))
        ->group(group);
    std::vector<std::string> kinds;
    for (auto const& one : learn::grain_kinds()) kinds.emplace_back(one.name);
    command
        .add_option(
            "--grain-kind", kind_,
            "Of grains that are not dry and roundish: rods and mixes are answered as spheres without a "
            "probability, the others with the reason why no model knows them")
        ->check(CLI::IsMember(kinds))
        ->group(group);
}

std::string MaterialOptions::fill_in_material(QuantityOptions& quantities, bool is_friction_known) {
    if (!material_) return "";
    auto const& found = material_named(std::string(core::trimmed(*material_)));
    auto const range = [&](char const* option, theory::Range const& r, double unit, char const* name) {
        quantities.set_if_missing(option, fmt::format("{:g} to {:g}{}", r.low / unit, r.high / unit, name));
    };
    range("--bulk-density", found.bulk_density, 1, " kg/m3");
    if (!is_friction_known) range("--friction", found.friction, 1, "");
    range("--rolling-friction", found.rolling_friction, 1, "");
    if (found.kind == "mix")
        range(size_option, found.size, 1e-3, " mm");
    else
        quantities.set_if_missing(
            size_option, fmt::format("{:.2g} mm", 1e3 * std::sqrt(found.size.low * found.size.high)));
    told_ = fmt::format("{} ({})", found.name, found.source);
    return found.kind;
}

/// A mix of sizes becomes one of its middle size.
void MaterialOptions::read_size(QuantityOptions& quantities, std::string& kind) {
    auto const& text = quantities.text(size_option);
    if (!text) return;
    bool const is_range = text->find("to") != std::string::npos;
    auto const [low, high] =
        is_range ? read_sizes(*text)
                 : theory::Range{*quantities.value(size_option), *quantities.value(size_option)};
    if (kind.empty() && high < learn::largest_powder) kind = "powder";
    if (low == high) return;
    if (kind.empty() && low * learn::widest_size_ratio < high) kind = "mix";
    if (kind == "mix") sizes_ = theory::Range{low, high};
    quantities.set(size_option, fmt::format("{:.6g} mm", 500 * (low + high)));
}

void MaterialOptions::fill_in(QuantityOptions& quantities, bool is_friction_known) {
    std::string kind = fill_in_material(quantities, is_friction_known);
    if (kind_) kind = *kind_;
    read_size(quantities, kind);
    if (kind.empty()) return;
    auto const& found = *std::ranges::find(learn::grain_kinds(), kind, &learn::GrainKind::name);
    if (found.is_refused)
        throw core::InputError(fmt::format("no answer is given for {}: {}", kind, found.reason));
    why_unknown_ = found.reason;
}

}  // namespace vibrotrough::app
