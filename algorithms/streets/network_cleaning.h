#pragma once

#include <span>
#include <vector>

#include "streets/raw_street.h"
#include "streets/repair.h"
#include "streets/street_network.h"

namespace plat::streets {

struct CleaningOptions {
  /// An end closer than this to another street is moved onto it, metres. Drawn networks miss by
  /// decimetres, while the gap of two streets that end on purpose is more than a carriageway's
  /// half.
  double snap_m = 0.8;
};

struct CleanNetwork {
  StreetNetwork network;
  std::vector<Repair> repairs;  ///< in the order of the raw streets, then of the step
};

/// Makes a network of raw streets.
///
/// Guarantees: 1. streets of one level meet at nodes only, exactly;  2. a bridge or tunnel (level
/// other than 0) has no node where it crosses others, but is connected at its own ends;  3. every
/// vertex lies on the working grid;  4. no street has zero length, none runs along another of its
/// level;  5. at a node of two ends the two streets differ in an attribute: ways cut at a tile
/// border are one street again;  6. dead ends are kept;  7. all that was changed is a row.
/// Complexity: O(n log n + k) for n segments and k crossings, where segments are of similar length.
CleanNetwork build_network(std::span<const RawStreet> raw, const CleaningOptions& options = {});

}  // namespace plat::streets
