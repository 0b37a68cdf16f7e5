#pragma once

#include <vector>

#include "streets/random_walk_grower.h"
#include "streets/walk_slots_internal.h"
#include "streets/walk_steps_internal.h"

namespace plat::streets::detail {

/// Steps by which open ends that found none can still be joined to the points, the likeliest first:
/// from each free open end to each free slot of a point within reach, whatever its level; never to
/// another open end, which would change the existing network among itself. How likely: a
/// Gaussian of the turns at both ends and of the length. Distances that the existing street kept
/// say little here, for its last crossing may lie anywhere behind the place where it was cut.
///
/// Whether the plane admits a step is to be asked when its turn comes.
/// Deviation: [AVB08, Sec. 4.2] connects new points to the existing network and does not say how
/// (ADR 0027).
std::vector<WalkStep> open_end_joints(const WalkSlots& slots,
                                      const RandomWalkGrower::Options& options);

}  // namespace plat::streets::detail
