#include "campaign/execute/campaign_driver.hpp"

#include "campaign_folder.hpp"

#include <chrono>
#include <deque>
#include <thread>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// Ends packings in the order in which they were submitted, as the test says.
class ScriptedExecutor : public Executor {
  public:
    using Script = std::function<EndedPacking(PackingOrder const&)>;
    /// What makes an executor can capture nothing.
    static inline Script script;                      ///< how a packing ends
    static inline std::vector<int> begun;             ///< numbers of the packings that were run
    static inline bool is_a_cluster;                  ///< whose tasks go on without the driver
    static inline std::vector<RunningPacking> shown;  ///< what it says of what runs

    std::string submit(std::vector<PackingOrder> const& orders) override {
        queue_.insert(queue_.end(), orders.begin(), orders.end());
        return {};
    }
    void withdraw(PlannedCase const& planned) override {
        std::erase_if(queue_, [&](PackingOrder const& order) { return order.planned == &planned; });
    }
    std::vector<EndedPacking> wait() override {
        if (queue_.empty()) return {};
        PackingOrder const order = queue_.front();
        queue_.pop_front();
        begun.push_back(order.packing.number);
        return {script(order)};
    }
    bool is_idle() const override { return queue_.empty(); }
    std::vector<RunningPacking> running() const override { return shown; }
    bool outlives_driver() const override { return is_a_cluster; }

  private:
    std::deque<PackingOrder> queue_;
};

class Silent : public Observer {
  public:
    std::vector<Progress> seen;

    void progressed(Progress const& progress) override { seen.push_back(progress); }
    void case_ended(PlannedCase const&, core::Outcome, std::string const&) override {}
};

/// A campaign of one case with two packings.
class CampaignDriver : public CampaignFolder {
  protected:
    CampaignDriver() { overwrite(campaign_file, campaign_text); }

    Summary run(ScriptedExecutor::Script script, int retries = 0, bool is_a_cluster = false) {
        ScriptedExecutor::script = std::move(script);
        ScriptedExecutor::is_a_cluster = is_a_cluster;
        ScriptedExecutor::begun.clear();
        ExecutorInputs inputs{folder, {"liggghts", "LIGGGHTS 3.8.0"}, {}, 1, {}};
        inputs.settings.retries = retries;
        ExecutorKind const kind{"local", [](ExecutorInputs const&) -> std::unique_ptr<Executor> {
                                    return std::make_unique<ScriptedExecutor>();
                                }};
        observer = {};
        ScriptedExecutor::shown.clear();
        return run_campaign(plan, campaign_file, *make_policy(), kind, inputs, Until::done, observer);
    }

    static auto failing(core::Outcome outcome) {
        return [=](PackingOrder const& order) { return EndedPacking{order.id(), outcome, "as it was told"}; };
    }

    Silent observer;
    fs::path campaign_file = own_folder.path() / "campaign.toml";
};

// A packing whose engine crashed is run again as often as run.retries says, and not once more.
TEST_F(CampaignDriver, TriesAgainAsOftenAsAsked) {
    for (int const retries : {0, 2}) {
        fs::remove_all(folder);
        EXPECT_EQ(run(failing(core::Outcome::engine_crashed), retries).failed, 1);
        auto const tried = std::ranges::count(ScriptedExecutor::begun, ScriptedExecutor::begun.front());
        EXPECT_EQ(tried, 1 + retries);
    }
}

// One packing that cannot succeed decides about its case: the others of it are not begun.
TEST_F(CampaignDriver, GivesUpTheOtherPackingsOfACaseThatFailed) {
    EXPECT_EQ(run(failing(core::Outcome::lost_grains)).failed, 1);
    EXPECT_EQ(ScriptedExecutor::begun, (std::vector<int>{1}));
}

// An engine on a busy machine has less than a core of its own: what is left costs core-hours as what was
// done.
TEST_F(CampaignDriver, EstimatesTheCostFromTheCostSoFar) {
    int tries = 0;
    auto const busy = [&](PackingOrder const& order) {
        ScriptedExecutor::shown.clear();
        if (tries++ == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1100));
            RunningPacking one{order.planned, order.packing.number, 1, order.packing.cycles, {}, 1.1, 1, 1};
            one.core_time = 0.11;
            ScriptedExecutor::shown = {one};
        }
        return EndedPacking{order.id(), core::Outcome::engine_crashed, "as it was told", 0, 0.04};
    };
    run(busy, 1);
    auto const known = std::ranges::find_if(
        observer.seen, [](Progress const& one) { return one.time_to_go > 0 && !one.engines.empty(); });
    ASSERT_NE(known, observer.seen.end());
    EXPECT_NEAR(known->core_time, 0.15, 1e-12);
    EXPECT_NEAR(known->core_time_to_go, known->time_to_go * 0.15 / known->elapsed, 1e-12);
}

// Files that are damaged are found when the result is made. Their packing is then unfinished again, and is
// run once more, alone: were its marker left, a task of a cluster, which empties no folder, would not run
// what is marked as finished.
TEST_F(CampaignDriver, RunsADamagedPackingAgainWithoutItsMarker) {
    int marked = 0;
    auto const damaged = [&](PackingOrder const& order) {
        fs::path const packing = planned.packing_folder(order.packing.number);
        marked += evaluate::has_marker(packing) ? 1 : 0;
        overwrite(packing / "in.liggghts", "# deck\n");
        overwrite(packing / "cycles.csv",
                  cycles_text(scenario, order.packing.cycles, [](int k) { return 0.5 + 0.01 * (k % 2); }));
        overwrite(packing / "phases.csv", "no table\n");
        evaluate::write_marker(evaluate::read_packing_files(packing), {});
        return EndedPacking{order.id(), {}, "", order.packing.cycles};
    };
    EXPECT_THROW(run(damaged, 0, true), core::InputError) << "damaged a second time";
    EXPECT_EQ(ScriptedExecutor::begun, (std::vector<int>{1, 2, 1})) << "the second was not looked at";
    EXPECT_EQ(marked, 0);
}

}  // namespace
}  // namespace vibrotrough::campaign
