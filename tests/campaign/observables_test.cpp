#include "campaign/state/observables.hpp"

#include "campaign/state/notes.hpp"
#include "campaign/state/overview.hpp"
#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <gmock/gmock.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

store::Observable number(std::string const& name, store::ObservedCase const& one) {
    return {name, "m2/s2", "A number", "", "", "mine.py", "def f(): pass\n", "5e1f", {one}};
}

class Observables : public CampaignFolder {
  protected:
    Observables() {
        fs::create_directories(folder);
        plan = make_plan(scenario::parse_campaign(campaign_text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
        record = store::sample_record(plan.cases.front().id);
        fs::create_directories(plan.cases.front().folder);
        store::write_result(plan.cases.front().result_file(), record);
        observed = {record.id, store::mark_of(record), {1, 3}, 4, 16, {}, {{0.25, 0.125, "steady"}}};
    }

    Plan plan;
    store::CaseRecord record;
    store::ObservedCase observed;
};

TEST_F(Observables, ComeBackFromTheirFile) {
    store::Observable curve = number("profile", observed);
    curve.over = "height";
    curve.over_unit = "m";
    curve.cases[0].at = {0.001, 0.002};
    curve.cases[0].values = {{1.0 / 3, {}, "drifting"}, {{}, {}, "steady"}};
    write_observables(folder, {number("one", observed), curve});
    auto const found = read_observables(folder);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(to_json(found), to_json({number("one", observed), curve}));
    EXPECT_EQ(found[1].cases[0].values[0].mean, 1.0 / 3) << "to the last bit";
    EXPECT_FALSE(found[1].cases[0].values[0].half_width);
    EXPECT_EQ(found[0].of(record)->packings, (std::vector{1, 3}));
    EXPECT_EQ(found[0].source, "def f(): pass\n");
}

TEST_F(Observables, ReplaceThoseOfTheirNameAlone) {
    write_observables(folder, {number("one", observed), number("two", observed)});
    store::ObservedCase other = observed;
    other.values[0].mean = 7;
    write_observables(folder, {number("two", other)});
    auto const found = read_observables(folder);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].cases[0].values[0].mean, 0.25);
    EXPECT_EQ(found[1].cases[0].values[0].mean, 7);
}

TEST_F(Observables, AreInCampaignH5AndMakeItOutdated) {
    write_campaign_file(plan);
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date);
    std::string const before = core::read_file(folder / "campaign.h5");
    write_observables(folder, {number("one", observed)});
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::outdated);
    write_campaign_file(plan);
    EXPECT_EQ(campaign_file_state(plan), CampaignFileState::up_to_date);
    EXPECT_GT(core::read_file(folder / "campaign.h5").size(), before.size());
}

TEST_F(Observables, AreNotBelievedWhenDamaged) {
    std::string const good = to_json({number("one", observed)});
    EXPECT_EQ(parse_observables(good).size(), 1u);
    for (auto const& [old, replaced] :
         std::vector<std::pair<std::string, std::string>>{{"vibrotrough observables", "vibrotrough numerics"},
                                                          {"\"schema_version\": 1", "\"schema_version\": 2"},
                                                          {"\"name\": \"one\"", "\"name\": \"../one\""},
                                                          {"\"name\": \"one\"", "\"name\": 1"},
                                                          {"m2/s2", "m2,s2"},
                                                          {"0.25", "\"0.25\""},
                                                          {"0.25", "0.25, 0.5"},
                                                          {"0.125", "[]"},
                                                          {"steady", "quick"},
                                                          {"\"discarded\": 4", "\"discarded\": -4"},
                                                          {"\"cases\"", "\"cares\""}}) {
        std::string text = good;
        ASSERT_NE(text.find(old), text.npos) << old;
        text.replace(text.find(old), old.size(), replaced);
        EXPECT_THROW(parse_observables(text), core::note::Fault) << text;
        core::write_file_atomically(folder / observables_file, text);
        EXPECT_THROW(read_observables(folder), core::InputError) << text;
    }
    std::string twice = to_json({number("one", observed), number("one", observed)});
    EXPECT_THROW(parse_observables(twice), core::note::Fault);
}

}  // namespace
}  // namespace vibrotrough::campaign
