#include "campaign/state/notes.hpp"

#include "core/text.hpp"
#include "scenario/model/engine_plan.hpp"

namespace vibrotrough::campaign {
namespace {

namespace note = core::note;
using note::Json;

/// An outcome without a result. @throws note::Fault when it is unknown or has one
core::Outcome failed_outcome(Json const& json) {
    auto const outcome = core::outcome_named(note::text(json, "outcome"));
    if (!outcome || core::has_result(*outcome)) throw note::Fault("'outcome' is not that of a failure");
    return *outcome;
}

evaluate::LayerFriction friction_of(Json const& one) {
    evaluate::LayerFriction test{note::text(one, "layer"),
                                 note::text(one, "case"),
                                 note::number(one, "grain_friction", 0),
                                 note::number(one, "machine_number", 0),
                                 note::known_number(one, "max_relative_displacement"),
                                 note::known_number(one, "max_relative_displacement_half_width", 0),
                                 note::number(one, "creep_per_cycle"),
                                 note::known_number(one, "friction", 0),
                                 note::known_number(one, "friction_low", 0),
                                 note::known_number(one, "friction_high", 0),
                                 note::text(one, "mode"),
                                 note::text(one, "message")};
    if (test.friction && test.low && test.high &&
        !(*test.low <= *test.friction && *test.friction <= *test.high))
        throw note::Fault("'friction' lies outside of its own interval");
    return test;
}

}  // namespace

Failure parse_failure(std::string_view text) {
    Json const json = note::parse(text);
    return {failed_outcome(json), note::text(json, "message"), note::count(json, "packing", 1),
            note::count(json, "attempts", 1)};
}

CheckpointSeal parse_checkpoint(std::string_view text) {
    Json const json = note::parse(text);
    double const wall_time = note::number(json, "wall_time", 0);
    return {{note::count(json, "cycle", 1), note::text(json, "file"), note::text(json, "started"), wall_time,
             json.contains("core_time") ? note::number(json, "core_time", 0) : wall_time},
            note::text(json, "restart_sha256"),
            note::text(json, "deck_sha256")};
}

std::string parse_settled(std::string_view text) {
    return note::text(note::parse(text), "restart_sha256");
}

BatchNote parse_batch(std::string_view text) {
    Json const json = note::parse(text);
    BatchNote batch{note::text(json, "name"), {}};
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789-";
    if (!batch.name.starts_with("vibrotrough-") || batch.name.find_first_not_of(letters) != std::string::npos)
        throw note::Fault("'name' is not the name of a job of this program");
    if (json.contains("job")) batch.job = note::whole_number(json, "job", 1);
    return batch;
}

EngineNote parse_engine(std::string_view text) {
    Json const json = note::parse(text);
    EngineNote engine{note::text(json, "program"),
                      note::text(json, "version"),
                      note::text_if_any(json, "binary_sha256"),
                      {}};
    if (json.contains("templates")) engine.templates = note::texts(json, "templates");
    for (std::string const& name : engine.templates) {
        if (!scenario::is_template_name(name)) throw note::Fault("'templates' names other files");
    }
    return engine;
}

std::string to_json(EngineNote const& note) {
    Json json{{"program", core::harmless(note.program)}, {"version", note.version}};
    if (!note.binary_sha256.empty()) json["binary_sha256"] = note.binary_sha256;
    if (!note.templates.empty()) json["templates"] = note.templates;
    return json.dump(2) + "\n";
}

std::map<std::string, evaluate::LayerFriction> parse_friction(std::string_view text) {
    std::map<std::string, evaluate::LayerFriction> tests;
    Json const json = note::parse_sealed(text);
    // An older program wrote the list alone.
    for (Json const& one : json.is_array() ? note::elements(json) : note::list(json, "layers")) {
        evaluate::LayerFriction test = friction_of(one);
        if (test.friction && test.low && test.high) tests[test.layer] = test;
    }
    return tests;
}

Json parse_numerics(std::string_view text) {
    Json const json = note::parse_sealed(text);
    if (note::text(json, "format") != numerics_format ||
        note::count(json, "schema_version", 0) != numerics_schema)
        throw note::Fault("it is of another format or version");
    for (Json const& one : note::list(json, "cases")) {
        note::text(one, "case");
        note::known_number(one, "numerical_error", 0);
    }
    return json.at("cases");
}

}  // namespace vibrotrough::campaign
