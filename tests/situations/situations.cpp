// Thousands of things that can lie in a campaign's folder in place of its files, by class: status, compare,
// report and archive must show true numbers or none, leave nothing out in silence, say what is wrong in one
// line, and end soon. Each situation is a process of its own, so that a crash or an endless wait is one that
// fell.

#include "situations/campaign_on_disk.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <new>
#include <random>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vibrotrough::situations {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr unsigned patience = 20;  // s, for a situation

/// One thing that happened to a campaign.
struct Situation {
    std::string kind;                // the class
    std::vector<std::string> names;  // of the files that it changes
    std::function<void()> happen;
};

using Situations = std::vector<Situation>;

void add_rot(Situations& all, CampaignOnDisk const& campaign) {
    constexpr std::size_t places = 90;
    for (std::string const& name : campaign.files()) {
        std::string const& whole = campaign.content(name);
        for (std::size_t i = 0; i < places && !whole.empty(); ++i) {
            std::size_t const place = i * whole.size() / places;
            all.push_back({"a byte rots, times stay", {name}, [&campaign, name, place, i] {
                               std::string bytes = campaign.content(name);
                               bytes[place] = static_cast<char>(bytes[place] ^ (1 << (i % 8)));
                               campaign.rot(name, bytes);
                           }});
        }
        for (std::size_t i = 0; i < 12; ++i) {
            all.push_back({"a file is cut short", {name}, [&campaign, name, i] {
                               std::string const& bytes = campaign.content(name);
                               campaign.rot(name, bytes.substr(0, i * bytes.size() / 12));
                           }});
        }
    }
}

void make_special(fs::path const& path, fs::path const& folder, int kind) {
    switch (kind) {
        case 0:
            ::mkfifo(path.c_str(), 0600);
            break;
        case 1:
            fs::create_symlink("nowhere", path);
            break;
        case 2:
            fs::create_symlink(path.filename(), path);
            break;
        case 3:
            fs::create_symlink("/dev/zero", path);
            break;
        case 4:
            fs::create_directory(path);
            break;
        case 5:
            fs::create_symlink(folder, path);
            break;
        case 6:
            std::ofstream(path).close();
            fs::resize_file(path, std::uintmax_t{10} << 30);
            break;
        case 7:
            ::mknod(path.c_str(), S_IFSOCK | 0600, 0);
            break;
        case 8:
            ::mkfifo((folder.parent_path() / "pipe").c_str(), 0600);
            fs::create_symlink(folder.parent_path() / "pipe", path);
            break;
        default:
            break;  // there is none
    }
}

void add_kinds(Situations& all, CampaignOnDisk const& campaign) {
    for (std::string const& name : campaign.files()) {
        for (int kind = 0; kind < 10; ++kind) {
            bool const is_gone = kind == 9;  // whoever removes a file knows it
            if (is_gone && name.ends_with("result.h5")) continue;
            all.push_back({"something else than a file", {name}, [&campaign, name, kind] {
                               campaign.remove(name);
                               make_special(campaign.folder() / name, campaign.folder(), kind);
                           }});
        }
    }
}

/// Every value of a file of JSON becomes one of another type.
void add_types(Situations& all, CampaignOnDisk const& campaign) {
    std::vector<Json> const others{
        nullptr, true, -1, 1e308, "x\x1b[2J", Json::array(), Json::object(), Json::array({1, "a"})};
    for (std::string const& name : campaign.files()) {
        Json const whole =
            name.ends_with(".json") ? Json::parse(campaign.content(name), nullptr, false) : Json();
        if (!whole.is_object()) continue;
        std::vector<std::string> places{""};
        Json const flat = whole.flatten();
        for (auto const& [place, value] : flat.items()) places.push_back(place);
        for (std::string const& place : places) {
            for (Json const& other : others) {
                all.push_back(
                    {"a value of another type in JSON", {name}, [&campaign, name, whole, place, other] {
                         Json changed = whole;
                         changed[Json::json_pointer(place)] = other;
                         campaign.rot(name, changed.dump());
                     }});
            }
        }
    }
}

void add_depths(Situations& all, CampaignOnDisk const& campaign) {
    auto const repeated = [](std::string const& piece, int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += piece;
        return text;
    };
    std::vector<std::string> const texts{repeated("[", 100'000),
                                         repeated("{\"a\":", 100'000),
                                         "a = " + repeated("[", 20'000),
                                         "a = " + repeated("{ a = ", 20'000),
                                         repeated("a.", 50'000) + "a = 1\n",
                                         "[" + repeated("a.", 50'000) + "a]\n",
                                         repeated("a = { b" + repeated(".b", 4990) + " = 1 }\n", 50),
                                         repeated("\xff", 1000),
                                         repeated("1e999,", 10'000) + "\n",
                                         std::string(100'000, '\0')};
    for (std::string const& name : campaign.files()) {
        for (std::string const& text : texts) {
            all.push_back(
                {"depth, and no text at all", {name}, [&campaign, name, text] { campaign.rot(name, text); }});
            all.push_back({"depth behind what was there", {name}, [&campaign, name, text] {
                               campaign.rot(name, campaign.content(name) + "\n" + text);
                           }});
        }
    }
}

/// Two files that are both in order, but not where they are.
void add_exchanges(Situations& all, CampaignOnDisk const& campaign) {
    for (std::string const& one : campaign.files()) {
        for (std::string const& other : campaign.files()) {
            if (one >= other) continue;
            all.push_back({"two files exchanged", {one, other}, [&campaign, one, other] {
                               campaign.rot(one, campaign.content(other));
                               campaign.rot(other, campaign.content(one));
                           }});
        }
    }
}

/// Several at once, always the same ones.
void add_mixtures(Situations& all, std::size_t total) {
    std::mt19937 random(1);  // its numbers are the same everywhere
    std::size_t const singles = all.size();
    while (all.size() < total) {
        Situation const first = all[random() % singles], second = all[random() % singles];
        if (first.names == second.names) continue;
        std::vector<std::string> names = first.names;
        names.insert(names.end(), second.names.begin(), second.names.end());
        all.push_back({"two of them at once", names, [first, second] {
                           first.happen();
                           second.happen();
                       }});
    }
}

Situations make_situations(CampaignOnDisk const& campaign) {
    Situations all;
    add_rot(all, campaign);
    add_kinds(all, campaign);
    add_types(all, campaign);
    add_depths(all, campaign);
    add_exchanges(all, campaign);
    add_mixtures(all, std::max<std::size_t>(5000, all.size() + 500));
    return all;
}

/// What the processes that look at situations share.
struct Shared {
    static constexpr std::size_t most_classes = 20, most_words = 400;
    std::array<std::atomic<int>, most_classes> tried, held;
};

/// Asks in a process of its own. @return what fell; empty when all held
std::string look(CampaignOnDisk const& campaign, Situation const& situation, Depth depth,
                 fs::path const& scratch, char* words) {
    words[0] = '\0';
    pid_t const child = ::fork();
    if (child == 0) {
        ::alarm(patience);
        situation.happen();
        std::string const fault = ask(campaign, depth, scratch).fault.substr(0, Shared::most_words);
        words[fault.copy(words, fault.size())] = '\0';
        std::_Exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGALRM ? "it waits" : fmt::format("signal {}", WTERMSIG(status));
    return words;
}

std::vector<std::string> classes_of(Situations const& all) {
    std::set<std::string> kinds;
    for (Situation const& one : all) kinds.insert(one.kind);
    return {kinds.begin(), kinds.end()};
}

/// Looks at one situation of `every`: the share of the worker `first` of `workers`.
void look_at_part(std::size_t first, std::size_t workers, std::size_t every, Shared& shared) {
    constexpr std::size_t shown_in_full = 4;  // of so many situations one is also reported and archived
    CampaignOnDisk const campaign;
    core::TemporaryFolder const scratch;
    auto* const words =
        static_cast<char*>(::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    Situations const all = make_situations(campaign);
    auto const kinds = classes_of(all);
    for (std::size_t i = first * every; i < all.size(); i += workers * every) {
        auto const kind = static_cast<std::size_t>(std::ranges::find(kinds, all[i].kind) - kinds.begin());
        Depth const depth = i / (workers * every) % shown_in_full == 0 ? Depth::published : Depth::shown;
        std::string const fault = look(campaign, all[i], depth, scratch.path(), words);
        ++shared.tried.at(kind);
        if (fault.empty()) {
            ++shared.held.at(kind);
        } else {
            fmt::print("situation {} ({}, {}): {}\n", i, all[i].kind, fmt::join(all[i].names, " and "),
                       fault);
            std::fflush(stdout);
        }
        campaign.restore(all[i].names);
        campaign.restore({"campaign.h5"});  // the report writes it anew
    }
}

int print_table(Shared const& shared, int wanted) {
    auto const kinds = classes_of(make_situations(CampaignOnDisk()));
    int count = 0, held = 0;
    fmt::print("{:<36} {:>6} {:>6}\n", "class", "tried", "held");
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        fmt::print("{:<36} {:>6} {:>6}\n", kinds[i], shared.tried.at(i).load(), shared.held.at(i).load());
        count += shared.tried.at(i);
        held += shared.held.at(i);
    }
    fmt::print("{:<36} {:>6} {:>6}\n", "all", count, held);
    return count == held && count >= wanted ? 0 : 1;
}

/// @param every  one situation of so many is looked at
int look_at(int every) {
    auto* const memory =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    auto& shared = *new (memory) Shared{};
    std::size_t const workers = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t worker = 0; worker < workers; ++worker) {
        if (::fork() != 0) continue;
        look_at_part(worker, workers, static_cast<std::size_t>(every), shared);
        std::_Exit(0);
    }
    bool all_ended = true;
    for (int status = 0; ::wait(&status) > 0;)
        all_ended = all_ended && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    int const code = print_table(shared, 5000 / every);
    return all_ended ? code : 1;
}

}  // namespace
}  // namespace vibrotrough::situations

// situations [EVERY]: looks at one situation of EVERY; at all by default.
int main(int count, char** words) {
    return vibrotrough::situations::look_at(count > 1 ? std::max(1, std::atoi(words[1])) : 1);
}
