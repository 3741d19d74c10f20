#include "store/result_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "sample_record.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/hdf5_file.hpp"
#include "store/material_quantities.hpp"
#include "store/schema.hpp"
#include "store/summary.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace vibrotrough::store {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Without the sync to disk of write_file_atomically, which would make many writes slow.
void overwrite(fs::path const& path, std::string const& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

class ResultFile : public testing::Test {
  protected:
    /// The message of the InputError of reading `bytes` as result.h5.
    std::string refusal(std::string const& bytes) const {
        overwrite(path, bytes);
        try {
            read_result(path);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    }

    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
    fs::path path = folder / "result.h5";
};

/// The fields are those of the schema.
void expect_equal_layer(PackingRecord read, PackingRecord written) {
    for (PackingTable const& table : packing_tables())
        for (PackingColumn const& column : table.columns)
            EXPECT_EQ(column.field(read), column.field(written)) << table.name << "/" << column.entry.name;
    EXPECT_EQ(read.granular_temperature, written.granular_temperature);
    EXPECT_EQ(read.motion.mode, written.motion.mode);
    EXPECT_EQ(read.motion.period_cycles, written.motion.period_cycles);
    EXPECT_EQ(read.motion.friction_ratio, written.motion.friction_ratio);
    EXPECT_EQ(read.motion.take_off_phase, written.motion.take_off_phase);
    EXPECT_EQ(read.motion.dissipation, written.motion.dissipation);
    EXPECT_EQ(read.profiles.velocity_gradient, written.profiles.velocity_gradient);
    EXPECT_EQ(read.surface.wiggle_amplitude, written.surface.wiggle_amplitude);
}

void expect_equal(PackingRecord const& read, PackingRecord const& written) {
    EXPECT_EQ(read.seed, written.seed);
    EXPECT_EQ(read.steps_per_cycle, written.steps_per_cycle);
    EXPECT_EQ(read.time_step, written.time_step);
    EXPECT_EQ(read.mass, written.mass);
    EXPECT_EQ(read.wall_time, written.wall_time);
    EXPECT_EQ(read.core_time, written.core_time);
    EXPECT_EQ(read.start_efficiency, written.start_efficiency);
    EXPECT_EQ(read.series.x, written.series.x);
    EXPECT_EQ(read.series.z, written.series.z);
    EXPECT_EQ(read.series.vz, written.series.vz);
    EXPECT_EQ(read.series.normal_force, written.series.normal_force);
    EXPECT_EQ(read.series.tangential_force, written.series.tangential_force);
    EXPECT_EQ(read.series.flight_fraction, written.series.flight_fraction);
    EXPECT_EQ(read.series.mean_velocity, written.series.mean_velocity);
    EXPECT_EQ(read.efficiency, written.efficiency);
    EXPECT_EQ(read.estimate.mean, written.estimate.mean);
    EXPECT_EQ(read.estimate.half_width, written.estimate.half_width);
    EXPECT_EQ(read.estimate.discarded, written.estimate.discarded);
    EXPECT_EQ(read.estimate.measured, written.estimate.measured);
    EXPECT_EQ(read.estimate.correlation_time, written.estimate.correlation_time);
    EXPECT_EQ(read.estimate.verdict, written.estimate.verdict);
    EXPECT_EQ(read.deck, written.deck);
    expect_equal_layer(read, written);
}

/// Doubles are stored as they are, so equality is exact throughout.
void expect_equal(CaseRecord const& read, CaseRecord const& written) {
    EXPECT_EQ(read.id, written.id);
    EXPECT_EQ(read.scenario_toml, written.scenario_toml);
    EXPECT_EQ(to_toml(read.scenario), to_toml(written.scenario));
    EXPECT_EQ(read.outcome, written.outcome);
    EXPECT_EQ(read.layer_mode, written.layer_mode);
    EXPECT_EQ(read.estimate.mean, written.estimate.mean);
    EXPECT_EQ(read.estimate.half_width, written.estimate.half_width);
    EXPECT_EQ(read.estimate.packings, written.estimate.packings);
    EXPECT_EQ(read.estimate.deviation, written.estimate.deviation);
    EXPECT_EQ(read.estimate.deviation_within, written.estimate.deviation_within);
    EXPECT_EQ(read.estimate.drift, written.estimate.drift);
    ASSERT_EQ(read.estimate.below.has_value(), written.estimate.below.has_value());
    if (read.estimate.below) {
        EXPECT_EQ(read.estimate.below->mean, written.estimate.below->mean);
        EXPECT_EQ(read.estimate.below->packings, written.estimate.below->packings);
    }
    EXPECT_EQ(read.provenance.program_version, written.provenance.program_version);
    EXPECT_EQ(read.provenance.git_commit, written.provenance.git_commit);
    EXPECT_EQ(read.provenance.engine_version, written.provenance.engine_version);
    EXPECT_EQ(read.provenance.engine_certificate, written.provenance.engine_certificate);
    EXPECT_EQ(read.provenance.host, written.provenance.host);
    EXPECT_EQ(read.provenance.started, written.provenance.started);
    EXPECT_EQ(read.provenance.finished, written.provenance.finished);
    ASSERT_EQ(read.packings.size(), written.packings.size());
    for (std::size_t i = 0; i < read.packings.size(); ++i)
        expect_equal(read.packings[i], written.packings[i]);
}

TEST_F(ResultFile, RoundTrip) {
    CaseRecord const record = sample_record();
    write_result(path, record);
    expect_equal(read_result(path), record);
}

TEST_F(ResultFile, KeepsWhatIsEmptyInfiniteOrMissing) {
    CaseRecord record = sample_record();
    record.packings[1].deck.clear();
    record.packings[1].estimate.half_width = INFINITY;
    record.packings[1].series = {};
    record.packings[1].series.x = {0.018};
    record.packings[1].series.z = {0.009};
    record.packings[1].series.vz = {0};
    record.packings[1].efficiency.clear();
    record.packings[1].motion = {};
    record.packings[1].profiles = {};
    record.packings[1].surface = {};
    record.layer_mode.clear();
    write_result(path, record);
    expect_equal(read_result(path), record);

    record.packings.clear();
    record.estimate.half_width.reset();
    write_result(path, record);
    EXPECT_TRUE(read_result(path).packings.empty());
    EXPECT_EQ(read_result(path).estimate.mean, 0.82) << "its interval is unbounded";
    EXPECT_FALSE(read_result(path).estimate.half_width);

    record.estimate.mean.reset();
    write_result(path, record);
    EXPECT_FALSE(read_result(path).estimate.mean || read_result(path).estimate.half_width);
}

// The centres of mass of the materials are kept; what is made of them is in tables of the case, over
// packings. With H = 8 mm and equal masses S = (z_1 - z_0) / 4 mm: -0.5 and -1 at the end, -0.75 on average.
TEST_F(ResultFile, AMixtureHasItsMaterials) {
    CaseRecord record = sample_record();
    scenario::Scenario& s = record.scenario;
    s.layer.height = 0.008;
    s.materials = {{.name = "fines", .diameter_spread = 0.1, .mass_fraction = 0.5}};
    record.scenario_toml = to_toml(s);
    for (std::size_t i = 0; i < 2; ++i) {
        double const sunk = i == 0 ? 0.002 : 0.004;
        record.packings[i].series.materials[0] = {{0, 0.01}, {0.005, 0.005}};
        record.packings[i].series.materials[1] = {{0, 0.02}, {0.005, 0.005 - sunk}};
        record.packings[i].estimate.discarded = 0;
    }
    add_materials(record);
    write_result(path, record);
    CaseRecord const read = read_result(path);
    EXPECT_EQ(read.packings[1].segregation, record.packings[1].segregation);
    EXPECT_NEAR(read.packings[1].segregation.value(), -1, 1e-14);
    EXPECT_EQ(read.packings[1].series.materials[1].z, record.packings[1].series.materials[1].z);
    EXPECT_TRUE(read.packings[1].series.materials[2].z.empty());
    auto const tables = Hdf5Reader(path).read_all();
    auto const& materials = tables.at("materials");
    EXPECT_EQ(materials.values<std::string>("name"), (std::vector<std::string>{"grains", "fines"}));
    EXPECT_NEAR(materials.values<double>("segregation")[1], -0.75, 1e-14);
    EXPECT_NEAR(materials.values<double>("segregation")[0], 0.75, 1e-14);
    // Student's t with one degree of freedom: 12.706 times 0.25 (half the difference of two values).
    EXPECT_NEAR(materials.values<double>("segregation_half_width")[1], 12.7062 * 0.25, 1e-4);
    EXPECT_NEAR(materials.values<double>("efficiency")[1] / materials.values<double>("efficiency")[0], 2,
                1e-14);
    auto const& over_time = tables.at("segregation");
    EXPECT_EQ(over_time.values<double>("cycle"), (std::vector<double>{0, 1}));
    EXPECT_NEAR(over_time.values<double>("index_1")[0], 0, 1e-14);
    EXPECT_NEAR(over_time.values<double>("index_1")[1], -0.75, 1e-14);
    EXPECT_THROW(over_time.values<double>("index_2"), Hdf5Error);
}

TEST_F(ResultFile, SameRecordGivesSameBytes) {
    write_result(path, sample_record());
    write_result(folder / "again.h5", sample_record());
    EXPECT_EQ(core::read_file(path), core::read_file(folder / "again.h5"));
}

TEST_F(ResultFile, TruncatedAnywhereIsAnInputErrorThatNamesTheFile) {
    write_result(path, sample_record());
    std::string const whole = core::read_file(path);
    for (std::size_t length = 0; length < whole.size(); length += 97) {
        EXPECT_THAT(refusal(whole.substr(0, length)), AllOf(HasSubstr(path.string()), HasSubstr("damaged")))
            << length;
    }
}

TEST_F(ResultFile, AnyChangedByteIsNoticed) {
    write_result(path, sample_record());
    std::string const whole = core::read_file(path);
    for (std::size_t position = 0; position < whole.size(); position += 61) {
        std::string bytes = whole;
        bytes[position] = static_cast<char>(bytes[position] ^ (1 << position % 8));
        EXPECT_THAT(refusal(bytes), AllOf(HasSubstr(path.string()), HasSubstr("damaged"))) << position;
    }
}

TEST_F(ResultFile, ForeignFilesAreRefused) {
    EXPECT_THAT(refusal("This is not an HDF5 file.\n"),
                AllOf(HasSubstr(path.string()), HasSubstr("damaged")));
    std::vector const cases{sample_record()};
    write_campaign(folder / "campaign.h5", {.campaign = "sample", .cases = cases});
    EXPECT_THAT(refusal(core::read_file(folder / "campaign.h5")),
                AllOf(HasSubstr(path.string()), HasSubstr("not a result of Vibrotrough")));
    EXPECT_THROW(read_result(folder / "none.h5"), core::MissingError);
}

TEST_F(ResultFile, OtherSchemasAreRefused) {
    auto const of_version = [&](int version) {
        write_hdf5(path, [&](Hdf5Writer& file) {
            file.attribute("format", "vibrotrough result");
            file.attribute("schema_version", version);
            file.attribute("program_version", "9.9.9");
        });
        return core::read_file(path);
    };
    EXPECT_THAT(refusal(of_version(result_schema_version + 1)),
                AllOf(HasSubstr(path.string()), HasSubstr("a newer"), HasSubstr("9.9.9")));
    EXPECT_THAT(refusal(of_version(result_schema_version - 1)),
                AllOf(HasSubstr(path.string()), HasSubstr("an older"), HasSubstr("vibrotrough run")));
}

TEST_F(ResultFile, ColumnsOfAnotherKindAreRefused) {
    std::vector<Hdf5Column> const columns{{"number", "1", "n", std::vector<double>{1, 2}},
                                          {"count", "1", "c", std::vector<int>{1, 2}},
                                          {"text", "1", "t", std::vector<std::string>{"a", "bc"}}};
    write_hdf5(path, [&](Hdf5Writer& file) { file.table("group/rows", columns); });
    auto const tables = Hdf5Reader(path).read_all();
    Hdf5Table const& rows = tables.at("group/rows");
    EXPECT_EQ(rows.values<double>("number"), (std::vector<double>{1, 2}));
    EXPECT_EQ(rows.values<std::string>("text"), (std::vector<std::string>{"a", "bc"}));
    for (char const* const name : {"none", "count", "text"})
        EXPECT_THROW(rows.values<double>(name), Hdf5Error) << name;
}

TEST_F(ResultFile, ACampaignTellsWhatItIsMadeOfUnlessItIsDamaged) {
    std::vector const cases{sample_record()};
    write_campaign(path, {.campaign = "one", .cases = cases, .made_of = "these results"});
    EXPECT_EQ(made_of(path), "these results");
    std::string damaged = core::read_file(path);
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
    overwrite(path, damaged);
    EXPECT_FALSE(made_of(path));
    EXPECT_FALSE(made_of(folder / "none.h5"));
}

TEST_F(ResultFile, SaysWhenTheDiskRefuses) {
    EXPECT_THROW(write_result(folder / "no_such_folder" / "result.h5", sample_record()), core::MissingError);
    EXPECT_THROW(write_campaign(folder / "no_such_folder" / "campaign.h5", {}), core::MissingError);
}

// A full disk, made with a limit on file size: the old file stays and no half-written one remains.
TEST_F(ResultFile, FullDiskLeavesTheOldFile) {
    write_result(path, sample_record());
    CaseRecord larger = sample_record();
    larger.packings[0].deck.assign(100000, '#');

    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    rlimit const small{.rlim_cur = 50000, .rlim_max = old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    for (int i = 0; i < 3; ++i) EXPECT_THROW(write_result(path, larger), core::DiskFullError);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);

    expect_equal(read_result(path), sample_record());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

// Packings have numbers from 1, also in the names of their tables: other programs read these.
TEST_F(ResultFile, TablesOfPackingsAreNumberedFromOne) {
    write_result(path, sample_record());
    auto const tables = Hdf5Reader(path).read_all();
    EXPECT_TRUE(tables.contains("series/1") && tables.contains("series/2"));
    EXPECT_FALSE(tables.contains("series/3"));
}

// What each packing costs adds up; a number of one packing that belongs to its motion does not.
TEST(Quantities, TimesOfPackingsAddUp) {
    CaseRecord record = sample_record();
    ASSERT_EQ(record.packings.size(), 2u);
    record.packings[0].core_time = 3;
    record.packings[1].core_time = 4;
    auto const core_time = std::ranges::find(quantities(), "core_time", &Quantity::name);
    ASSERT_NE(core_time, quantities().end());
    EXPECT_EQ(std::get<std::optional<double>>(core_time->of_case(record)), 7);
}

TEST(Quantities, ASummaryKeepsEveryVerdict) {
    CaseRecord record = sample_record();
    for (auto const verdict :
         {measure::Verdict::precise, measure::Verdict::not_precise, measure::Verdict::not_steady}) {
        record.packings[0].estimate.verdict = verdict;
        CaseRecord const read = unpack_summary(pack_summary(record), record.scenario);
        EXPECT_EQ(read.packings[0].estimate.verdict, verdict);
    }
}

}  // namespace
}  // namespace vibrotrough::store
