#include "app/observing.hpp"

#include "app/exit_code.hpp"
#include "app/python.hpp"
#include "campaign/state/result_summary.hpp"
#include "compare/columns.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/note.hpp"
#include "core/shell.hpp"
#include "core/temporary_folder.hpp"
#include "evaluate/observable.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;
namespace note = core::note;
using note::Json;

constexpr char const* script = "vibrotrough.observe";

/// A function as Python lists it.
struct Function {
    store::Observable observable;
    std::string needs;  ///< frames, contacts, cycles or the name of a file
};

/// A case with a result, without its cycles.
using Records = std::map<std::string, store::CaseRecord>;

/// The folder in which the program and its script exchange files.
class Exchange {
  public:
    Exchange(ObservableSource const& source, std::string const& python) : source_(source), python_(python) {
        core::write_file_atomically(folder_.path() / "source.py", source.text);
    }

    /// Runs the script; its exit code, when that is for the person.
    int run(char const* task, Json request) {
        request["file"] = source_.file;
        core::write_file_atomically(folder_.path() / "request.json",
                                    request.dump(-1, ' ', false, Json::error_handler_t::replace));
        int const code =
            script_exit_code(script, {task, folder_.path().string()}, python_, {"numpy", "h5py"});
        if (code == all_well || code == wrong_input || code == interrupted) return code;
        throw core::MissingError(
            fmt::format("{} ended with exit code {}; the reason is in its messages above", script, code));
    }

    Json read(std::string const& name) const { return note::parse(core::read_file(folder_.path() / name)); }

  private:
    core::TemporaryFolder folder_{"vibrotrough-observe"};
    ObservableSource const& source_;
    std::string const& python_;
};

bool is_utf8(std::string const& text) {
    try {
        (void)Json(text).dump();
        return true;
    } catch (Json::exception const&) {
        return false;
    }
}

ObservableSource source_of(fs::path const& path, std::string text) {
    if (!is_utf8(text) || text.find('\0') != text.npos)
        throw core::InputError(fmt::format("{} is not a text in UTF-8; save it as one", path.string()));
    std::string const sha256 = core::sha256_hex(text);
    return {path.string(), std::move(text), sha256};
}

void check_unit(std::string const& name, std::string const& unit) {
    if (store::is_plain_unit(unit)) return;
    throw core::InputError(
        fmt::format("{}: '{}' is not a unit; write one such as \"m/s\", \"kg/m3\", or \"1\" for a "
                    "pure number",
                    name, unit));
}

void check_function(Function const& function) {
    store::Observable const& one = function.observable;
    if (!store::is_observable_name(one.name)) {
        throw core::InputError(
            fmt::format("'{}' cannot be the name of an observable; write lower-case letters, "
                        "digits and _, at most 60 of them",
                        one.name));
    }
    check_unit(one.name, one.unit);
    if (!one.is_number()) check_unit(one.name, one.over_unit);
    if (compare::is_name_of_program(one.name, one.unit)) {
        throw core::InputError(
            fmt::format("{} is already a quantity of the program ('vibrotrough quantities' lists "
                        "them); give your function another name",
                        one.name));
    }
}

/// The functions of the file that are wanted.
std::vector<Function> functions_in(Json const& list, ObservableSource const& source,
                                   std::vector<std::string> const& only) {
    std::vector<Function> functions;
    std::vector<std::string> names;
    for (Json const& one : note::elements(list)) {
        names.push_back(note::text(one, "name"));
        if (!only.empty() && std::ranges::find(only, names.back()) == only.end()) continue;
        functions.push_back({{names.back(),
                              note::text(one, "unit"),
                              note::text(one, "meaning"),
                              note::text(one, "over"),
                              note::text(one, "over_unit"),
                              fs::path(source.file).filename().string(),
                              source.text,
                              source.sha256,
                              {}},
                             note::text(one, "needs")});
        check_function(functions.back());
    }
    for (std::string const& name : only) {
        if (std::ranges::find(names, name) != names.end()) continue;
        throw core::InputError(fmt::format("--only: {} has no observable {}; it has {}", source.file, name,
                                           fmt::join(names, ", ")));
    }
    return functions;
}

Records finished_cases(campaign::Plan const& plan) {
    Records records;
    for (campaign::PlannedCase const& planned : plan.cases) {
        if (auto found = campaign::find_summary(planned))
            records.emplace(planned.id, std::move(found->record));
    }
    if (records.empty()) {
        throw core::InputError(fmt::format("{} holds no finished case yet; see 'vibrotrough status {}'",
                                           plan.folder.string(), core::shell_word(plan.folder)));
    }
    return records;
}

/// The rows of one packing; null stands for a point without a value.
evaluate::ObservedPacking packing_from(Json const& one) {
    evaluate::ObservedPacking packing{note::count(one, "number", 1), {}};
    for (Json const& row : note::list(one, "cycles")) {
        packing.cycles.emplace_back();
        for (Json const& value : note::elements(row)) {
            packing.cycles.back().push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                            : value.get<double>());
        }
    }
    return packing;
}

constexpr char const* has_no_value =
    "it has no value in any packing: it returned None, grains come or go, or frames of whole cycles are "
    "missing";

/// Adds what was measured in a case.
void add_case(Observed& observed, Json const& answer, store::CaseRecord const& record) {
    std::vector<evaluate::ObservedPacking> packings;
    for (Json const& one : note::list(answer, "packings")) packings.push_back(packing_from(one));
    if (packings.empty()) {
        observed.left_out.push_back(record.id);
        if (answer.at("has_needs").get<bool>()) observed.missing = has_no_value;
        return;
    }
    observed.observable.cases.push_back(
        evaluate::observe_case(record, packings, note::numbers(answer, "at")));
}

std::string missing(std::string const& needs) {
    constexpr char const* of_all = "; frame_packings = \"all\" keeps those of all packings";
    if (needs == "frames")
        return fmt::format(
            "no packing keeps frames: write frames_per_cycle = 20 under [output] in the campaign file{}, "
            "and run it again",
            of_all);
    if (needs == "contacts")
        return fmt::format(
            "no packing keeps contacts (layers of spheres can): write contacts = true and frames_per_cycle = "
            "20 under [output] in the campaign file{}, and run it again",
            of_all);
    return fmt::format("no packing has the file {}", needs == "cycles" ? "cycles.csv" : needs);
}

}  // namespace

ObservableSource shipped_observables() {
    fs::path const path = script_folder() / "vibrotrough/observables.py";
    return source_of(path, core::read_file(path, core::largest_note));
}

ObservableSource read_observable_source(std::string const& file, std::string const& allowed) {
    fs::path const path = fs::absolute(file).lexically_normal();
    std::error_code failure;
    if (!fs::is_regular_file(path, failure))
        throw core::InputError(fmt::format("{}: there is no such file", file));
    if (allowed.empty() || !fs::equivalent(path, allowed, failure)) {
        std::string const word = core::shell_word(file);
        throw core::InputError(
            fmt::format("{} is a program in Python, which can do anything that you can; read it, and "
                        "if you trust it allow it with --allow-python {}{}",
                        file, word, allowed.empty() ? "" : " (--allow-python names another file)"));
    }
    return source_of(path, core::read_file(path, core::largest_note));
}

Observing observe(campaign::Plan const& plan, ObservableSource const& source,
                  std::vector<std::string> const& only, std::string const& python) {
    Records const records = finished_cases(plan);
    Exchange exchange(source, python);
    if (int const code = exchange.run("list", {{"only", only}, {"cases", Json::array()}}); code != all_well)
        return {code};
    Observing result;
    Json names = Json::array(), folders = Json::array();
    std::vector<Function> const functions = functions_in(exchange.read("list.json"), source, only);
    for (Function const& one : functions) {
        names.push_back(one.observable.name);
        result.observed.push_back({one.observable, missing(one.needs)});
    }
    for (campaign::PlannedCase const& planned : plan.cases)
        if (records.contains(planned.id))
            folders.push_back(fs::absolute(planned.folder).lexically_normal().string());
    result.exit_code = exchange.run("measure", {{"only", names}, {"cases", folders}});
    if (result.exit_code != all_well) return result;
    for (campaign::PlannedCase const& planned : plan.cases) {
        auto const record = records.find(planned.id);
        if (record == records.end()) continue;
        Json const answers = exchange.read(planned.id + ".json");
        for (Observed& one : result.observed) {
            add_case(one, note::object(answers, one.observable.name), record->second);
            if (!one.observable.cases.empty()) one.missing.clear();
        }
    }
    return result;
}

}  // namespace vibrotrough::app
