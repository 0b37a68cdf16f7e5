#pragma once

#include <span>
#include <utility>

#include "core/affine.h"

namespace plat::similarity {

/// The rotation and translation that carry the first points to the second with the least sum of
/// squared distances; where no rotation is better than another, the translation alone. The identity
/// for no points.
///
/// Paper:       [Har, Sec. 5.1.3], (R, t)
/// Complexity:  O(n)
Affine rigid_alignment(std::span<const std::pair<Point, Point>> correspondence);

}  // namespace plat::similarity
