#pragma once

#include <utility>
#include <vector>

#include "core/affine.h"
#include "similarity/shape_similarity.h"
#include "tiles/tile_outline_internal.h"

namespace plat::tiles::detail {

/// A monotone map between places on two closed outlines, piecewise linear in their lengths.
class ArcMap {
 public:
  /// A place on the first outline and the one on the second that corresponds to it, metres.
  using Anchor = std::pair<double, double>;

  /// Of the anchors those are kept, in order, that go round both outlines in the same direction.
  /// Pre: at least one.
  ArcMap(double from_total_m, double to_total_m, std::vector<Anchor> anchors);

  [[nodiscard]] double to(double s) const;    ///< from the first to the second
  [[nodiscard]] double from(double t) const;  ///< from the second to the first
  [[nodiscard]] const std::vector<Anchor>& anchors() const { return anchors_; }

 private:
  double from_total_m_;
  double to_total_m_;
  std::vector<Anchor> anchors_;  ///< ascending from the first, which is the base of both
};

/// How one outline is laid on another.
struct OutlineMatch {
  Affine motion;  ///< rigid: where the first shape goes
  std::vector<ArcMap::Anchor> anchors;
};

/// The rigid motion nearest to what the similarity found, and what corresponds there; or, for a
/// measure without both, or where it is much nearer, the cyclic alignment of both outlines, as long
/// as each other, that leaves the least squares: of alignments as good, the one turned least
/// against `as_placed`.
/// Deviation: the paper does not say how position and orientation are computed (ADR 0039).
OutlineMatch match_outlines(const similarity::ShapeComparison& comparison, const ArcLength& from,
                            const ArcLength& to, const Affine& as_placed);

}  // namespace plat::tiles::detail
