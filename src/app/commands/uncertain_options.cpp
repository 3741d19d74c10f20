#include "app/commands/uncertain_options.hpp"

#include "app/commands/theory/options.hpp"
#include "core/error.hpp"
#include "core/quantity.hpp"
#include "core/text.hpp"

#include <functional>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

/// The two sides of "+-" or of the sign for it; nothing when the text has neither.
std::optional<std::pair<std::string, std::string>> sides_of(std::string const& text) {
    for (std::string const sign : {"+-", "\u00b1", "+/-"}) {
        auto const at = text.find(sign);
        if (at != std::string::npos) return std::pair{text.substr(0, at), text.substr(at + sign.size())};
    }
    return {};
}

learn::Uncertain read_uncertain(std::string const& option, std::string const& text,
                                std::string const& example,
                                std::function<double(std::string const&)> const& read_mean,
                                std::function<double(std::string const&)> const& read_sd) {
    if (auto const sides = sides_of(text)) return {read_mean(sides->first), read_sd(sides->second)};
    auto const [low, high] = read_range(option, text, example, read_mean);
    return low == high ? learn::Uncertain{low} : learn::between_ends(low, high);
}

}  // namespace

learn::Uncertain read_uncertain_number(std::string const& option, std::string const& text,
                                       std::string const& example, double low, double high) {
    return read_uncertain(
        option, text, example,
        [&](std::string const& one) { return read_number_within(option, one, example, low, high); },
        [&](std::string const& one) { return read_number_within(option, one, example, 0, high); });
}

learn::Uncertain read_uncertain_quantity(std::string const& option, std::string const& text,
                                         std::string const& unit, std::string const& example) {
    auto const read = [&](std::string const& one) {
        return read_positive_quantity(option, one, unit, example);
    };
    auto const sides = sides_of(text);
    if (!sides) return read_uncertain(option, text, example, read, read);
    // The unit of the second stands for both.
    bool const has_unit = sides->first.find_first_not_of("0123456789.eE+- ") != std::string::npos;
    double const sd = read(sides->second);
    try {
        std::string const mean =
            has_unit ? sides->first : fmt::format("{} {}", sides->first, core::unit_of(sides->second));
        return {read(mean), sd};
    } catch (core::QuantityError const&) {
        throw core::InputError(
            fmt::format("{} {}: has no unit; write for example {} \"{}\"", option, text, option, example));
    }
}

}  // namespace vibrotrough::app
