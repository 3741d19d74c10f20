#include "core/note.hpp"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::core::note {
namespace {

Json const& member(Json const& note, std::string_view key) {
    if (!note.is_object()) throw Fault("it is not an object");
    auto const found = note.find(key);
    if (found == note.end()) throw Fault(fmt::format("'{}' is missing", key));
    return *found;
}

std::vector<std::string> texts_of(Json const& values, std::string const& key) {
    if (!values.is_array()) throw Fault(fmt::format("'{}' holds what is not a list", key));
    std::vector<std::string> found;
    for (Json const& value : values) {
        if (!value.is_string()) throw Fault(fmt::format("'{}' holds what is not a text", key));
        found.push_back(value.get<std::string>());
    }
    return found;
}

}  // namespace

Json parse(std::string_view text) {
    try {
        return Json::parse(text);
    } catch (Json::parse_error const& error) {
        throw Fault(fmt::format("it is not JSON from byte {} on", error.byte));
    } catch (Json::out_of_range const&) {
        throw Fault("it holds a number that is too large");
    }
}

Json const& object(Json const& note, std::string_view key) {
    Json const& value = member(note, key);
    if (!value.is_object()) throw Fault(fmt::format("'{}' is not an object", key));
    return value;
}

Json const& elements(Json const& note) {
    if (!note.is_array()) throw Fault("it is not a list");
    return note;
}

Json const& list(Json const& note, std::string_view key) {
    Json const& value = member(note, key);
    if (!value.is_array()) throw Fault(fmt::format("'{}' is not a list", key));
    return value;
}

double number(Json const& note, std::string const& key, double least) {
    Json const& value = member(note, key);
    if (!value.is_number()) throw Fault(fmt::format("'{}' is not a number", key));
    auto const number = value.get<double>();
    if (number < least) throw Fault(fmt::format("'{}' is below {}", key, least));
    return number;
}

std::optional<double> known_number(Json const& note, std::string const& key, double least) {
    if (member(note, key).is_null()) return {};
    return number(note, key, least);
}

std::vector<double> numbers(Json const& note, std::string const& key) {
    std::vector<double> found;
    for (Json const& value : list(note, key)) {
        if (!value.is_number()) throw Fault(fmt::format("'{}' holds what is not a number", key));
        found.push_back(value.get<double>());
    }
    return found;
}

long whole_number(Json const& note, std::string const& key, long least, long most) {
    Json const& value = member(note, key);
    bool const is_within =
        value.is_number_unsigned()
            ? std::cmp_greater_equal(value.get<std::uint64_t>(), least) &&
                  std::cmp_less_equal(value.get<std::uint64_t>(), most)
            : value.is_number_integer() && value.get<long>() >= least && value.get<long>() <= most;
    if (!is_within) throw Fault(fmt::format("'{}' is not a whole number from {} to {}", key, least, most));
    return value.get<long>();
}

int count(Json const& note, std::string const& key, int least) {
    return static_cast<int>(whole_number(note, key, least, std::numeric_limits<int>::max()));
}

std::vector<std::string> texts(Json const& note, std::string const& key) {
    return texts_of(list(note, key), key);
}

std::string text(Json const& note, std::string const& key) {
    Json const& value = member(note, key);
    if (!value.is_string()) throw Fault(fmt::format("'{}' is not a text", key));
    return value.get<std::string>();
}

std::string text_if_any(Json const& note, std::string const& key) {
    return note.contains(key) ? text(note, key) : std::string();
}

}  // namespace vibrotrough::core::note
