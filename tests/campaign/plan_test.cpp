#include "campaign/state/plan.hpp"

#include "campaign/state/added_cases.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> ids_of(std::string const& text, std::string const& engine = "LIGGGHTS 3.8.0") {
    std::vector<std::string> ids;
    for (PlannedCase const& planned :
         make_plan(scenario::parse_campaign(text, "campaign.toml"), "runs/any", engine).cases)
        ids.push_back(planned.id);
    return ids;
}

std::string id_of(std::string const& text) {
    return ids_of(text).at(0);
}

TEST(CaseId, IsTwelveHexadecimalDigitsAndAlwaysTheSame) {
    std::string const id = id_of(example_campaign);
    EXPECT_EQ(id.size(), 12u);
    EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(id_of(example_campaign), id);
}

// Where this changes, what was simulated before is simulated again: say so in CHANGES.md.
TEST(CaseId, OfTodaysCampaignIsTheIdOfToday) {
    EXPECT_EQ(id_of(core::read_file(GOLD_CAMPAIGN)), "85598993cff8");
}

TEST(CaseId, DoesNotDependOnNameFolderCommentsOrUnits) {
    std::string const id = id_of(example_campaign);
    EXPECT_EQ(id_of(with("pvc-horizontal", "another")), id);
    EXPECT_EQ(id_of(with("[trough]", "# a comment\n\n[trough]")), id);
    EXPECT_EQ(id_of(with("\"6 mm\"", "\"0.006 m\"")), id);
    scenario::Campaign const campaign = scenario::parse_campaign(example_campaign, "campaign.toml");
    EXPECT_EQ(make_plan(campaign, "elsewhere", "LIGGGHTS 3.8.0").cases.at(0).id, id);
}

TEST(CaseId, DoesNotDependOnTheOtherCases) {
    auto const swept = ids_of(example_campaign + "[sweep]\n\"trough.throw_number\" = [1.0, 2.0, 3.0]\n");
    auto const reversed = ids_of(example_campaign + "[sweep]\n\"trough.throw_number\" = [3.0, 2.0]\n");
    EXPECT_EQ(swept.at(1), id_of(example_campaign));
    EXPECT_EQ(reversed, (std::vector{swept.at(2), swept.at(1)}));
}

// A search for the capacity adds feeds to a campaign file with one: the rows of a table that tell them apart
// by nothing but their ids would be of no use.
TEST(Plan, AddedFeedsCountAsSwept) {
    core::TemporaryFolder const folder("vibrotrough added");
    std::string text = with("height = \"12 mm\"", "");
    text += "[feed]\nmass_flow = \"0.02 kg/s\"\nlength = \"15 mm\"\nheight = \"40 mm\"\n";
    text.insert(text.find("throw_number"), "side_wall_friction = 0\n");
    scenario::Campaign const campaign = scenario::parse_campaign(text, "campaign.toml");
    Plan plan = make_plan(campaign, folder.path(), "LIGGGHTS 3.8.0");
    EXPECT_TRUE(plan.swept.empty());
    EXPECT_EQ(plan.cases.front().label, "");
    std::string const id = plan.cases.front().id;

    scenario::Scenario more = plan.cases.front().scenario();
    more.feed.mass_flow = 0.04;
    PlannedCase const* const added = add_case(plan, more);
    ASSERT_NE(added, nullptr);
    EXPECT_EQ(added->label, "feed.mass_flow 0.04 kg/s");
    EXPECT_EQ(plan.cases.front().label, "feed.mass_flow 0.02 kg/s");
    EXPECT_EQ(plan.cases.front().id, id);
    // Whoever opens the folder sees the same.
    Plan const again = make_plan(campaign, folder.path(), "LIGGGHTS 3.8.0");
    ASSERT_EQ(again.swept.size(), 1u);
    EXPECT_EQ(again.swept.front()->path, "feed.mass_flow");
    EXPECT_EQ(again.cases.back().label, added->label);
}

TEST(CaseId, ChangesWithEveryInput) {
    std::vector<std::pair<std::string, std::string>> const changes{
        {"inclination = \"0 deg\"", "inclination = \"0.001 deg\""},
        {"30 deg", "30.001 deg"},
        {"6 mm", "6.001 mm"},
        {"throw_number = 2.0", "throw_number = 2.001"},
        {"friction = 0.23", "friction = 0.231"},
        {"restitution = 0.5", "restitution = 0.51"},
        {"diameter = \"3 mm\"", "diameter = \"3.001 mm\""},
        {"diameter_spread = 0.1", "diameter_spread = 0.11"},
        {"1400 kg/m3", "1401 kg/m3"},
        {"5 MPa", "5.001 MPa"},
        {"poisson_ratio = 0.35", "poisson_ratio = 0.36"},
        {"friction = 0.5", "friction = 0.51"},
        {"restitution = 0.5\nrolling", "restitution = 0.51\nrolling"},
        {"rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\""},
        {"rolling_friction = 0.0", "rotation = \"blocked\""},
        {"diameter_spread = 0.1", "shape = \"cube\""},
        {"restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.3"},
        {"restitution = 0.5",
         "restitution = 0.5\nwidth = \"300 mm\""},  // else result.h5 had another mass flow
        {"amplitude", "along_phase = \"1 deg\"\namplitude"},
        {"36 mm", "36.001 mm"},
        {"18 mm", "18.001 mm"},
        {"height = \"12 mm\"", "height = \"12.1 mm\""},
        {"height = \"12 mm\"", "grains = 500"},
        // What is measured and written is part of the case, too.
        {"packings = 3", "packings = 4"},
        {"confidence = 0.95", "confidence = 0.9"},
        {"max_cycles = 200", "max_cycles = 201"},
        {"frames_per_cycle = 0", "frames_per_cycle = 1"},
        {"frames_per_cycle = 0", "frames_per_cycle = 1\nframe_packings = [2]"},
        {"frames_per_cycle = 0", "frames_per_cycle = 1\nframe_packings = \"all\""},
        {"frames_per_cycle = 0", "frames_per_cycle = 1\ncontacts = true"},
    };
    std::set<std::string> ids{id_of(example_campaign)};
    for (auto const& [from, to] : changes) {
        EXPECT_TRUE(ids.insert(id_of(with(from, to))).second) << from << " -> " << to << " kept an id";
    }
    EXPECT_TRUE(ids.insert(ids_of(example_campaign, "LIGGGHTS 3.9.0").at(0)).second) << "engine version";
}

// How the user gave the drive is not part of the case: g = 9.81 m/s2 and r = 6 mm at 30 degrees make 13.6137
// Hz a throw number of 2.
TEST(CaseId, IsOfTheDriveAndNotOfTheKeyThatGaveIt) {
    double const frequency =
        std::sqrt(2 * 9.81 / (0.006 * std::sin(std::acos(-1.0) / 6))) / (2 * std::acos(-1.0));
    scenario::Scenario const given = scenario_of();
    EXPECT_NEAR(given.trough.frequency, frequency, 1e-12);
    EXPECT_EQ(id_of(with("throw_number = 2.0", fmt::format("frequency = \"{} Hz\"", given.trough.frequency))),
              id_of(example_campaign));
    EXPECT_EQ(id_of(with("amplitude = \"6 mm\"", "stroke = \"12 mm\"")), id_of(example_campaign));
}

// What the case may cost is not part of it: more packings continue what is there.
TEST(CaseId, IsNotOfTheLimitsOfItsCost) {
    EXPECT_EQ(id_of(with("max_cycles = 200", "max_cycles = 200\nmax_packings = 48")),
              id_of(example_campaign));
}

TEST(MakePlan, PutsEachCaseBelowTheFolder) {
    scenario::Campaign const campaign = scenario::parse_campaign(example_campaign, "campaign.toml");
    Plan const plan = make_plan(campaign, "runs/x", "LIGGGHTS 3.8.0");
    EXPECT_EQ(plan.name, "pvc-horizontal");
    PlannedCase const& planned = plan.cases.at(0);
    EXPECT_EQ(planned.folder, fs::path("runs/x/cases") / planned.id);
    EXPECT_EQ(planned.result_file(), planned.folder / "result.h5");
    EXPECT_EQ(planned.packing_folder(2), planned.folder / "packing-2");
    EXPECT_EQ(planned.certificate_file(), fs::path("runs/x/certificate.json"));
}

// A case is named by what distinguishes it from the others, and a campaign of one case by nothing.
TEST(MakePlan, NamesCasesByTheirSweptKeys) {
    auto const labels = [](std::string const& sections) {
        std::vector<std::string> names;
        Plan const plan = make_plan(scenario::parse_campaign(example_campaign + sections, "campaign.toml"),
                                    "runs/x", "LIGGGHTS 3.8.0");
        for (PlannedCase const& planned : plan.cases) names.push_back(planned.label);
        return names;
    };
    EXPECT_EQ(labels(""), std::vector<std::string>{""});
    EXPECT_EQ(labels("[sweep]\n\"layer.height\" = [\"9 mm\", \"12 mm\"]\n"),
              (std::vector<std::string>{"layer.height 9 mm", "layer.height 12 mm"}));
}

class OpenPlan : public CampaignFolder {
  protected:
    OpenPlan() {
        overwrite(folder / "given.toml", campaign_text);
        freeze(plan, folder / "given.toml", {"/opt/liggghts", "LIGGGHTS 3.8.0"});
    }

    std::string refusal() const {
        try {
            open_plan(folder);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    }
};

TEST_F(OpenPlan, GivesThePlanThatWasFrozen) {
    EXPECT_EQ(core::read_file(folder / "campaign.toml"), campaign_text);
    Plan const opened = open_plan(folder);
    EXPECT_EQ(opened.name, plan.name);
    EXPECT_EQ(opened.engine_version, plan.engine_version);
    ASSERT_EQ(opened.cases.size(), 1u);
    EXPECT_EQ(opened.cases.at(0).id, planned.id);
    EXPECT_EQ(opened.cases.at(0).folder, planned.folder);
}

TEST_F(OpenPlan, FreezesTheFrozenFileItself) {
    freeze(plan, folder / "campaign.toml", {"/opt/liggghts", "LIGGGHTS 3.8.0"});
    EXPECT_EQ(open_plan(folder).cases.at(0).id, planned.id);
}

TEST_F(OpenPlan, KeepsTheCertificateOfItsEngineOnly) {
    engine::Engine probed{"/opt/liggghts", "LIGGGHTS 3.8.0"};
    probed.certificate = "{}\n";
    freeze(plan, folder / "campaign.toml", probed);
    EXPECT_EQ(core::read_file(planned.certificate_file()), "{}\n");
    freeze(plan, folder / "campaign.toml", {"/opt/other", "LIGGGHTS 3.8.0"});
    EXPECT_FALSE(fs::exists(planned.certificate_file()));
}

TEST_F(OpenPlan, RefusesAFolderThatIsNone) {
    fs::remove(folder / "engine.json");
    EXPECT_NE(refusal().find(folder.string() + " is not a campaign folder"), std::string::npos) << refusal();
    fs::remove_all(folder);
    EXPECT_NE(refusal().find("is not a campaign folder"), std::string::npos) << refusal();
}

TEST_F(OpenPlan, NamesTheDamagedFile) {
    for (char const* damage : {"", "{", "{}", "[]", "3", "{\"version\": 3}", "\xff\xfe"}) {
        overwrite(folder / "engine.json", damage);
        EXPECT_NE(refusal().find("engine.json is damaged; run the campaign again"), std::string::npos)
            << damage << ": " << refusal();
    }
}

TEST_F(OpenPlan, NamesTheMistakeInTheFrozenCampaign) {
    overwrite(folder / "campaign.toml", with("friction = 0.23", "friction = -1"));
    EXPECT_EQ(refusal().find((folder / "campaign.toml").string() + ":9:12: trough.friction"), 0u)
        << refusal();
}

}  // namespace
}  // namespace vibrotrough::campaign
