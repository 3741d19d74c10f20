#include "learn/capacity.hpp"

#include "app/commands/command.hpp"
#include "app/learning.hpp"
#include "app/progress_log.hpp"
#include "campaign/state/added_cases.hpp"
#include "campaign/state/overview.hpp"
#include "campaign/state/result_summary.hpp"
#include "scenario/reader/case_maker.hpp"

#include <set>

namespace vibrotrough::app {
namespace {

constexpr char const* feed_key = "feed.mass_flow";
constexpr double kg_per_s_in_t_per_h = 3.6;

struct CapacityArguments {
    RunOptions shared;
    QuantityOptions quantities;
    bool as_json = false;
};

/// A feed that was tried, and how it ended.
struct TriedFeed {
    learn::FeedTrial trial;
    std::string ending;  ///< the outcome's name
    std::string why;     ///< in words; empty for what was carried
};

/// @throws core::InputError unless the campaign is one open trough, at one or several feeds
void check_campaign(std::string const& file, scenario::CaseMaker const& maker) {
    for (std::string const& key : maker.varied_keys()) {
        if (key != feed_key)
            throw core::InputError(fmt::format(
                "{}: {} is varied, but only {} may be; search for each of its values with a campaign "
                "file of its own",
                file, key, feed_key));
    }
    for (scenario::Scenario const& s : scenario::read_campaign(file).cases) {
        if (!scenario::is_open(s))
            throw core::InputError(
                fmt::format("{}: only an open trough has a capacity; write a section [feed] ('vibrotrough "
                            "init open' has one)",
                            file));
        if (!s.stages.empty())
            throw core::InputError(fmt::format(
                "{}: the capacity is that of a drive and a feed that never end; remove [[stages]]", file));
        if (!s.feed.height)
            throw core::InputError(
                fmt::format("{}: feed.height is missing: the trough is full when the layer reaches the place "
                            "where the feed falls from, so the capacity depends on it; write for example "
                            "feed.height = \"60 mm\"",
                            file));
    }
}

/// The search over the feeds of one campaign.
class CapacitySearch {
  public:
    /// @param maker  of the campaign, which was checked
    CapacitySearch(CapacityArguments const& options, double precision, scenario::CaseMaker const& maker)
        : options_(options), precision_(precision), maker_(maker), ready_(prepare_run(options.shared)) {}

    /// @return the exit code
    int run() {
        std::map<std::string, double> wanted;
        if (ready_.is_interrupted) return interrupted;
        double const first = *ready_.plan.cases.front().scenario().feed.mass_flow;
        while (true) {
            if (!simulate_feeds(wanted)) return interrupted;
            look();
            auto const feed = learn::next_feed(trials(), first, precision_);
            if (!feed) return conclude();
            if (!add(*feed)) return conclude();
        }
    }

  private:
    /// Simulates the feeds that have not ended. A failed case would be run again, and one that was overfull
    /// would be so again. @return false when a signal stopped it
    bool simulate_feeds(std::map<std::string, double>& wanted) {
        std::set<std::string> overfull;
        for (campaign::CaseOverview const& one :
             campaign::survey(ready_.plan, campaign::activity_in(ready_.plan.folder)))
            if (one.outcome == core::Outcome::overfull) overfull.insert(one.planned->id);
        auto const all = ready_.plan.cases;
        std::erase_if(ready_.plan.cases, [&](auto const& one) { return overfull.contains(one.id); });
        bool const goes_on = ready_.plan.cases.empty() || simulate(options_.shared, ready_, wanted);
        ready_.plan.cases = all;
        if (goes_on) campaign::write_campaign_file(ready_.plan);
        return goes_on;
    }

    /// Reads how all feeds ended. @throws core::MissingError when one ended for a reason of its own
    void look() {
        tried_.clear();
        auto const cases = campaign::survey(ready_.plan, campaign::activity_in(ready_.plan.folder));
        for (campaign::CaseOverview const& one : cases) {
            double const feed = *one.planned->scenario().feed.mass_flow;
            auto const summary = campaign::find_summary(*one.planned);
            bool const is_overfed =
                one.outcome && learn::is_overfed(*one.outcome, summary ? &summary->record : nullptr);
            if (!is_overfed && one.status != campaign::CaseStatus::ended)
                throw core::MissingError(fmt::format("the feed of {:.4g} t/h has no result ({}): {}",
                                                     feed * kg_per_s_in_t_per_h, one.label(), one.message));
            bool const found_no_room =
                is_overfed && one.status == campaign::CaseStatus::ended && one.message.empty();
            tried_.push_back(
                {{feed, !is_overfed},
                 std::string(one.label()),
                 found_no_room ? "a part of the feed found no room above the layer" : one.message});
        }
        std::ranges::sort(tried_, {}, [](TriedFeed const& one) { return one.trial.mass_flow; });
        if (!options_.as_json) print_new();
    }

    void print_new() {
        for (TriedFeed const& one : tried_) {
            if (!shown_.insert(one.trial.mass_flow).second) continue;
            fmt::print("{:>8.4g} t/h  {:<12}  {}{}\n", one.trial.mass_flow * kg_per_s_in_t_per_h,
                       one.trial.is_carried ? "carried" : "not carried", one.ending,
                       one.why.empty() ? "" : ": " + one.why);
        }
        std::fflush(stdout);
    }

    std::vector<learn::FeedTrial> trials() const {
        std::vector<learn::FeedTrial> all;
        for (TriedFeed const& one : tried_) all.push_back(one.trial);
        return all;
    }

    /// Adds the case with a feed, unless there can be no such case. @return whether it is new
    bool add(double feed) {
        try {
            return campaign::add_case(ready_.plan, maker_.make({{feed_key, feed}})) != nullptr;
        } catch (core::InputError const& error) {
            limit_ =
                fmt::format("{:.4g} t/h cannot be simulated: {}", feed * kg_per_s_in_t_per_h, error.what());
            return false;
        }
    }

    int conclude() const {
        learn::CapacityBounds const bounds = learn::capacity_bounds(trials());
        bool const is_known = bounds.carried && bounds.refused;
        auto const in_t_per_h = [](double flow) { return flow * kg_per_s_in_t_per_h; };
        std::string text;
        if (is_known)
            text = fmt::format("the trough carries {:.4g} t/h and not {:.4g} t/h",
                               in_t_per_h(*bounds.carried), in_t_per_h(*bounds.refused));
        else if (bounds.carried)
            text = fmt::format("the trough carries {:.4g} t/h; no larger feed was simulated",
                               in_t_per_h(*bounds.carried));
        else
            text = fmt::format("the trough does not even carry {:.4g} t/h", in_t_per_h(*bounds.refused));
        if (bounds.contradiction)
            text += fmt::format("; it carried {:.4g} t/h, too: near the capacity it depends on chance",
                                in_t_per_h(*bounds.contradiction));
        if (!limit_.empty()) text += "; " + limit_;
        CampaignLog(ready_.plan.folder).info("capacity: " + text);
        if (options_.as_json)
            print_json(bounds);
        else
            fmt::print("{}\nflows, depths and residence times of all feeds: vibrotrough compare {}\n", text,
                       core::shell_word(ready_.plan.folder));
        return is_known ? all_well : some_cases_failed;
    }

    void print_json(learn::CapacityBounds const& bounds) const {
        nlohmann::ordered_json answer;
        answer["carried_kg_per_s"] = number_or_null(bounds.carried);
        answer["not_carried_kg_per_s"] = number_or_null(bounds.refused);
        answer["limit"] = limit_;
        answer["feeds"] = nlohmann::ordered_json::array();
        for (TriedFeed const& one : tried_)
            answer["feeds"].push_back({{"mass_flow_kg_per_s", one.trial.mass_flow},
                                       {"carried", one.trial.is_carried},
                                       {"outcome", one.ending},
                                       {"message", one.why}});
        fmt::print("{}\n", answer.dump(2));
    }

    CapacityArguments const& options_;
    double precision_;
    scenario::CaseMaker const& maker_;
    ReadyCampaign ready_;
    std::vector<TriedFeed> tried_;
    std::string limit_;       ///< why the next feed cannot be simulated
    std::set<double> shown_;  ///< feeds whose lines are printed
};

}  // namespace

void add_capacity(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<CapacityArguments>();
    CLI::App* const command =
        program.add_subcommand("capacity", "Find the largest feed that an open trough carries away");
    options->shared.add_to(*command);
    options->quantities.add_to(*command, {{"--precision"}});
    command->add_flag("--json", options->as_json, "Print one JSON object instead of a table");
    command->footer(
        R"(The campaign file describes one open trough with a section [feed], which must say feed.height: the trough is full
when the layer reaches it. The search begins with the feed of the file, doubles it while what is fed also leaves the
trough, halves it while it does not, and then tries the geometric mean of the two, until both are within --precision.
A feed is not carried when its case ends as 'overfull', when more than 3 % of it found no room, or as 'not-steady'
because the outflow is less than the inflow after measure.max_cycles. Near the capacity a trough fills slowly, so more
cycles make the answer sharper.

Every feed is a case of the campaign: 'compare', 'report' and 'export' show them all, and feeds of a [sweep] over
feed.mass_flow count as well. Ctrl-C stops cleanly, and the same command continues.

Example:
  vibrotrough capacity open.toml --jobs 2        # with the file of 'vibrotrough init open')");
    command->callback([options, &exit_code] {
        double const precision = options->quantities.value("--precision").value_or(0.1);
        scenario::CaseMaker const maker(options->shared.campaign_file);
        check_campaign(options->shared.campaign_file, maker);
        exit_code = CapacitySearch(*options, precision, maker).run();
    });
}

}  // namespace vibrotrough::app
