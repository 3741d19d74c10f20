#include "core/error.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/keys.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

scenario::RunSettings run_settings(std::string const& section) {
    return scenario::parse_campaign(example_campaign + section, "campaign.toml").run;
}

TEST(RunSection, LocalByDefault) {
    scenario::RunSettings const settings = run_settings("");
    EXPECT_EQ(settings.executor, "local");
    EXPECT_EQ(settings.retries, 0);
    EXPECT_FALSE(settings.ranks || settings.time_limit || settings.slurm.partition || settings.slurm.minutes);
}

TEST(RunSection, ReadsAllItsKeys) {
    scenario::RunSettings const settings = run_settings(
        "[run]\nexecutor = \"slurm\"\nretries = 2\nranks = 4\ntime_limit = \"2 hours\"\n"
        "[run.slurm]\npartition = \"compute\"\naccount = \"granular-1\"\ntime = \"90 s\"\nmemory = \"1.5 "
        "GB\"\n"
        "concurrent_tasks = 7\nextra = [\"--qos=short\", \"--constraint=a&b\", \"--exclusive\"]\n"
        "setup = [\"module load openmpi\", \"export A='b c'\"]\n");
    EXPECT_EQ(settings.executor, "slurm");
    EXPECT_EQ(settings.retries, 2);
    EXPECT_EQ(settings.ranks, 4);
    EXPECT_EQ(settings.time_limit, 7200);
    EXPECT_EQ(settings.slurm.partition->str(), "compute");
    EXPECT_EQ(settings.slurm.account->str(), "granular-1");
    EXPECT_EQ(settings.slurm.minutes, 2) << "Slurm counts whole minutes";
    EXPECT_EQ(settings.slurm.memory, 1536);
    EXPECT_EQ(settings.slurm.concurrent_tasks, 7);
    ASSERT_EQ(settings.slurm.extra.size(), 3u);
    EXPECT_EQ(settings.slurm.extra[1].str(), "--constraint=a&b");
    EXPECT_EQ(settings.slurm.setup, (std::vector<std::string>{"module load openmpi", "export A='b c'"}));
}

TEST(RunSection, DoesNotChangeTheCases) {
    auto const with_run =
        scenario::parse_campaign(example_campaign + "[run]\nretries = 2\n", "campaign.toml");
    EXPECT_EQ(to_toml(with_run.cases.at(0)),
              to_toml(scenario::parse_campaign(example_campaign, "campaign.toml").cases.at(0)));
}

// What reaches a command line is a plain name or a number, whatever the file says.
TEST(RunSection, NamesThatCouldBeCommandsAreRefused) {
    for (char const* name : {"", "a b", "a;b", "$(id)", "`id`", "a\\nb", "a'b", "-x", "--wrap=id", "../a",
                             "a&b", "a/b", ".", "\\u00e9", "a|b", "a>b", "a\\\"b"}) {
        for (char const* key : {"partition", "account", "memory"}) {
            try {
                run_settings(std::string("[run.slurm]\n") + key + " = \"" + name + "\"\n");
                ADD_FAILURE() << key << " took " << name;
            } catch (core::InputError const& error) {
                std::string const message = error.what();
                EXPECT_TRUE(message.starts_with("campaign.toml:")) << message;
            }
        }
    }
    EXPECT_FALSE(scenario::PlainName::from(std::string(65, 'a')));
    EXPECT_TRUE(scenario::PlainName::from(std::string(64, 'a')));
}

// An option may ask for resources, but name no file, no variable and no script.
TEST(RunSection, OptionsThatDoMoreThanAskAreRefused) {
    for (char const* option :
         {"", "qos=short", "-qshort", "--output=/home/me/.bashrc", "--wrap=id", "--export=LD_PRELOAD=x",
          "--chdir=/", "--array=0-9", "--clusters=other", "--qos=a b", "--qos=a'b", "--qos=a/b",
          "--qos=$(id)", "--qos=a\nb", "--qos short", "--"}) {
        EXPECT_FALSE(scenario::SlurmOption::from(option)) << option;
    }
    for (char const* option :
         {"--qos=short", "--gres=gpu:a100:1", "--exclude=n[1-3],n7", "--exclusive", "--mail-user=me@x.org"})
        EXPECT_TRUE(scenario::SlurmOption::from(option)) << option;
}

TEST(RunSection, MistakesNameTheirPlace) {
    for (auto const& [section, part] : std::vector<std::pair<std::string, std::string>>{
             {"[run]\nexecutor = \"cloud\"\n", "local or slurm"},
             {"[run]\nretry = 3\n", "unknown key"},
             {"[run]\nretries = -1\n", "out of range"},
             {"[run]\nranks = 1.5\n", "not a whole number"},
             {"[run.pbs]\nqueue = \"a\"\n", "unknown key"},
             {"[run.slurm]\ntime = \"3 m\"\n", "run.slurm.time"},
             {"[run.slurm]\nmemory = \"3 kg\"\n", "1 MB to"},
             {"[run.slurm]\nextra = \"--qos=a\"\n", "is not a list"},
             {"[run.slurm]\nextra = [\"--wrap=id\"]\n", "--wrap=id"},
             {"[run.slurm]\nsetup = [\"a\\nb\"]\n", "printable"},
             {"[run.slurm]\nsetup = [3]\n", "printable"},
         }) {
        try {
            run_settings(section);
            ADD_FAILURE() << "accepted " << section;
        } catch (core::InputError const& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace vibrotrough
