#include "app/progress_printer.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

using namespace std::chrono_literals;

std::string describe(campaign::Progress const& progress) {
    std::string text = fmt::format("{} done, {} engines running, {} left", progress.finished,
                                   progress.running, progress.left);
    if (progress.failed > 0) text += fmt::format(", {} failed", progress.failed);
    text += fmt::format("; packings {}/{}; {} gone", progress.packings_done, progress.packings,
                        clock_time(progress.elapsed));
    if (progress.time_to_go >= 0) text += fmt::format(", about {} to go", clock_time(progress.time_to_go));
    return text;
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
    clear_line();
}

void ProgressPrinter::progressed(campaign::Progress const& progress) {
    auto const now = std::chrono::steady_clock::now();
    std::string const line = describe(progress);
    if (line == line_ || (!terminal_ && now - printed_ < 10s)) return;
    clear_line();
    if (terminal_) {
        fmt::print(stderr, "{}", line);
        std::fflush(stderr);
    } else {
        fmt::print(stderr, "{}\n", line);
    }
    line_ = line;
    printed_ = now;
}

void ProgressPrinter::case_ended(campaign::PlannedCase const& planned, std::string const& outcome,
                                 std::string const& message) {
    clear_line();
    Trough const& trough = planned.scenario.trough;
    constexpr double degrees = 180 / std::numbers::pi;
    fmt::print(stderr,
               "case {} (throw number {:.4g}, vibration angle {:.4g} deg, inclination {:.4g} deg): {}{}{}\n",
               planned.id, throw_number(trough), trough.vibration_angle * degrees,
               trough.inclination * degrees, outcome, message.empty() ? "" : ": ", message);
}

void ProgressPrinter::clear_line() {
    if (terminal_ && !line_.empty()) fmt::print(stderr, "\r\x1b[K");
    line_.clear();
}

}  // namespace vibrotrough::app
