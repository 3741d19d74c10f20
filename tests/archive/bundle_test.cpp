#include "archive/bundle.hpp"

#include "archive/open_bundle.hpp"
#include "archive/zip_file.hpp"
#include "campaign/campaign_folder.hpp"
#include "core/atomic_file.hpp"

#include <set>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

/// A campaign of which nothing was simulated yet, and its bundle.
class BundleTest : public campaign::CampaignFolder {
  protected:
    BundleTest() { campaign::overwrite(folder / "campaign.toml", campaign_text); }
    BundleReport write() const { return write_bundle(plan, {}, file, {{}, "", true}); }

    fs::path file = own_folder.path() / "bundle.zip";
};

TEST_F(BundleTest, CountsAllOfItsFiles) {
    BundleReport const report = write();
    std::set<std::string> names;
    read_zip(
        file,
        [&](std::string const& name) -> ZipSink {
            names.insert(name);
            return [](std::string_view) {};
        },
        [] {});
    EXPECT_TRUE(names.contains(checksums_file));
    EXPECT_EQ(report.files, names.size());
    EXPECT_EQ(report.bytes, fs::file_size(file));
}

// The checksums that are written are those that are read: an unchanged bundle is opened.
TEST_F(BundleTest, IsOpenedAsItWasWritten) {
    write();
    auto const bundle = open_bundle(file);
    ASSERT_TRUE(bundle);
    EXPECT_EQ(core::read_file(bundle->folder / "campaign.toml"), campaign_text);
    EXPECT_EQ(bundle->results, 0u);
}

}  // namespace
}  // namespace vibrotrough::archive
