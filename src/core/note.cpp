#include "core/note.hpp"

#include "core/hash.hpp"

#include <fmt/format.h>

namespace vibrotrough::core::note {
namespace {

constexpr char const* seal = "sha256";

std::string digest_of(Json const& note) {
    return sha256_hex(note.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json const& member(Json const& note, std::string_view key) {
    if (!note.is_object()) throw Fault("it is not an object");
    auto const found = note.find(key);
    if (found == note.end()) throw Fault(fmt::format("'{}' is missing", key));
    return *found;
}

Json const& member(Json const& note, std::string_view key, bool (Json::*is_kind)() const, char const* kind) {
    Json const& value = member(note, key);
    if (!(value.*is_kind)()) throw Fault(fmt::format("'{}' is not {}", key, kind));
    return value;
}

/// The elements of a list, which all are of one kind.
template <typename Element>
std::vector<Element> all_of(Json const& note, std::string const& key, bool (Json::*is_kind)() const,
                            char const* kind) {
    std::vector<Element> found;
    for (Json const& value : list(note, key)) {
        if (!(value.*is_kind)()) throw Fault(fmt::format("'{}' holds what is not {}", key, kind));
        found.push_back(value.get<Element>());
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

std::string sealed(Json note) {
    note.erase(seal);
    note[seal] = digest_of(note);
    return note.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json parse_sealed(std::string_view text) {
    Json note = parse(text);
    if (!note.is_object() || !note.contains(seal)) return note;
    std::string const written = note::text(note, seal);
    note.erase(seal);
    if (written != digest_of(note))
        throw Fault("it was changed since it was written: its numbers have another SHA-256");
    return note;
}

Json const& object(Json const& note, std::string_view key) {
    return member(note, key, &Json::is_object, "an object");
}

Json const& elements(Json const& note) {
    if (!note.is_array()) throw Fault("it is not a list");
    return note;
}

Json const& list(Json const& note, std::string_view key) {
    return member(note, key, &Json::is_array, "a list");
}

double number(Json const& note, std::string const& key, double least) {
    auto const number = member(note, key, &Json::is_number, "a number").get<double>();
    if (number < least) throw Fault(fmt::format("'{}' is below {}", key, least));
    return number;
}

std::optional<double> known_number(Json const& note, std::string const& key, double least) {
    if (member(note, key).is_null()) return {};
    return number(note, key, least);
}

std::vector<double> numbers(Json const& note, std::string const& key) {
    return all_of<double>(note, key, &Json::is_number, "a number");
}

long whole_number(Json const& note, std::string const& key, long least, long most) {
    Json const& value = member(note, key);
    // JSON has one type for numbers below zero and one for others, which may be larger than a long.
    bool const is_within = value.is_number_integer() && value <= most && value >= least;
    if (!is_within) throw Fault(fmt::format("'{}' is not a whole number from {} to {}", key, least, most));
    return value.get<long>();
}

int count(Json const& note, std::string const& key, int least) {
    return static_cast<int>(whole_number(note, key, least, std::numeric_limits<int>::max()));
}

std::vector<std::string> texts(Json const& note, std::string const& key) {
    return all_of<std::string>(note, key, &Json::is_string, "a text");
}

std::string text(Json const& note, std::string const& key) {
    return member(note, key, &Json::is_string, "a text").get<std::string>();
}

std::string text_if_any(Json const& note, std::string const& key) {
    return note.contains(key) ? text(note, key) : std::string();
}

Json known_or_null(std::optional<double> const& number) {
    return number ? Json(*number) : Json(nullptr);
}

}  // namespace vibrotrough::core::note
