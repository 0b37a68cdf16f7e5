#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "blocks/block.h"
#include "core/failure.h"
#include "parcels/lot.h"
#include "parcels/partition.h"
#include "parcels/subdivision_trace.h"

namespace plat::parcels {

/// How a lot is divided: into at least two lots, or nothing where it stays whole. The seed is the
/// lot's own.
using SplitRule = std::function<std::optional<SplitResult>(const Lot& lot, std::uint64_t seed)>;

/// Divides a block by a rule, the lots again by the same, until every lot stays whole.
///
/// Guarantees: 1. the seeds of a lot's children are fixed before the recursion, so an edit in one
/// part of a block leaves the divisions elsewhere as they are [VKW12, Sec. 4.3, "random seeds"].
/// @param remedy  which option to change where the lots become too many, for the message
/// @returns       Failure kNoConvergence beyond kMaxLotsPerBlock lots
Expected<BlockPartition> divide_recursively(const blocks::Block& block, std::uint64_t seed,
                                            const SplitRule& rule, std::string_view remedy);

/// The same, every split shown: kLotBox and kSplit, numbered by the depth of the recursion.
/// Instantiated for SubdivisionTrace.
template <SubdivisionVisitor Visitor>
Expected<BlockPartition> divide_recursively(const blocks::Block& block, std::uint64_t seed,
                                            const SplitRule& rule, std::string_view remedy,
                                            Visitor& visitor);

bool has_street_access(const Lot& lot);

/// Whether every new lot has street access, or the divided one has none to lose.
bool keeps_street_access(const Lot& lot, const SplitResult& split);

}  // namespace plat::parcels
