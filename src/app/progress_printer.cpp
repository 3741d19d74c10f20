#include "app/progress_printer.hpp"

#include "app/standard_streams.hpp"

#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

using namespace std::chrono_literals;

/// Whether a time to go is known and not over: "0:00 to go" of something that still runs would be wrong.
bool is_worth_telling(double time_to_go) {
    return time_to_go >= 1;
}

/// A case by what distinguishes it.
std::string const& name_of(campaign::PlannedCase const& planned) {
    return planned.label.empty() ? planned.id : planned.label;
}

std::string describe(campaign::Progress const& progress) {
    std::string text = fmt::format("{} done, {} running, {} waiting", progress.finished, progress.running,
                                   std::max(0, progress.left - progress.running));
    if (progress.failed > 0) text += fmt::format(", {} failed", progress.failed);
    text += fmt::format("; packings {}/{}; {} elapsed", progress.packings_done, progress.packings,
                        clock_time(progress.elapsed));
    if (is_worth_telling(progress.time_to_go)) {
        text += fmt::format(", about {} to go; {:.3g} core-hours spent, {:.3g} to go",
                            clock_time(progress.time_to_go), progress.core_time / 3600,
                            progress.core_time_to_go / 3600);
    }
    return text;
}

/// "  throw_number 2, packing 2: cycle 21 of 24, eta 0.793 +- 0.051, 0:12 elapsed, about 0:04 to go"
std::string describe(campaign::RunningPacking const& one) {
    std::string text = fmt::format("  {}, packing {}: ", name_of(*one.planned), one.packing);
    text += one.is_moving ? fmt::format("cycle {} of {}", one.cycles, one.cycles_wanted)
                          : "settling, before the trough moves";
    // One efficiency says nothing of a drive that changes in stages.
    bool const is_steady = one.planned->scenario().stages.empty();
    if (is_steady && one.estimate && std::isfinite(one.estimate->mean)) {
        text += fmt::format(", eta {:.3f}", one.estimate->mean);
        if (std::isfinite(one.estimate->half_width))
            text += fmt::format(" +- {:.3f}", one.estimate->half_width);
    }
    text += fmt::format(", {} elapsed", clock_time(one.elapsed));
    if (is_worth_telling(one.time_to_go)) text += fmt::format(", about {} to go", clock_time(one.time_to_go));
    return text;
}

/// One line for each running packing, 20 at most, and the totals below.
std::vector<std::string> describe_all(campaign::Progress const& progress) {
    constexpr std::size_t most = 20;
    std::vector<std::string> lines;
    for (auto const& one : progress.engines) {
        if (lines.size() == most) {
            lines.push_back(fmt::format("  and {} more", progress.engines.size() - most));
            break;
        }
        lines.push_back(describe(one));
    }
    lines.push_back(describe(progress));
    return lines;
}

}  // namespace

std::string clock_time(double seconds) {
    long const whole = std::lround(seconds);
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

ProgressPrinter::ProgressPrinter()
    : terminal_(::isatty(STDERR_FILENO) != 0), printed_(std::chrono::steady_clock::now() - 1h) {}

ProgressPrinter::~ProgressPrinter() {
    clear_lines();
}

void ProgressPrinter::progressed(campaign::Progress const& progress) {
    auto const now = std::chrono::steady_clock::now();
    if (!terminal_ && now - printed_ < 10s) return;
    std::vector<std::string> lines = describe_all(progress);
    if (lines == lines_) return;
    clear_lines();
    for (std::string const& line : lines) {
        bool const is_last = &line == &lines.back();
        tell("{}{}", line, is_last && terminal_ ? "" : "\n");
    }
    lines_ = std::move(lines);
    printed_ = now;
}

void ProgressPrinter::case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                                 std::string const& message) {
    clear_lines();
    tell("case {}{}: {}{}{}\n", planned.id, planned.label.empty() ? "" : fmt::format(" ({})", planned.label),
         core::name_of(outcome), message.empty() ? "" : ": ", message);
}

void ProgressPrinter::noticed(campaign::PlannedCase const& planned, std::string const& message) {
    clear_lines();
    tell("case {}: {}\n", planned.id, message);
}

void ProgressPrinter::stopping() {
    clear_lines();
    tell("stopping: the engines end the cycles that they are in; Ctrl-C again stops them at once\n");
}

void ProgressPrinter::clear_lines() {
    if (terminal_ && !lines_.empty()) {
        tell_text("\r\x1b[K");
        for (std::size_t i = 1; i < lines_.size(); ++i) tell_text("\x1b[A\x1b[K");
    }
    lines_.clear();
}

}  // namespace vibrotrough::app
