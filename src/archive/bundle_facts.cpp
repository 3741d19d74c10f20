#include "archive/bundle_facts.hpp"

namespace vibrotrough::archive {

BundleFacts parse_facts(std::string_view text) {
    namespace note = core::note;
    note::Json const json = note::parse(text);
    if (note::text(json, "format") != "vibrotrough archive" || note::count(json, "schema_version", 0) != 1)
        throw note::Fault("it does not describe a bundle that this version knows");
    BundleFacts facts{static_cast<std::size_t>(note::count(json, "results", 0)),
                      note::text(note::object(json, "archived_with"), "program_version"),
                      {}};
    for (note::Json const& one : note::list(json, "ended_without_result")) {
        auto const outcome = core::outcome_named(note::text(one, "outcome"));
        std::string const id = note::text(one, "case");
        if (outcome && !core::has_result(*outcome)) facts.failures.emplace(id, *outcome);
    }
    return facts;
}

}  // namespace vibrotrough::archive
