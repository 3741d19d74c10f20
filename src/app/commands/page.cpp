#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/outputs.hpp"
#include "app/script_folder.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "core/note.hpp"
#include "core/own_program.hpp"
#include "learn/design_file.hpp"
#include "prepare/prepared_case.hpp"

#include <array>

namespace vibrotrough::app {
namespace {

struct PageArguments {
    std::vector<std::string> results;
    std::string output = "vibrotrough.html";
    Outputs outputs;
};

/// The columns of compare that the page draws or lists.
constexpr std::array<std::string_view, 16> page_columns{"case",
                                                        "throw_number",
                                                        "machine_number",
                                                        "stroke_mm",
                                                        "turns_per_minute",
                                                        "vibration_angle_deg",
                                                        "inclination_deg",
                                                        "friction",
                                                        "efficiency",
                                                        "efficiency_half_width",
                                                        "conveying_speed_m_per_s",
                                                        "conveying_speed_half_width_m_per_s",
                                                        "mass_flow_t_per_h",
                                                        "mass_flow_half_width_t_per_h",
                                                        "layer_mode",
                                                        "outcome"};

/// The page as it was built: installed with the program, or beside it in its build tree.
fs::path built_page() {
    std::error_code failure;
    fs::path const program = core::own_program().parent_path();
    fs::path const installed = program.parent_path() / installed_scripts / "page.html";
    for (fs::path const& file : {installed, (program / page_of_build).lexically_normal()})
        if (fs::is_regular_file(file, failure)) return file;
    throw core::MissingError(
        "the page was not built with this program; run './setup page' where Vibrotrough was built, or "
        "install "
        "its Debian package");
}

std::string name_of(std::string const& path) {
    return fs::path(path).lexically_normal().filename().string();
}

/// The rows of compare, as far as the page shows them.
Json cases_of(std::string const& folder) {
    campaign::Plan const plan = campaign::open_plan(folder);
    compare::ComparedCases const compared = compare::compared_cases(plan, campaign::activity_in(plan.folder));
    tell_left_aside(plan, compared.cases);
    Json cases = Json::array();
    for (compare::Row const& row : compared.rows) {
        Json const all = compare::to_object(row, compared.columns);
        Json one;
        auto const planned = std::ranges::find(plan.cases, row.id, &campaign::PlannedCase::id);
        one["label"] = planned == plan.cases.end() ? "" : planned->label;
        for (std::string_view const column : page_columns)
            if (all.contains(column)) one[std::string(column)] = all.at(std::string(column));
        if (planned != plan.cases.end())
            one["depth_mm"] = 1e3 * prepare::prepare_case(planned->scenario()).layer_height;
        cases.push_back(std::move(one));
    }
    return {{"name", name_of(folder)}, {"cases", cases}};
}

/// What is put into the page besides the theory; null where nothing was given.
struct Shown {
    Json campaign = nullptr;
    Json designs = Json::array();
};

/// A file .json is a design; a folder or any other file a campaign.
Shown read_results(std::vector<std::string> const& paths) {
    Shown shown;
    for (std::string const& path : paths) {
        if (fs::path(path).extension() == ".json" && !fs::is_directory(path)) {
            if (!fs::exists(path))
                throw core::InputError(fmt::format(
                    "{}: there is no such file; write 'vibrotrough design ... --json > design.json'", path));
            try {
                Json design = learn::proposed_machines(core::read_file(path));
                design["name"] = name_of(path);
                shown.designs.push_back(std::move(design));
            } catch (core::note::Fault const& fault) {
                throw core::InputError(fmt::format(
                    "{}: this is not what 'vibrotrough design --json' prints ({}); write 'vibrotrough "
                    "design ... --json > design.json'",
                    path, fault.what()));
            }
        } else if (shown.campaign.is_null()) {
            shown.campaign = cases_of(path);
        } else {
            throw core::InputError(
                fmt::format("{}: the page shows one campaign; leave one out, or put the cases of "
                            "both into one campaign",
                            path));
        }
    }
    constexpr std::size_t most = 2;
    if (shown.designs.size() > most)
        throw core::InputError("the page compares two designs; leave the others out");
    return shown;
}

/// Text that can stand within a script: no name may end it.
std::string for_script(Json const& json) {
    std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
        text.replace(at, 1, "\\u003c");
    return text;
}

/// Puts numbers into their place in the page.
void put(std::string& page, std::string const& identity, Json const& json) {
    std::string const place =
        fmt::format(R"(<script type="application/json" id="{}">null</script>)", identity);
    auto const at = page.find(place);
    if (at == std::string::npos)
        throw core::MissingError("the installed page is damaged; install Vibrotrough again");
    page.replace(at + place.find("null"), 4, for_script(json));
}

int run_page(PageArguments options) {
    options.outputs.inputs.assign(options.results.begin(), options.results.end());
    options.outputs.check("--output", options.output, page_mark);
    std::string page = core::read_file(built_page());
    Shown const shown = read_results(options.results);
    if (!shown.campaign.is_null()) put(page, "campaign", shown.campaign);
    if (!shown.designs.empty()) put(page, "designs", shown.designs);
    core::write_file_atomically(options.output, page);
    fmt::print("{}\n", options.output);
    return all_well;
}

}  // namespace

void add_page(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<PageArguments>();
    CLI::App* const command = program.add_subcommand(
        "page", "Write a page for browsers that computes speed and mass flow while you change the machine");
    command->add_option(
        "RESULTS", options->results,
        "Folder of a campaign's results, whose cases are "
        "drawn as points with bars; a FILE.json that 'vibrotrough design --json' printed, with whose "
        "machine the page begins, or two, which it compares");
    command->add_option("--output", options->output, "The file that is written")
        ->type_name("FILE.html")
        ->capture_default_str();
    options->outputs.add_to(*command);
    command->footer(
        R"(The page is one file that needs neither a network nor a server: open it in a browser, send it to colleagues. It computes
with the theory and the atlas of this program, compiled for browsers: the point mass and the rolling-layer law, with what both
missed in simulated layers, and within the atlas what 'vibrotrough predict' says. A link holds all inputs, and 'Copy as campaign
file' gives what 'vibrotrough run' simulates.

With a design, machine A is the proposed one, and machine B the second best of several speeds of the drive (--rpm 960,1450) or
that of the second file, for example the proposal of another model. The required mass flow is a line, and what the design says of
each machine stands beside the answer of the page.

Examples:
  vibrotrough page
  vibrotrough page runs/demo --output demo.html
  vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
      --friction 0.3 --json > design.json
  vibrotrough page design.json)");
    command->callback([options, &exit_code] { exit_code = run_page(*options); });
}

}  // namespace vibrotrough::app
