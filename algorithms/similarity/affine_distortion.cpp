#include "similarity/affine_distortion.h"

#include <cmath>
#include <numbers>

#include "core/failure.h"

namespace plat::similarity {

double shear_of(Point a, Point b) {
  constexpr double kRightAngle_rad = 0.5 * std::numbers::pi;
  return ratio_excess(std::atan2(cross(a, b), dot(a, b)), kRightAngle_rad);
}

AffineDistortion affine_distortion(const Affine& map) {
  expects(map.determinant() > 0.0, "a map that does not mirror");
  const Point a{map.xx, map.yx};
  const Point b{map.xy, map.yy};
  return {ratio_excess(length(a + b), std::numbers::sqrt2), ratio_excess(length(a), length(b)),
          shear_of(a, b)};
}

}  // namespace plat::similarity
