#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/given_values.hpp"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

// How a row of the table of keys says where its value is: field<&Scenario::trough, &Trough::friction>. The
// type of the member decides how it is read and written. Internal to this room.

namespace vibrotrough::scenario {

/// A member as the value of a key; none for an optional member without value and an empty list.
template <typename Member>
std::optional<Content> content_of(Member const& member) {
    if constexpr (std::is_enum_v<Member>) {
        return Content(std::string(name_of(member)));
    } else if constexpr (std::is_arithmetic_v<Member>) {
        return Content(static_cast<double>(member));
    } else {
        return Content(member);
    }
}

template <typename Member>
std::optional<Content> content_of(std::optional<Member> const& member) {
    return member ? content_of(*member) : std::nullopt;
}

template <typename Element>
std::optional<Content> content_of(std::vector<Element> const& list) {
    return list.empty() ? std::nullopt : std::optional<Content>(list);
}

/// Puts the value of a key into a member.
inline void take(double& member, GivenValue const& value) {
    member = value.number();
}
inline void take(int& member, GivenValue const& value) {
    member = value.whole();
}
inline void take(bool& member, GivenValue const& value) {
    member = value.number() != 0;
}
inline void take(std::string& member, GivenValue const& value) {
    member = value.word();
}
inline void take(std::vector<double>& member, GivenValue const& value) {
    member = value.numbers();
}

template <typename Member>
void take(std::optional<Member>& member, GivenValue const& value) {
    take(member.emplace(), value);
}

/// The enumerator with this name. Its numbers begin at 0 without a gap, and the reader has checked that the
/// word is one of the key's; name_of() throws if no enumerator has this name.
template <typename Member>
requires std::is_enum_v<Member>
void take(Member& member, GivenValue const& value) {
    int number = 0;
    while (name_of(static_cast<Member>(number)) != value.word()) ++number;
    member = static_cast<Member>(number);
}

/// A key whose value is a member of a case: field<&Scenario::trough, &Trough::friction> is
/// scenario.trough.friction.
template <auto... members>
constexpr InCase field{[](Scenario const& s) { return content_of((s.*....*members)); },
                       [](Scenario& s, GivenValue const& value) { take((s.*....*members), value); }};

/// The same for a key of [run] and RunSettings: Key::set_run.
template <auto... members>
constexpr auto run_field = +[](RunSettings& s, GivenValue const& value) { take((s.*....*members), value); };

/// A file that a key names, read once for all cases.
/// @param known   the files that were read for other cases
/// @param read    turns its text into what it means; throws std::invalid_argument when it is wrong
/// @param advice  what to write instead of a wrong text
template <typename File>
std::shared_ptr<File const> read_once(std::map<std::string, std::shared_ptr<File const>>& known,
                                      std::shared_ptr<File const> (*read)(NamedFile), GivenValue const& value,
                                      std::string_view advice) {
    std::shared_ptr<File const>& file = known[value.word()];
    try {
        if (!file) file = read(value.file(value.word()));
    } catch (std::invalid_argument const& error) {
        value.fail(value.word() + ": " + error.what(), advice);
    }
    return file;
}

/// The rows of the table by the sections that they describe.
std::span<Key const> trough_keys();
std::span<Key const> grains_keys();  ///< [grains] and [layer]
std::span<Key const> plan_keys();    ///< [measure], [output], [solver] and [engine]

}  // namespace vibrotrough::scenario
