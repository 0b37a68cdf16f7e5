#pragma once

#include <optional>
#include <vector>

#include "core/point.h"

namespace plat::streets {

/// What an intersection point knows of one of the two streets that may pass through it: the
/// attributes (i), (ii) and (iv) of [AVB08, Sec. 3.1.1]. Means and variances are those of the whole
/// street, so that all its points carry the same ones.
struct PassingStreet {
  int hierarchy = 0;                  ///< h: 0 for the main streets, one more per branching
  double tortuosity = 1.0;            ///< mean of curve length over distance of its ends, >= 1
  double distance_mean_m = 0.0;       ///< between consecutive intersection points
  double distance_variance_m2 = 0.0;  ///< of the sample; 0 where one distance is known
  double angle_mean_rad = 0.0;        ///< unsigned turn between consecutive segments, [0, pi]
  double angle_variance_rad2 = 0.0;   ///< of the sample; 0 where one turn is known
  double width_m = 0.0;               ///< full width; beyond the paper's list
  /// Segments of this street that meet here: 1 where it ends, 2 where it passes; beyond the paper's
  /// list, which lets every street pass.
  int connections = 2;

  friend bool operator==(const PassingStreet&, const PassingStreet&) = default;
};

/// A place where streets meet or end, and the style of the two streets that pass through it. A
/// crossing of more than two streets is several points at one place.
/// Paper: [AVB08, Sec. 3.1.1 and Fig. 4]
struct IntersectionPoint {
  Point place;                           ///< on the working grid
  PassingStreet a;                       ///< the street of the higher order: a.hierarchy <= b's
  std::optional<PassingStreet> b;        ///< none where a street ends and no other passes
  std::optional<double> parcel_area_m2;  ///< mean of the parcels nearby; none where no parcels are

  friend bool operator==(const IntersectionPoint&, const IntersectionPoint&) = default;
};

/// The streets of a point, one or two.
inline std::vector<PassingStreet> streets_of(const IntersectionPoint& point) {
  std::vector<PassingStreet> out{point.a};
  if (point.b) out.push_back(*point.b);
  return out;
}

}  // namespace plat::streets
