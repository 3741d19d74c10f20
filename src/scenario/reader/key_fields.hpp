#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/given_values.hpp"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

// How a row of the table of keys says where its value is: field<&Scenario::trough, &Trough::friction>. The
// type of the member decides how it is read and written. Internal to this module.

namespace vibrotrough::scenario {

template <typename Type>
constexpr bool is_optional_member = false;  ///< Whether a member is an optional one.
template <typename Type>
constexpr bool is_optional_member<std::optional<Type>> = true;  ///< It is.

/// A member as the value of a key; none for an optional member without value and an empty list.
template <typename Member>
std::optional<Content> content_of(Member const& member) {
    if constexpr (is_optional_member<Member>) {
        return member ? content_of(*member) : std::nullopt;
    } else if constexpr (std::is_enum_v<Member>) {
        return Content(std::string(name_of(member)));
    } else if constexpr (std::is_arithmetic_v<Member>) {
        return Content(static_cast<double>(member));
    } else if constexpr (std::is_same_v<Member, std::string>) {
        return Content(member);
    } else {
        return member.empty() ? std::nullopt : std::optional<Content>(member);
    }
}

/// Puts the value of a key into a member. For an enum it is the enumerator with this name: the reader has
/// checked that the word is one of the key's, and name_of() throws when there is no further enumerator.
template <typename Member>
void take(Member& member, GivenValue const& value) {
    if constexpr (is_optional_member<Member>) {
        take(member.emplace(), value);
    } else if constexpr (std::is_enum_v<Member>) {
        int number = 0;
        while (name_of(static_cast<Member>(number)) != value.word()) ++number;
        member = static_cast<Member>(number);
    } else if constexpr (std::is_same_v<Member, bool>) {
        member = value.number() != 0;
    } else if constexpr (std::is_same_v<Member, int>) {
        member = value.whole();
    } else if constexpr (std::is_same_v<Member, double>) {
        member = value.number();
    } else if constexpr (std::is_same_v<Member, std::string>) {
        member = value.word();
    } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
        member = value.words();
    } else {
        member = value.numbers();
    }
}

/// A key whose value is a member of a case: field<&Scenario::trough, &Trough::friction> is
/// scenario.trough.friction.
template <auto... members>
constexpr KeyAccess field{[](Scenario const& s) { return content_of((s.*....*members)); },
                          [](Scenario& s, GivenValue const& value) { take((s.*....*members), value); }};

/// The same for a key of [run], whose value is a member of RunSettings.
template <auto... members>
constexpr KeyAccess run_field{
    .set_run = [](RunSettings& s, GivenValue const& value) { take((s.*....*members), value); }};

/// The entry of a list with this index, which is made when there is none.
template <typename Entry>
Entry& entry_of(std::vector<Entry>& list, std::size_t index) {
    if (list.size() <= index) list.resize(index + 1);
    return list[index];
}

/// A member of the entries of a list of the case: entry_field<&Scenario::materials, &AddedMaterial::name>.
template <auto list, auto member>
constexpr KeyAccess entry_field{
    .get_entry = [](Scenario const& s, std::size_t i) -> std::optional<Content> {
        return (s.*list).size() > i ? content_of((s.*list)[i].*member) : std::nullopt;
    },
    .set_entry = [](Scenario& s, std::size_t i,
                    GivenValue const& value) { take(entry_of(s.*list, i).*member, value); }};

/// The condition of a key that to_toml() never writes, because another key of its group says the same.
inline bool never(Scenario const&) {
    return false;
}

/// What is made of the files that a key names, once for all cases. Several cases may be made at once.
template <typename File>
using KnownFiles = std::map<std::vector<std::string>, std::shared_ptr<File const>>;

/// @param known   what was made for other cases, by the names of the files
/// @param read    makes it; throws std::invalid_argument when a file is wrong
/// @param advice  what to write instead of a wrong file
template <typename File, typename Read>
std::shared_ptr<File const> read_once(KnownFiles<File>& known, GivenValue const& value,
                                      std::vector<std::string> const& names, Read const& read,
                                      std::string_view advice) {
    std::lock_guard const one_case(value.files_read().one_case);
    std::shared_ptr<File const>& file = known[names];
    try {
        if (!file) {
            std::vector<NamedFile> files;
            for (std::string const& name : names) files.push_back(value.file(name));
            file = read(std::move(files));
        }
    } catch (std::invalid_argument const& error) {
        value.fail(fmt::format("{}: {}", fmt::join(names, ", "), error.what()), advice);
    }
    return file;
}

/// The waveform that a key of the trough or of a stage names.
inline std::shared_ptr<Waveform const> waveform_of(GivenValue const& value) {
    return read_once(
        value.files_read().waveforms, value, {value.word()},
        [](std::vector<NamedFile> files) { return read_waveform(std::move(files.front())); },
        waveform_advice);
}

/// The rows of the table by the sections that they describe.
std::span<Key const> trough_keys();
std::span<Key const> grains_keys();    ///< [grains], [layer], [feed] and [screen]
std::span<Key const> material_keys();  ///< of an entry of [[materials]]: the path is the name alone
std::span<Key const> pair_keys();      ///< of an entry of [[pairs]], likewise
std::span<Key const> stage_keys();     ///< of an entry of [[stages]], likewise
std::span<Key const> plan_keys();      ///< [measure], [output], [solver] and [engine]

}  // namespace vibrotrough::scenario
