#include "learn/posterior_file.hpp"

#include "core/error.hpp"
#include "learn/notes.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::learn {
PosteriorFriction read_posterior(std::string_view text, std::string const& file) {
    std::string const what_to_give =
        "give what 'vibrotrough theory calibrate speeds.csv --free friction --posterior FILE' writes";
    try {
        CalibratedFriction const known = parse_calibration(text);
        if (!known.converged)
            throw core::InputError(fmt::format(
                "{}: the chains of this calibration have not converged, so that its numbers must not be "
                "used; calibrate again with fewer free quantities, or with narrower priors",
                file));
        if (!known.draws.empty()) return {drawn_friction(known.draws, known.discrepancies), known.model};
        // 95 % of a normal distribution lie within 1.96 standard deviations.
        return {normal_friction(known.median, (known.high - known.low) / (2 * 1.959964)), known.model};
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{}: is not the file of a calibration: {}; {}", file, fault.what(), what_to_give));
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}: {}; {}", file, error.what(), what_to_give));
    }
}

}  // namespace vibrotrough::learn
