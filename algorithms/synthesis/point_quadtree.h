#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/options.h"
#include "core/oriented_box.h"
#include "synthesis/point_set.h"

namespace plat::synthesis {

struct QuadtreeOptions {
  double min_area_m2 = 40000.0;
  std::int64_t min_points = 20;  ///< a quadrat of the coarsest test then expects five
  double significance_01 = 0.01;
  static constexpr auto fields() {
    return std::tuple{Field{"min_area_m2", &QuadtreeOptions::min_area_m2, 1.0, 1e9,
                            "No node is split into parts smaller than this, in m2."},
                      Field{"min_points", &QuadtreeOptions::min_points, 1, 1000000,
                            "No node with fewer points is split."},
                      Field{"significance_01", &QuadtreeOptions::significance_01, 0.0, 1.0,
                            "A node is split where points spread uniformly would be as clustered "
                            "with less than this probability."}};
  }
};

/// Style of the streets of one hierarchy level within a node.
struct LevelStyle {
  int hierarchy = 0;
  double probability_01 = 0.0;  ///< of the streets through the node's points
  streets::PassingStreet mean;  ///< every attribute its mean; `connections` rounded
};

/// A part of the streets of a node, ordered by level: from this share of them to that one. Levels
/// of two fragments correspond by rank and not by number: where main streets are few, level 0 of
/// the one is not level 0 of the other.
struct RankRange {
  double low_01 = 0.0;
  double high_01 = 1.0;
};

/// Whether a node was split, and why it was not.
enum class LeafReason : std::uint8_t { kNotALeaf, kUniform, kMinArea, kMinPoints };

/// A rectangle of the tree, in the frame of the box: the first axis along its longer side, the
/// origin at its centre.
struct QuadtreeNode {
  Point low;  ///< frame coordinates, metres
  Point high;
  LeafReason reason = LeafReason::kNotALeaf;
  std::uint32_t first_child = 0;           ///< of four that follow one another; where not a leaf
  std::vector<std::uint32_t> points{};     ///< of the node and all below it, ascending
  std::vector<LevelStyle> levels{};        ///< ascending by hierarchy
  std::optional<double> parcel_area_m2{};  ///< mean over the points that know one

  [[nodiscard]] bool is_leaf() const { return reason != LeafReason::kNotALeaf; }
  [[nodiscard]] double area_m2() const { return (high.x - low.x) * (high.y - low.y); }
};

/// Divides the oriented bounding box of a point set into rectangles with points of similar density.
///
/// A node is split in four until its points are spread uniformly, or it is too small, or holds too
/// few. "Uniformly" is a quadrat test: in a grid of k by k cells with at least five places expected
/// in each (2 <= k <= 8), the sum of (count - expected)^2 / expected is compared with the upper
/// tail of chi-square with k^2 - 1 degrees of freedom. One-sided: points more even than random
/// ones, as crossings of a grid, are uniform. Points at one place count once.
///
/// Guarantees: 1. the leaves divide the box without gap or overlap;  2. each point is in exactly
/// one leaf;  3. no node is smaller than `min_area_m2` but the root, none with fewer than
/// `min_points` places is split;  4. the probabilities of a node with points sum to one.
/// Complexity: O(n log n) for n points; the depth is bounded by the least area.
/// Paper: [AVB08, Sec. 4.1]
/// Deviation: the paper does not say when points are uniform (ADR 0029)
class PointQuadtree {
 public:
  explicit PointQuadtree(std::span<const streets::IntersectionPoint> points,
                         const QuadtreeOptions& options = {});

  [[nodiscard]] const OrientedBox& box() const { return box_; }
  /// The root first; empty where there are no points.
  [[nodiscard]] std::span<const QuadtreeNode> nodes() const { return nodes_; }
  [[nodiscard]] std::size_t leaf_count() const;
  /// Places per m2 of a node; none where it has no area.
  [[nodiscard]] std::optional<double> density_per_m2(std::uint32_t node) const;
  /// The corners of a node in the plane, counter-clockwise.
  [[nodiscard]] Ring corners(std::uint32_t node) const;

  /// Whether the box, with its boundary, holds the place.
  [[nodiscard]] bool contains(Point place) const;
  /// The nodes from the root to the leaf that holds the place; empty outside the box.
  [[nodiscard]] std::vector<std::uint32_t> path_to(Point place) const;
  /// Where a level stands in the order of levels, by the shares of the streets in the smallest node
  /// around the place that has streets of the level. Pre: the set has streets of the level.
  /// @returns none outside the box
  [[nodiscard]] std::optional<RankRange> ranks_at(Point place, int hierarchy) const;
  /// The mean style of the streets that stand there in the order of levels, in the smallest node
  /// around the place that has points; `hierarchy` is the first level that counts.
  /// @returns none outside the box
  [[nodiscard]] std::optional<streets::PassingStreet> style_at(Point place,
                                                               const RankRange& ranks) const;
  /// Mean area of the parcels in the smallest node around the place that knows one.
  [[nodiscard]] std::optional<double> parcel_area_at_m2(Point place) const;

 private:
  [[nodiscard]] Point to_frame(Point place) const;
  [[nodiscard]] Point from_frame(Point place) const;

  OrientedBox box_;
  std::vector<QuadtreeNode> nodes_;
  std::vector<std::size_t> place_counts_;  ///< per node
};

}  // namespace plat::synthesis
