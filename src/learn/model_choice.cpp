#include "learn/model_choice.hpp"

#include "atlas/tables.hpp"
#include "core/error.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

/// A model that may decide, and the layers at which it does.
struct ModelToTry {
    DesignModel model;
    theory::Range depth;  ///< in diameters
    double max_throw_number;
};

std::vector<ModelToTry> models_to_try(ModelsToChoose const& models) {
    std::vector<ModelToTry> all;
    auto const& depths = atlas::inputs()[atlas::depth_input];
    if (models.atlas) all.push_back({*models.atlas, {depths.low, depths.high}, without_end});
    all.push_back({models.law, {0, without_end}, without_end});
    all.push_back({models.law,
                   {theory::tested_level.depth, theory::tested_deep.depth},
                   theory::tested_deep.throw_number.high});
    all.push_back({models.point_mass, {0, without_end}, without_end});
    return all;
}

/// The task in which a candidate decides and the others stand beside it.
DesignTask decided_by(DesignTask task, ModelsToChoose const& models, ModelToTry const& one,
                      std::vector<std::string> const& remarks) {
    task.models = {one.model};
    task.models.front().remarks.insert(task.models.front().remarks.end(), remarks.begin(), remarks.end());
    task.beside.clear();
    for (DesignModel const* other :
         {models.atlas ? &*models.atlas : nullptr, &models.law, &models.point_mass})
        if (other != nullptr && other->name != one.model.name) task.beside.push_back(*other);
    double const diameter = *task.grain_diameter;
    task.depth.low = std::max(task.depth.low, one.depth.low * diameter);
    task.depth.high = std::min(task.depth.high, one.depth.high * diameter);
    task.space.max_throw_number = std::min(task.space.max_throw_number, one.max_throw_number);
    return task;
}

std::string as_remark(std::string const& model, std::string const& why) {
    std::string text = fmt::format("{} does not decide: {}.", model, why);
    if (text.rfind("the ", 0) == 0) text.front() = 'T';
    return text;
}

/// What a candidate found, or why it found nothing: a clause.
struct TriedModel {
    std::optional<ChosenDesign> found;
    std::string why;
};

TriedModel try_model(DesignTask const& task) {
    if (task.depth.low > task.depth.high) return {{}, "none of its layers has a depth that is allowed"};
    try {
        ChosenDesign found{task, design_with_risk(task)};
        if (found.design.untested) return {{}, *found.design.untested};
        return {found, fmt::format("its layers are up to {:.3g} mm deep, and none carries so much so surely",
                                   1e3 * task.depth.high)};
    } catch (std::invalid_argument const& error) {
        return {{}, error.what()};
    } catch (core::InputError const& error) {
        return {{}, error.what()};
    }
}

}  // namespace

ChosenDesign design_by_known_model(DesignTask const& task, ModelsToChoose const& models) {
    std::vector<std::string> remarks;
    if (!models.atlas) remarks.push_back(as_remark("the atlas", models.why_no_atlas));
    std::optional<ChosenDesign> known;
    auto const candidates = models_to_try(models);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        DesignTask const one = decided_by(task, models, candidates[i], remarks);
        bool const is_last = i + 1 == candidates.size();
        if (is_last && !known) return {one, design_with_risk(one)};
        TriedModel const result = try_model(one);
        // A deeper layer may carry what this one does not: the next model is asked.
        bool const knows_all = one.depth.high >= task.depth.high;
        if (result.found && (result.found->design.feasible || knows_all)) return *result.found;
        if (result.found) known = result.found;
        std::string const& name = candidates[i].model.name;
        if (name != candidates[std::min(i + 1, candidates.size() - 1)].model.name)
            remarks.push_back(as_remark(name, result.why));
    }
    return *known;
}

}  // namespace vibrotrough::learn
