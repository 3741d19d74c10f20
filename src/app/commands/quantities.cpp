#include "app/commands/command.hpp"
#include "compare/exports.hpp"
#include "compare/stage_rows.hpp"
#include "core/outcome.hpp"
#include "store/reference.hpp"

namespace vibrotrough::app {
namespace {

std::string reference() {
    return "# Everything in the results\n\n"
           "Printed by `vibrotrough quantities`. The page \"Files and folders\" of the manual explains "
           "shapes, "
           "tables and missing values.\n\n" +
           store::file_reference() + "\n## Columns of compare\n\n" + compare::column_reference() +
           "\n## Columns of compare --stages\n\n" + compare::column_reference(compare::stage_columns()) +
           "\n## Outcomes\n\nWhat a case or a packing can come to.\n\n" + core::outcome_reference();
}

Json list_of(std::vector<store::NameInFile> const& names) {
    Json list = Json::array();
    for (auto const& [name, type, shape, units, meaning] : names) {
        list.push_back(
            {{"name", name}, {"type", type}, {"shape", shape}, {"units", units}, {"meaning", meaning}});
    }
    return list;
}

std::string as_json() {
    Json old = Json::object();
    for (auto const& [before, now] : store::old_names()) old[std::string(before)] = now;
    Json const json{{"result.h5", list_of(store::names_in_result())},
                    {"campaign.h5", list_of(store::names_in_campaign())},
                    {"columns", compare::column_descriptions()},
                    {"old_names", old}};
    return json.dump(2) + "\n";
}

}  // namespace

void add_quantities(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("quantities", "Print the reference of everything in the results");
    auto const json = std::make_shared<bool>(false);
    command->add_flag("--json", *json,
                      "Print it for scripts, with the names of version 0.2.0 that were replaced");
    command->footer(
        R"(Prints Markdown tables with name, type, units and meaning of everything in result.h5 and campaign.h5, of the
columns of compare, and of the outcomes.

Examples:
  vibrotrough quantities | less
  vibrotrough quantities --json > quantities.json)");
    command->callback([json, &exit_code] {
        fmt::print("{}", *json ? as_json() : reference());
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
