#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/affine.h"
#include "core/failure.h"
#include "core/point.h"

namespace plat::tiles {

/// A point that is dragged, or that stays where it is.
struct ControlPoint {
  Point from;
  Point to;

  friend bool operator==(const ControlPoint&, const ControlPoint&) = default;
};

/// Warps the plane as an image program does, smoothly between control points: the baseline that
/// [ABVA08, Fig. 5d] compares with. It knows of no tiles.
///
/// Guarantees: 1. every control point arrives where it is to be;  2. controls that an affine map
/// moves are interpolated by that map;  3. of all maps that do 1, the bending energy is least.
/// Complexity:    O(n^3) of the control points to make, O(n) a point to warp
/// Paper:         thin-plate splines [Boo89]
/// Deviation:     the paper has a program's mesh warp, moved by hand
class MeshWarp {
 public:
  /// Failures: kOutOfRange for fewer than 3 control points, for all on one line, for two at one
  /// place and for what is not finite; kTooManyVertices for more than kMostControls.
  static Expected<MeshWarp> make(std::span<const ControlPoint> controls);
  static constexpr std::size_t kMostControls = 4000;

  [[nodiscard]] Point operator()(Point p) const;

 private:
  MeshWarp() = default;

  Point center_;
  double scale_m_ = 1.0;
  std::vector<Point> knots_;    ///< controls about the centre, in the scale
  std::vector<Point> weights_;  ///< one per knot
  Affine affine_;               ///< of points about the centre, in the scale, to metres
};

/// The affine map that is nearest to what points went through, in least squares.
struct AffineFit {
  Affine map;
  double residual_m = 0.0;  ///< root mean square distance of the points from where the map has them
};

/// Points on a line, or fewer than three, leave an affine map free: then the similarity that is
/// nearest, and for a single place the translation.
/// Pre: as many points from as to, at least one.
AffineFit fitted_affine(std::span<const Point> from, std::span<const Point> to);

}  // namespace plat::tiles
