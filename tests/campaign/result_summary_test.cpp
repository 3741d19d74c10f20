#include "campaign/state/result_summary.hpp"

#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"
#include "store/summary.hpp"

#include <cmath>
#include <fstream>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

class ResultSummary : public CampaignFolder {
  protected:
    ResultSummary() {
        fs::create_directories(planned.folder);
        store::write_result(planned.result_file(), store::sample_record(planned.id));
    }
    /// What a reader finds, and whether it had to read the result itself. The next one finds a summary.
    std::pair<std::optional<store::CaseRecord>, bool> look() const {
        auto found = find_summary(planned);
        if (!found) return {std::nullopt, true};
        if (found->is_from_result) write_summary(planned, found->record);
        return {std::move(found->record), found->is_from_result};
    }
    fs::path const file = planned.folder / "summary";
};

TEST_F(ResultSummary, ReadsEachResultOnce) {
    EXPECT_TRUE(look().second);
    auto const [record, read] = look();
    EXPECT_FALSE(read);
    ASSERT_TRUE(record);
    auto const whole = store::read_result(planned.result_file());
    EXPECT_EQ(record->outcome, whole.outcome);
    EXPECT_EQ(record->estimate.mean, whole.estimate.mean);
    // The interval of a difference needs it (measure/difference.hpp): stored as it is, so equality is exact.
    EXPECT_EQ(record->estimate.drift, store::sample_record(planned.id).estimate.drift);
    EXPECT_GT(record->estimate.drift, 0);
    ASSERT_EQ(record->packings.size(), whole.packings.size());
    EXPECT_EQ(record->packings[0].estimate.half_width, whole.packings[0].estimate.half_width);
    EXPECT_EQ(record->packings[0].wall_time, whole.packings[0].wall_time);
    EXPECT_EQ(record->provenance.host, whole.provenance.host);
    EXPECT_TRUE(record->packings[0].series.x.empty()) << "a summary has no cycles";
}

// What a record is cut down to is what its file gives back, and nothing of it needs the file.
TEST_F(ResultSummary, IsTheSameFromTheRecordAndFromItsFile) {
    auto const whole = store::read_result(planned.result_file());
    ASSERT_FALSE(whole.packings[0].deck.empty());
    store::CaseRecord const cut = store::summary_of(whole);
    EXPECT_EQ(store::pack_summary(cut), store::pack_summary(whole));
    auto const read = store::unpack_summary(store::pack_summary(whole), whole.scenario);
    EXPECT_EQ(cut.estimate.discarded, read.estimate.discarded);
    EXPECT_EQ(cut.estimate.drift, read.estimate.drift);
    for (store::CaseRecord const* const one : {&cut, &read}) {
        EXPECT_TRUE(one->packings[0].series.x.empty() && one->packings[0].efficiency.empty());
        EXPECT_TRUE(one->packings[0].deck.empty() && one->scenario_toml.empty());
    }
}

TEST_F(ResultSummary, AQueryWritesNothing) {
    ASSERT_TRUE(find_summary(planned));
    EXPECT_FALSE(fs::exists(file));
}

TEST_F(ResultSummary, NoticesADamagedAndARemovedResult) {
    look();
    std::string const whole = core::read_file(planned.result_file());
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    overwrite(planned.result_file(), flipped);
    EXPECT_FALSE(look().first) << "as large as before, but not the same";
    overwrite(planned.result_file(), whole);
    EXPECT_TRUE(look().first);
    fs::remove(planned.result_file());
    EXPECT_FALSE(look().first);
}

// A disk can spoil a byte, and a copy with its times can be another file: size, time and inode do not tell.
TEST_F(ResultSummary, NoticesAByteThatRotsWhileTheStampStays) {
    look();
    std::string const whole = core::read_file(planned.result_file());
    auto const time = fs::last_write_time(planned.result_file());
    auto const write_over = [&](std::string const& content) {
        std::fstream(planned.result_file(), std::ios::in | std::ios::out | std::ios::binary) << content;
        fs::last_write_time(planned.result_file(), time);
    };
    for (std::size_t position = 9; position < whole.size(); position += whole.size() / 23) {
        std::string rotten = whole;
        rotten[position] = static_cast<char>(rotten[position] ^ 1);
        write_over(rotten);
        EXPECT_TRUE(find_summary(planned, Trust::stamp)) << "a quick look sees the stamp only";
        EXPECT_FALSE(find_summary(planned)) << position;
    }
    write_over(whole);
    auto const found = find_summary(planned);
    EXPECT_TRUE(found && !found->is_from_result);
}

// A sound file in place of another one, of the same size and time: its own numbers count, not the summary's.
TEST_F(ResultSummary, NoticesAnotherResultUnderTheSameStamp) {
    look();
    auto const time = fs::last_write_time(planned.result_file());
    auto other = store::sample_record(planned.id);
    other.estimate.mean = *other.estimate.mean + 0.125;
    auto const made = planned.folder / "other.h5";
    store::write_result(made, other);
    std::string const bytes = core::read_file(made);
    ASSERT_EQ(bytes.size(), fs::file_size(planned.result_file()));
    std::fstream(planned.result_file(), std::ios::in | std::ios::out | std::ios::binary) << bytes;
    fs::last_write_time(planned.result_file(), time);
    auto const found = find_summary(planned);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->record.estimate.mean, other.estimate.mean);
}

TEST_F(ResultSummary, ADamagedSummaryIsReplaced) {
    look();
    std::string const whole = core::read_file(file);
    for (std::string const& damaged : {std::string(), whole.substr(0, whole.size() / 2), whole + "x",
                                       "another version\n" + whole, std::string("\xff\xff\xff")}) {
        overwrite(file, damaged);
        auto const [record, read] = look();
        EXPECT_TRUE(record && read);
        EXPECT_EQ(core::read_file(file), whole);
    }
}

TEST_F(ResultSummary, AChangedByteIsNoticed) {
    look();
    std::string const whole = core::read_file(file);
    for (std::size_t position = 0; position < whole.size(); position += 7) {
        std::string damaged = whole;
        damaged[position] = static_cast<char>(damaged[position] ^ 0x15);
        overwrite(file, damaged);
        EXPECT_TRUE(look().second) << position;
        ASSERT_EQ(core::read_file(file), whole);
    }
}

// Each 0x81 opens an array within the one before: read without the digest, they overflow the stack.
TEST(Summary, DeeplyNestedBytesAreRefused) {
    std::vector<std::uint8_t> const bytes(1'000'000, 0x81);
    EXPECT_THROW(store::unpack_summary(bytes, scenario::Scenario{}), core::InputError);
}

TEST(Summary, EndsTooEarlyAnywhere) {
    auto const record = store::sample_record("0123456789ab");
    std::vector<std::uint8_t> const bytes = store::pack_summary(record);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(store::unpack_summary({bytes.data(), size}, record.scenario), core::InputError) << size;
    EXPECT_EQ(store::pack_summary(store::unpack_summary(bytes, record.scenario)), bytes);
}

TEST(Summary, KeepsWhatIsNotKnown) {
    auto record = store::sample_record("0123456789ab");
    record.estimate.mean.reset();
    record.estimate.half_width.reset();
    record.packings[0].motion.landing_phase.reset();
    record.packings[0].estimate.half_width = INFINITY;
    record.provenance.host = "t\xFFrough";
    store::CaseRecord const read = store::summary_of(record);
    EXPECT_FALSE(read.estimate.mean || read.estimate.half_width || read.packings[0].motion.landing_phase);
    EXPECT_EQ(read.packings[0].estimate.half_width, INFINITY);
    EXPECT_EQ(read.packings[1].motion.landing_phase, record.packings[1].motion.landing_phase);
    EXPECT_EQ(read.provenance.host, record.provenance.host);
}

}  // namespace
}  // namespace vibrotrough::campaign
