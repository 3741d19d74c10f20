#pragma once

#include "store/case_record.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vibrotrough::store {

/// The part of a result that the tables need: the record without its cycles, curves and decks. Every column
/// of campaign.h5 is the same from the record and from its summary, and so is whether an open trough is
/// steady: of its series `fed` the last number is kept.
CaseRecord summary_of(CaseRecord const& record);

/// The summary as CBOR (RFC 8949) after its SHA-256, for a cache on this machine: the facts, the estimate and
/// the packings' values in the order of schema.hpp. The scenario is not in it, because the case's id stands
/// for it.
std::vector<std::uint8_t> pack_summary(CaseRecord const& record);

/// The SHA-256 of the packed summary. Results with other numbers have another one.
std::string digest_of_summary(CaseRecord const& record);

/// Converts a packed summary back.
/// @param bytes     what pack_summary() returned
/// @param scenario  of the case
/// @throws core::InputError when the bytes are not exactly one summary
CaseRecord unpack_summary(std::span<std::uint8_t const> bytes, scenario::Scenario const& scenario);

/// A text that changes whenever pack_summary() would write other values, for recognising outdated caches.
std::string summary_layout();

}  // namespace vibrotrough::store
