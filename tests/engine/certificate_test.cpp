#include "engine/certificate.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;

Certificate sample() {
    return {{"/opt/liggghts", "aa", "/opt/lib.so", "bb", "LIGGGHTS 3.8.0", "cc"},
            "2026-11-21T12:00:00Z",
            {{"name", "question?", 0.5, 0.1 + 0.2, 0.3}}};
}

TEST(ProbeResult, PassesWithinItsTolerance) {
    for (auto const& [measured, passes] :
         {std::pair{1.1, true}, {1.3, false}, {0.7, false}, {static_cast<double>(NAN), false}})
        EXPECT_EQ((ProbeResult{"name", "question?", 1, measured, 0.2}.passed()), passes) << measured;
}

TEST(Certificate, WithoutAProbeProvesNothing) {
    Certificate certificate = sample();
    EXPECT_TRUE(certificate.passed());
    certificate.probes.clear();
    EXPECT_FALSE(certificate.passed());
}

TEST(EngineIdentity, IsThatOfTheBinaryNotOfItsPath) {
    EngineIdentity const one = sample().engine;
    EngineIdentity other = one;
    other.program = "/elsewhere/liggghts";
    EXPECT_EQ(other.key(), one.key());
    for (auto const member : {&EngineIdentity::program_sha256, &EngineIdentity::library_sha256,
                              &EngineIdentity::version, &EngineIdentity::probes_sha256}) {
        EngineIdentity different = one;
        different.*member += "x";
        EXPECT_NE(different.key(), one.key());
    }
}

// Debian's program is only a stub of 18 kB: the code is in the library that it links.
TEST(EngineIdentity, NamesTheLinkedLibrary) {
    Engine engine = find_engine({});
    EngineIdentity const identity = identify(engine);
    EXPECT_EQ(identity.program_sha256.size(), 64u);
    EXPECT_NE(identity.library.find("libliggghts"), std::string::npos);
    EXPECT_EQ(identity.library_sha256.size(), 64u);
    EXPECT_NO_THROW(require_unchanged(engine));
    engine.files.front().size += 1;
    EXPECT_THROW(require_unchanged(engine), core::MissingError);
    Engine other{"/bin/sh", "any"};
    EXPECT_TRUE(identify(other).library.empty());
}

class CertificateCache : public testing::Test {
  protected:
    CertificateCache() { ::setenv("XDG_CACHE_HOME", folder.c_str(), 1); }
    ~CertificateCache() override { ::unsetenv("XDG_CACHE_HOME"); }
    fs::path file() const { return *certificate_folder() / (sample().engine.key() + ".json"); }
    core::TemporaryFolder const own_folder;
    std::string folder = own_folder.path() / "cache";
};

TEST_F(CertificateCache, KeepsWhatPassed) {
    EXPECT_FALSE(find_certificate(sample().engine));
    EXPECT_EQ(keep_certificate(sample()), "");
    ASSERT_TRUE(find_certificate(sample().engine));
    EXPECT_EQ(*find_certificate(sample().engine), to_json(sample()));
    EngineIdentity other = sample().engine;
    other.program_sha256 = "another binary";
    EXPECT_FALSE(find_certificate(other));

    Certificate failed = sample();
    failed.engine = other;
    failed.probes[0].measured = 7;
    EXPECT_NE(keep_certificate(failed), "");
    EXPECT_FALSE(find_certificate(other));
}

TEST_F(CertificateCache, DamagedOrForeignCertificatesCountAsNone) {
    ASSERT_EQ(keep_certificate(sample()), "");
    fs::resize_file(file(), fs::file_size(file()) / 2);
    EXPECT_FALSE(find_certificate(sample().engine));
    Certificate other = sample();
    other.engine.version = "another engine's, under this one's name";
    std::ofstream(file()) << to_json(other);
    EXPECT_FALSE(find_certificate(sample().engine));
}

TEST_F(CertificateCache, SaysWhyItCannotKeepOne) {
    std::ofstream{folder} << "a file where the folder should be";
    EXPECT_NE(keep_certificate(sample()).find("cannot make the folder"), std::string::npos);
    EXPECT_FALSE(find_certificate(sample().engine));
}

TEST_F(CertificateCache, FollowsTheCacheFolderOfTheDesktop) {
    EXPECT_EQ(certificate_folder(), fs::path(folder) / "vibrotrough" / "engines");
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    std::string const home = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
    ::setenv("HOME", "/home/someone", 1);
    EXPECT_EQ(certificate_folder(), "/home/someone/.cache/vibrotrough/engines");
    ::unsetenv("HOME");
    EXPECT_FALSE(certificate_folder());
    EXPECT_NE(keep_certificate(sample()), "");
    ::setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace vibrotrough::engine
