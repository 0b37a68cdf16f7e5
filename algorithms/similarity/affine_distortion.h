#pragma once

#include <algorithm>

#include "core/affine.h"

namespace plat::similarity {

/// By what factor the larger of two positive numbers exceeds the smaller: max / min - 1.
constexpr double ratio_excess(double x, double y) { return std::max(x, y) / std::min(x, y) - 1.0; }

/// How far an affine map is from a rigid one; 0, 0, 0 for rigid ones.
///
/// With a and b the images of (1, 0) and (0, 1), without the shift:
///   e_scale  = max(|a + b|, sqrt 2) / min(|a + b|, sqrt 2) - 1
///   e_aspect = max(|a|, |b|) / min(|a|, |b|) - 1
///   e_shear  = max(angle(a, b), pi / 2) / min(angle(a, b), pi / 2) - 1
/// Guarantees: 1. a rotation behind the map changes nothing; one before it does, unless the map is
/// a similarity: (1, 0) and (0, 1) are special.
/// Paper:     [ABVA08, Eq. 4]
/// Deviation: the angle is that between a and b; cos^-1(a . b) as printed is it for unit vectors
///            only
struct AffineDistortion {
  double scale = 0.0;
  double aspect = 0.0;
  double shear = 0.0;
};

/// Pre: the map does not mirror and is regular.
AffineDistortion affine_distortion(const Affine& map);

/// The term e_shear of two vectors that span a positive area.
double shear_of(Point a, Point b);

}  // namespace plat::similarity
