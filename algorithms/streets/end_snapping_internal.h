#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "streets/raw_street.h"
#include "streets/repair.h"

namespace plat::streets::detail {

/// A raw street on the working grid, no point repeated.
struct Way {
  std::uint32_t raw = 0;
  Polyline line;
};

/// Moves every loose end that lies within `snap_m` of another way onto it: onto one of its vertices
/// where one is near enough, else onto the nearest point. Ends on the ground do not meet the middle
/// of a bridge or tunnel.
void snap_loose_ends(std::span<const RawStreet> raw, double snap_m, std::vector<Way>& ways,
                     std::vector<Repair>& repairs);

}  // namespace plat::streets::detail
