#pragma once

#include <tuple>
#include <vector>

#include "core/options.h"
#include "streets/street_chains.h"
#include "streets/street_network.h"

namespace plat::streets {

/// What makes a street important.
enum class Importance { kLength, kWidth, kLengthTimesWidth };

struct HierarchyOptions {
  double main_share_01 = 0.03;  ///< of the chains, at least one, become level 0
  Importance importance = Importance::kLengthTimesWidth;
  static constexpr auto fields() {
    return std::tuple{
        Field{"main_share_01", &HierarchyOptions::main_share_01, 0.0, 1.0,
              "Share of the streets, the longest and widest, that become level 0; at least one."},
        EnumField{"importance",
                  &HierarchyOptions::importance,
                  {EnumName{"length", Importance::kLength}, EnumName{"width", Importance::kWidth},
                   EnumName{"length_times_width", Importance::kLengthTimesWidth}},
                  "What makes a street one of the longest and widest."}};
  }
};

/// Gives every chain its level: the most important are 0, those that meet one of level h and have
/// none yet are h + 1.
///
/// Guarantees: 1. as many are level 0 as the share says, rounded, at least one, and those that
/// guarantee 3 adds;  2. a chain of level h > 0 meets one of level h - 1 and none of a lower one;
/// 3. in a part of the network that no level 0 reaches, the most important chain is 0.  Of equally
/// important chains the first is the more important.
/// Pre: every street has a width, unless importance is length.
/// Complexity: O(n log n)
/// Paper: [AVB08, Sec. 5], where the order is Gravelius's of rivers with loops.
/// Deviation: 3., since the paper's fragments are connected; "crossing" is meeting at a node, so
/// that a side street that ends at a main street is of the next level, and a bridge over it is not
/// (ADR 0026).
void assign_hierarchy(const StreetNetwork& network, std::vector<StreetChain>& chains,
                      const HierarchyOptions& options = {});

}  // namespace plat::streets
