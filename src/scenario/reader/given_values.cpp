#include "scenario/reader/given_values.hpp"

#include "core/atomic_file.hpp"
#include "core/quantity.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::uintmax_t largest_named_file = 1 << 20;

}  // namespace

int GivenValue::whole() const {
    return static_cast<int>(std::lround(number()));
}

NamedFile GivenValue::file(std::string const& name) const {
    for (NamedFile const& given : source_.files) {
        if (given.name == name) return given;
    }
    std::filesystem::path const path = source_.folder / name;
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) {
        fail(fmt::format("there is no file {}", path.string()),
             "put it in the folder of the campaign file and write its name without a path");
    }
    if (std::filesystem::file_size(path, failure) > largest_named_file)
        fail(fmt::format("{} is larger than 1 MiB", path.string()), "use a smaller file");
    return {name, core::read_file(path, core::largest_note)};
}

void GivenValue::fail(std::string_view wrong, std::string_view instead) const {
    throw_at(where_, key_.path, wrong, instead);
}

void GivenValue::refuse(std::string_view text, std::string_view allowed) const {
    fail(fmt::format("'{}' is not allowed", text),
         fmt::format("{}; {}", write_instead(key_),
                     allowed.empty() ? fmt::format("allowed: {}", range_of(key_)) : std::string(allowed)));
}

std::string GivenKeys::text(std::string_view key, double value) const {
    Key const& known = *find_key(key);
    auto const found = values_.find(key);
    if (found == values_.end() || found->second.unit.empty()) return written_value(known, value);
    std::string const& unit = found->second.unit;
    // No unit of a key has a zero of its own, as those of temperatures have.
    return fmt::format("{:.6g} {}", value / core::parse_quantity("1 " + unit, std::string(known.unit)), unit);
}

std::string_view GivenKeys::unit(std::string_view key) const {
    auto const found = values_.find(key);
    return found == values_.end() || found->second.unit.empty() ? find_key(key)->unit
                                                                : std::string_view(found->second.unit);
}

void GivenKeys::fail(std::string_view key, std::string_view wrong, std::string_view instead) const {
    auto const found = values_.find(key);
    throw_at({file_, found == values_.end() ? Position{} : found->second.where}, key, wrong, instead);
}

void GivenKeys::require(std::string_view key, double value, double least, std::string_view what) const {
    if (value >= least) return;
    fail(key, fmt::format("{} is less than {}", text(key, value), what),
         fmt::format("write at least \"{}\"", text(key, least)));
}

void GivenKeys::require_at_most(std::string_view key, double count, double most, std::string_view things,
                                std::string_view instead) const {
    if (count > most)
        fail(key, fmt::format("there would be {:.3g} {}, more than {:.0f}", count, things, most), instead);
}

}  // namespace vibrotrough::scenario
