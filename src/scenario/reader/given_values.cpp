#include "scenario/reader/given_values.hpp"

#include "core/atomic_file.hpp"

#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::uintmax_t largest_named_file = 1 << 20;

}  // namespace

Value const* GivenValues::find(std::string_view key) const {
    auto const found = values_.find(key);
    return found == values_.end() ? nullptr : &found->second;
}

double GivenValues::number(std::string_view key) const {
    if (Value const* value = find(key)) return value->number();
    return std::get<double>(find_key(key)->if_missing);
}

int GivenValues::integer(std::string_view key) const {
    return static_cast<int>(std::lround(number(key)));
}

std::string GivenValues::word(std::string_view key) const {
    if (Value const* value = find(key)) return value->word();
    return std::string(choices(*find_key(key)).front());
}

void GivenValues::fail(std::string_view key, std::string_view wrong, std::string_view instead) const {
    Value const* const value = find(key);
    throw_at({file_, value ? value->where : Position{}}, key, wrong, instead);
}

NamedFile GivenValues::named_file(std::string_view key, std::string const& name) const {
    for (NamedFile const& given : source_.files) {
        if (given.name == name) return given;
    }
    std::filesystem::path const path = source_.folder / name;
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) {
        fail(key, fmt::format("there is no file {}", path.string()),
             "put it in the folder of the campaign file and write its name without a path");
    }
    if (std::filesystem::file_size(path, failure) > largest_named_file)
        fail(key, fmt::format("{} is larger than 1 MiB", path.string()), "use a smaller file");
    return {name, core::read_file(path, core::largest_note)};
}

}  // namespace vibrotrough::scenario
