#include "store/hdf5_file.hpp"
#include "store/schema.hpp"

#include <cmath>
#include <limits>

namespace vibrotrough::store {

namespace {

/// "precise", "not-precise" or "not-steady".
std::string verdict_name(measure::Verdict verdict) {
    switch (verdict) {
        case measure::Verdict::precise:
            return "precise";
        case measure::Verdict::not_precise:
            return "not-precise";
        case measure::Verdict::not_steady:
            return "not-steady";
    }
    throw Hdf5Error("cannot name a verdict of unknown kind");
}

measure::Verdict verdict_of(std::string const& name) {
    for (auto const verdict :
         {measure::Verdict::precise, measure::Verdict::not_precise, measure::Verdict::not_steady}) {
        if (verdict_name(verdict) == name) return verdict;
    }
    throw Hdf5Error("use the verdict '" + name + "', it is unknown");
}

}  // namespace

int to_stored(int value) {
    return value;
}

double to_stored(double value) {
    return value;
}

double to_stored(std::optional<double> const& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string to_stored(std::string const& value) {
    return value;
}

std::string to_stored(measure::Verdict value) {
    return verdict_name(value);
}

void from_stored(int stored, int& value) {
    value = stored;
}

void from_stored(double stored, double& value) {
    value = stored;
}

void from_stored(double stored, std::optional<double>& value) {
    value = std::isfinite(stored) ? std::optional(stored) : std::nullopt;
}

void from_stored(std::string const& stored, std::string& value) {
    value = stored;
}

std::string to_stored(core::Outcome value) {
    return std::string(name_of(value));
}

void from_stored(std::string const& stored, core::Outcome& value) {
    auto const outcome = core::outcome_named(stored);
    if (!outcome || !has_result(*outcome)) throw Hdf5Error("find an outcome with the name '" + stored + "'");
    value = *outcome;
}

void from_stored(std::string const& stored, measure::Verdict& value) {
    value = verdict_of(stored);
}

}  // namespace vibrotrough::store
