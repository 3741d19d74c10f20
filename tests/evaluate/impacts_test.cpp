#include "evaluate/impacts.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "deck/impacts.hpp"
#include "measure/impacts.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::evaluate {
namespace {

namespace fs = std::filesystem;

std::string list_of(long step, int count, std::string const& contacts,
                    std::string const& what = "ENTRIES a") {
    return fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 "
        "1\nITEM: {} \n{}",
        step, what.substr(0, 5) == "ATOMS" ? "ATOMS" : "ENTRIES", count, what, contacts);
}

/// The folder of a packing after the engine has ended.
class KeptImpacts : public testing::Test {
  protected:
    KeptImpacts() {
        for (int done = cycles.from; done < cycles.to; ++done) write_cycle(done);
    }

    /// In each cycle grain 1 hits grain 2, and grain 3 the trough twice.
    void write_cycle(int done) {
        long const step = static_cast<long>(done) * prepared.time.steps_per_cycle;
        auto const write = [&](std::string const& name, std::string const& text) {
            std::ofstream(folder / name) << text;
        };
        write(deck::masses_file(done), list_of(step, 3, "2 1 0.0015 2e-5\n1 1 0.0015 2e-5\n3 1 0.0015 2e-5\n",
                                               "ATOMS id type radius mass"));
        write(deck::grain_contacts_file(done), list_of(step, 0, "") + list_of(step + 2, 1, "2 1 0 1e-6 \n") +
                                                   list_of(step + 4, 1, "2 1 0 2e-6 \n") +
                                                   list_of(step + 6, 0, "") + list_of(step + 8, 0, ""));
        write(deck::floor_contacts_file(done),
              list_of(step, 0, "") + list_of(step + 2, 1, "0 0 3 1e-6 \n") + list_of(step + 4, 0, "") +
                  list_of(step + 6, 1, "0 1 3 1e-6 \n") + list_of(step + 8, 1, "0 1 3 3e-6 \n"));
    }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (auto const& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
        return names;
    }

    prepare::PreparedCase prepared = prepare::prepare_case(
        scenario::parse_campaign(with("max_cycles = 200", "max_cycles = 200\nimpacts = true"), "test.toml")
            .cases.front());
    deck::WatchedCycles cycles = deck::watched_cycles(prepared.scenario);
    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
};

TEST_F(KeptImpacts, TakeThePlaceOfTheContacts) {
    keep_impacts(prepared, folder);
    EXPECT_THAT(files(), testing::ElementsAre(impacts_file));
    auto const list = measure::parse_impacts(core::read_text_file(folder / impacts_file));
    ASSERT_EQ(list.impacts.size(), 6u);
    EXPECT_DOUBLE_EQ(list.watched, 2 * 6 * prepared.time.time_step);
    // The last list shows how the contacts before it go on. In 2 of the 4 others grains 1 and 2 touch, in 2
    // of them grain 3 and the trough.
    EXPECT_DOUBLE_EQ(list.coordination, (2 * 0.5 + 0.5) / 3);
    // A packing that goes on keeps them.
    keep_impacts(prepared, folder);
    EXPECT_THAT(files(), testing::ElementsAre(impacts_file));
}

// The mass of the pair counts: a grain and the trough have twice that of two equal grains.
TEST_F(KeptImpacts, HaveTheEnergyOfTheirPair) {
    keep_impacts(prepared, folder);
    auto const list = measure::parse_impacts(core::read_text_file(folder / impacts_file));
    double const between = 2 * prepared.time.time_step;
    EXPECT_EQ(list.impacts[0].second, 2);
    EXPECT_GT(list.impacts[0].energy, 1e-5 / 2 * std::pow(1e-6 / between, 2) / 2);
    EXPECT_TRUE(list.impacts[1].brief);  // the trough saw it in one list only
}

TEST_F(KeptImpacts, NeedAllFiles) {
    fs::remove(folder / deck::floor_contacts_file(cycles.from));
    EXPECT_FALSE(find_impacts(prepared, folder));
    write_cycle(cycles.from);
    EXPECT_TRUE(find_impacts(prepared, folder));
    std::ofstream(folder / deck::masses_file(cycles.from)) << list_of(0, 0, "", "ATOMS id type radius mass");
    EXPECT_THROW(find_impacts(prepared, folder), core::InputError);
}

}  // namespace
}  // namespace vibrotrough::evaluate
