#pragma once

#include "core/error.hpp"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

/// Notes: files of JSON that this program writes and reads again, in whose place anything may lie by then.
/// All of them are read through here, so that each either holds what its reader asks for or has a fault with
/// a name. Numbers are finite, because JSON has no other ones.
namespace vibrotrough::core::note {

/// A value of JSON whose members keep their order.
using Json = nlohmann::ordered_json;

/// Why a note cannot be believed: one printable line, such as "'cycle' is not a whole number from 1 to 9".
class Fault : public InputError {
  public:
    using InputError::InputError;
};

/// The value that a text holds. @throws Fault unless it is JSON
Json parse(std::string_view text);

/// The text of a note, an object, with the SHA-256 of the rest as its last member, by which parse_sealed()
/// sees whether a number was edited since.
std::string sealed(Json note);
/// The value that such a text holds, or that an older program wrote without a digest.
/// @throws Fault when it is not JSON, or another content than was written
Json parse_sealed(std::string_view text);

/// A member that is an object. @throws Fault when it is missing or something else
Json const& object(Json const& note, std::string_view key);
/// A member that is a list. @throws Fault when it is missing or something else
Json const& list(Json const& note, std::string_view key);

/// The values of a list. @throws Fault when the note is something else
Json const& elements(Json const& note);

/// A number. @throws Fault when it is missing, something else, or below `least`
double number(Json const& note, std::string const& key, double least = std::numeric_limits<double>::lowest());
/// The same where null stands for a number that is not known. @throws Fault as number()
std::optional<double> known_number(Json const& note, std::string const& key,
                                   double least = std::numeric_limits<double>::lowest());
/// The numbers of a list. @throws Fault when one is something else
std::vector<double> numbers(Json const& note, std::string const& key);

/// A whole number from `least` on. @throws Fault when it is missing, something else, or too large
int count(Json const& note, std::string const& key, int least);
/// The same for larger ones, such as the ids of jobs.
long whole_number(Json const& note, std::string const& key, long least,
                  long most = std::numeric_limits<long>::max());

/// The texts of a list. @throws Fault when one is something else
std::vector<std::string> texts(Json const& note, std::string const& key);

/// A text as it stands. @throws Fault when it is missing or something else
std::string text(Json const& note, std::string const& key);
/// The same where the text may be missing and then is empty. @throws Fault when it is something else
std::string text_if_any(Json const& note, std::string const& key);

/// A number that may not be known, as null then.
Json known_or_null(std::optional<double> const& number);

}  // namespace vibrotrough::core::note
