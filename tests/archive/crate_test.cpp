#include "archive/crate.hpp"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::archive {
namespace {

nlohmann::json entity(nlohmann::json const& crate, std::string const& id) {
    for (auto const& one : crate.at("@graph")) {
        if (one.at("@id") == id) return one;
    }
    return nullptr;
}

CrateFacts facts() {
    CrateFacts facts;
    facts.campaign = "demo";
    facts.engine_version = "LIGGGHTS 3.8.0";
    facts.files = {{"archive.json", "00", 7},
                   {"cases/0123456789ab/result.h5", "11", 8},
                   {"cases/0123456789ab/packing-1/in.liggghts", "22", 9},
                   {"my layer.txt", "44", 1}};
    facts.cases = {{"0123456789ab", "throw_number 2: finished"}, {"ba9876543210", "throw_number 3: open"}};
    return facts;
}

// RO-Crate 1.1, "Data Entities": an identifier is a URI path, in which a blank is %20; each case is a data
// set of its own. end_to_end.archive looks at the rest in a real bundle.
TEST(Crate, DescribesFilesAndCases) {
    auto const crate = nlohmann::json::parse(crate_metadata(facts()));
    EXPECT_EQ(entity(crate, "my%20layer.txt").at("sha256"), "44");
    EXPECT_EQ(entity(crate, "archive.json").at("contentSize"), "7");
    auto const done = entity(crate, "cases/0123456789ab/");
    EXPECT_EQ(done.at("hasPart").size(), 1u);
    EXPECT_EQ(done.at("description"), "throw_number 2: finished");
    EXPECT_TRUE(entity(crate, "cases/ba9876543210/").is_null()) << "it was not begun";
    EXPECT_TRUE(entity(crate, "cases/0123456789ab/packing-1/in.liggghts").is_null());
}

// What is not known is left out: no licence, no author, and no date without a result.
TEST(Crate, LeavesOutWhatIsNotKnown) {
    auto const root = entity(nlohmann::json::parse(crate_metadata(facts())), "./");
    for (char const* name : {"license", "author", "datePublished"}) EXPECT_FALSE(root.contains(name)) << name;
}

// A text that is not UTF-8 makes no invalid JSON.
TEST(Crate, IsJsonWhateverTheTexts) {
    CrateFacts odd = facts();
    odd.engine_version = "\xff\xfe";
    odd.authors = {"Å. \"Quote\" Ø"};
    auto const crate = nlohmann::json::parse(crate_metadata(odd));
    EXPECT_EQ(entity(crate, "#%C3%85.%20%22Quote%22%20%C3%98").at("name"), odd.authors.front());
}

}  // namespace
}  // namespace vibrotrough::archive
