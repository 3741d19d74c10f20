#include "scenario/reader/given_values.hpp"

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Works out the drive of a trough whose keys are set, and checks it.
class TroughChecks {
  public:
    TroughChecks(Trough& trough, GivenKeys const& given) : trough_(trough), given_(given) {}

    void complete() {
        trough_.given.is_stroke = given_.has("trough.stroke");
        trough_.given.is_turns =
            given_.has("trough.frequency") && !given_.unit("trough.frequency").ends_with("Hz");
        set_frequency();
        check_derived("trough.throw_number", throw_number(trough_));
        check_derived("trough.machine_number", machine_number(trough_));
        if (trough_.waveform) check_waveform();
    }

  private:
    void set_frequency() {
        if (given_.has("trough.frequency")) return;
        if (trough_.given.throw_number && trough_.vibration_angle <= 0) {
            given_.fail("trough.throw_number",
                        "a trough that vibrates along its own surface (vibration angle 0) has throw number 0",
                        "write machine_number or frequency instead");
        }
        double const result = frequency_of(trough_);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            given_.fail(
                fmt::format("trough.{}", amplitude_name()),
                fmt::format("the drive would run at {:.4g} Hz, outside the range {}", result, range_of(key)),
                fmt::format("change the {} or the {} number", amplitude_name(),
                            trough_.given.throw_number ? "throw" : "machine"));
        }
        trough_.frequency = result;
    }

    /// The upper bounds of throw and machine number also hold where these numbers are derived from the
    /// frequency or from each other.
    void check_derived(std::string_view path, double value) const {
        Key const& key = *find_key(path);
        if (value <= key.most * (1 + 1e-12)) return;
        for (std::string_view const given :
             {"trough.frequency", "trough.machine_number", "trough.throw_number"}) {
            if (!given_.has(given)) continue;
            given_.fail(given,
                        fmt::format("gives a {} of {:.4g}, outside the range {}", last_name(path), value,
                                    range_of(key)),
                        fmt::format("reduce it or the {}", amplitude_name()));
        }
    }

    void check_waveform() const {
        if (auto const fault = find_fault(*trough_.waveform, trough_))
            given_.fail("trough.waveform", fault->wrong, fault->instead);
    }

    /// The name of the key that was given.
    std::string_view amplitude_name() const { return trough_.given.is_stroke ? "stroke" : "amplitude"; }

    Trough& trough_;
    GivenKeys const& given_;
};

}  // namespace

void complete_trough(Scenario& scenario, GivenKeys const& given) {
    TroughChecks(scenario.trough, given).complete();
}

}  // namespace vibrotrough::scenario
