#pragma once

#include "store/case_record.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// What the tables need of a result: the record without its cycles, curves and decks. Every column of
/// campaign.h5 is the same from either.
CaseRecord summary_of(CaseRecord const& record);

/// The summary as CBOR (RFC 8949), for a cache on this machine: the facts, the estimate and the packings'
/// values in the order of schema.hpp. The scenario is not in it, because the case's id stands for it.
std::vector<std::uint8_t> pack_summary(CaseRecord const& record);

/// Reads back what pack_summary wrote.
/// @param scenario  of the case
/// @throws InputError when the bytes are not exactly one summary
CaseRecord unpack_summary(std::span<std::uint8_t const> bytes, scenario::Scenario const& scenario);

/// Changes whenever pack_summary writes something else than before.
std::string summary_layout();

}  // namespace vibrotrough::store
