#include "engine/probe.hpp"

#include "core/atomic_file.hpp"
#include "core/temporary_folder.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "engine/probe_decks.hpp"
#include "engine/probe_output.hpp"
#include "engine/probe_verdicts.hpp"
#include "engine/stop_signals.hpp"
#include "engine/three_grains.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;

/// An engine that needs longer than this for one of the decks is considered to hang.
constexpr std::chrono::seconds patience{120};

/// Runs decks side by side and remembers what became of each.
class DeckRunner {
  public:
    DeckRunner(Engine const& engine, fs::path const& folder) : engine_(engine), folder_(folder) {}

    /// Returns false if it was interrupted.
    bool run(std::vector<ProbeDeck> const& decks) {
        context_.restart();
        boost::asio::signal_set signals(context_);
        add_stop_signals(signals);
        boost::asio::steady_timer clock(context_, patience);
        bool interrupted = false;
        std::size_t left = decks.size();
        std::vector<std::unique_ptr<EngineProcess>> running;
        auto const stop = [&] {
            for (auto const& process : running) process->terminate();
        };
        signals.async_wait([&](auto const& cancelled, int) {
            if (cancelled) return;
            interrupted = true;
            stop();
        });
        clock.async_wait([&](auto const& cancelled) {
            if (!cancelled) stop();
        });
        for (ProbeDeck const& deck : decks) {
            fs::path const own = folder_ / deck.name;
            core::make_folder(own);
            for (auto const& [name, content] : deck.files) core::write_file_atomically(own / name, content);
            running.push_back(
                std::make_unique<EngineProcess>(context_, engine_, own, [&, own](ExitStatus status) {
                    problems_[own.filename().string()] = problem_of_run(own, status);
                    if (--left > 0) return;
                    signals.cancel();
                    clock.cancel();
                }));
        }
        context_.run();
        return !interrupted;
    }

    std::string problem(std::string const& deck) const { return problems_.at(deck); }

  private:
    Engine const& engine_;
    fs::path const& folder_;
    boost::asio::io_context context_;
    std::map<std::string, std::string> problems_;
};

/// CPU time of all child processes that have ended, s.
double cpu_time_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    auto const seconds = [](timeval const& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

int grains_at_end(fs::path const& transcript) {
    std::istringstream file(text_of_output(transcript));
    int grains = 0;
    for (std::string line, word; std::getline(file, line);) {
        long step = 0;
        if (line.starts_with("VIBROTROUGH DONE"))
            std::istringstream(line) >> word >> word >> word >> step >> word >> grains;
    }
    return grains;
}

/// Runs the layer for few and for many steps, one after the other, so that the difference does not include
/// the start of the engine. Returns false if interrupted; the speed stays unknown if the engine fails.
bool measure_speed(DeckRunner& runner, fs::path const& folder, Certificate& certificate) {
    constexpr int few = 2000, many = 6000;  // after 2000 steps the columns have collapsed into a layer
    double const start = cpu_time_of_children();
    ProbeDeck const small = speed_deck(few), large = speed_deck(many);
    if (!runner.run({small})) return false;
    double const between = cpu_time_of_children();
    if (!runner.run({large})) return false;
    double const spent = (cpu_time_of_children() - between) - (between - start);
    if (!runner.problem(small.name).empty() || !runner.problem(large.name).empty()) return true;
    certificate.speed_grains = grains_at_end(folder / large.name / output_file);
    if (spent > 0)
        certificate.grain_steps_per_cpu_second = certificate.speed_grains * double(many - few) / spent;
    return true;
}

}  // namespace

std::optional<Certificate> probe_engine(Engine const& engine, EngineIdentity const& identity) {
    using Judge = std::vector<ProbeResult> (*)(fs::path const&, std::string const&);
    std::vector<std::pair<ProbeDeck, Judge>> const questions{{fine_impact_deck(), judge_fine_impacts},
                                                             {coarse_impact_deck(), judge_coarse_impacts},
                                                             {incline_deck(), judge_incline},
                                                             {contact_deck(), judge_contact},
                                                             {drive_deck(), judge_drive},
                                                             {gap_roll_deck(), judge_gap_roll},
                                                             {nip_deck(), judge_nip}};
    Certificate certificate{identity,
                            std::string(core::program_version()),
                            std::string(core::program_commit()),
                            core::host_name(),
                            core::utc_now(),
                            0,
                            0,
                            {}};
    core::TemporaryFolder const folder("vibrotrough-probe");
    DeckRunner runner(engine, folder.path());
    std::vector<ProbeDeck> decks;
    for (auto const& [deck, judge] : questions) decks.push_back(deck);
    if (!runner.run(decks)) return {};
    for (auto const& [deck, judge] : questions) {
        for (ProbeResult const& result : judge(folder.path() / deck.name, runner.problem(deck.name)))
            certificate.probes.push_back(result);
    }
    if (certificate.passed() && !measure_speed(runner, folder.path(), certificate)) return {};
    return certificate;
}

}  // namespace vibrotrough::engine
