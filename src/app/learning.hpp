#pragma once

#include "app/campaign_run.hpp"
#include "learn/learner.hpp"

#include <map>
#include <string>
#include <vector>

namespace vibrotrough::app {

/// "4 core-hours" in core-seconds. @throws core::InputError naming the option --budget
double read_core_time(std::string const& text);

/// Values of keys that a campaign varies, by their whole paths.
/// @param settings  of the option --at, each "KEY=VALUE"
/// @throws core::InputError when one is wrong or given twice
std::map<std::string, scenario::Content> read_place(std::vector<std::string> const& settings,
                                                    scenario::CaseMaker const& maker);

/// Cases that are chosen at once unless the user says otherwise: as few as keep all jobs busy, since later
/// choices know more. Each case begins with several packings.
int usual_batch(int jobs, campaign::Plan const& plan);

/// Simulates the cases of a campaign until each is as precise as wanted.
/// @param wanted  half-widths by case; those of the plan that are missing get the campaign file's
/// @return whether it came to its end; false when it was interrupted
bool simulate(RunOptions const& options, ReadyCampaign& ready, std::map<std::string, double>& wanted);

/// Says how many cases of another layer are left out of what is learnt; nothing when there are none.
void tell_of_other_layers(int count);

/// Keeps the cases that were learnt from before, though the campaign file does not name them any more because
/// its start was larger. Those of another layer, from before a key outside the domain was edited, are left
/// out; they stay where they are.
void keep_known_cases(campaign::Plan& plan, scenario::CaseMaker const& maker,
                      std::map<std::string, double> const& wanted);

/// Adds the cases of a batch to the plan, and remembers what is wanted of them and of those that go on.
/// @return whether anything is new; otherwise the next round would simulate nothing
bool take_steps(std::vector<learn::LearnStep> const& steps, campaign::Plan& plan,
                std::map<std::string, double>& wanted);

}  // namespace vibrotrough::app
