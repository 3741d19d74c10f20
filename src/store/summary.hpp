#pragma once

#include "store/case_record.hpp"

#include <string>
#include <string_view>

namespace vibrotrough::store {

/// What the tables need of a result: the record without its cycles, curves and decks. Every column of
/// campaign.h5 is the same from either.
CaseRecord summary_of(CaseRecord const& record);

/// The summary as bytes, for a cache on this machine: facts, estimate and the packings' values, as schema.hpp
/// lists them; not the scenario, which the case's id stands for.
std::string pack_summary(CaseRecord const& record);

/// Reads back what pack_summary wrote and takes it from the front of `bytes`.
/// @param scenario  of the case
/// @throws InputError when the bytes end too early or hold nonsense
CaseRecord unpack_summary(std::string_view& bytes, scenario::Scenario const& scenario);

/// Changes whenever pack_summary writes something else than before.
std::string summary_layout();

}  // namespace vibrotrough::store
