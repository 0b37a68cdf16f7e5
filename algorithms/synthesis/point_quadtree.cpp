#include "synthesis/point_quadtree.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "core/failure.h"
#include "core/working_grid.h"

namespace plat::synthesis {
namespace {

using streets::IntersectionPoint;
using streets::PassingStreet;

/// Cells along each side of the quadrat test: five places expected in a cell keep the statistic
/// near its chi-square, and more cells than these would look at single blocks.
constexpr double kExpectedPerQuadrat = 5.0;
constexpr std::size_t kMinQuadratsPerSide = 2;
constexpr std::size_t kMaxQuadratsPerSide = 8;

/// Half a grid step of each coordinate, turned: how far a place on the box may seem to lie outside.
constexpr double kFrameTolerance_m = kGridStep_m;

std::size_t quadrat_of(double at, double low, double high, std::size_t per_side) {
  const double share = (at - low) / (high - low);
  const auto cell = static_cast<std::size_t>(share * static_cast<double>(per_side));
  return std::min(cell, per_side - 1);
}

/// Sum of (count - expected)^2 / expected over the cells of a grid laid over the node.
double dispersion(std::span<const Point> places, Point low, Point high, std::size_t per_side) {
  std::vector<double> counts(per_side * per_side, 0.0);
  for (const Point p : places) {
    counts[quadrat_of(p.y, low.y, high.y, per_side) * per_side +
           quadrat_of(p.x, low.x, high.x, per_side)] += 1.0;
  }
  const double expected = static_cast<double>(places.size()) / static_cast<double>(counts.size());
  double sum = 0.0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

bool is_uniform(std::span<const Point> places, Point low, Point high, double significance_01) {
  const auto wanted =
      static_cast<std::size_t>(std::sqrt(static_cast<double>(places.size()) / kExpectedPerQuadrat));
  const std::size_t per_side = std::clamp(wanted, kMinQuadratsPerSide, kMaxQuadratsPerSide);
  const auto degrees_of_freedom = static_cast<double>(per_side * per_side - 1);
  const double statistic = dispersion(places, low, high, per_side);
  return boost::math::gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic) >= significance_01;
}

/// Sums of a level's attributes.
struct LevelSum {
  double count = 0.0;
  double connections = 0.0;
  PassingStreet sum{.hierarchy = 0, .tortuosity = 0.0};

  void add(const PassingStreet& street, double weight = 1.0) {
    count += weight;
    sum.tortuosity += weight * street.tortuosity;
    sum.distance_mean_m += weight * street.distance_mean_m;
    sum.distance_variance_m2 += weight * street.distance_variance_m2;
    sum.angle_mean_rad += weight * street.angle_mean_rad;
    sum.angle_variance_rad2 += weight * street.angle_variance_rad2;
    sum.width_m += weight * street.width_m;
    connections += weight * street.connections;
  }
  [[nodiscard]] PassingStreet mean(int hierarchy) const {
    return {.hierarchy = hierarchy,
            .tortuosity = sum.tortuosity / count,
            .distance_mean_m = sum.distance_mean_m / count,
            .distance_variance_m2 = sum.distance_variance_m2 / count,
            .angle_mean_rad = sum.angle_mean_rad / count,
            .angle_variance_rad2 = sum.angle_variance_rad2 / count,
            .width_m = sum.width_m / count,
            .connections = static_cast<int>(std::lround(connections / count))};
  }
};

void describe(QuadtreeNode& node, std::span<const IntersectionPoint> points) {
  std::map<int, LevelSum> sums;
  double streets = 0.0;
  double parcel_sum_m2 = 0.0;
  double parcel_count = 0.0;
  for (const std::uint32_t i : node.points) {
    for (const PassingStreet& street : streets::streets_of(points[i])) {
      sums[street.hierarchy].add(street);
      streets += 1.0;
    }
    if (!points[i].parcel_area_m2) continue;
    parcel_sum_m2 += *points[i].parcel_area_m2;
    parcel_count += 1.0;
  }
  for (const auto& [hierarchy, sum] : sums) {
    node.levels.push_back({hierarchy, sum.count / streets, sum.mean(hierarchy)});
  }
  if (parcel_count > 0.0) node.parcel_area_m2 = parcel_sum_m2 / parcel_count;
}

/// The mean style of the streets from one share of the levels' order to another.
PassingStreet style_between(const QuadtreeNode& node, const RankRange& ranks) {
  LevelSum sum;
  std::optional<int> first;
  double below_01 = 0.0;
  for (const LevelStyle& level : node.levels) {
    const double above_01 = below_01 + level.probability_01;
    const double share_01 = std::min(ranks.high_01, above_01) - std::max(ranks.low_01, below_01);
    if (share_01 > 0.0) {
      sum.add(level.mean, share_01);
      if (!first) first = level.hierarchy;
    }
    below_01 = above_01;
  }
  // Rounding may leave nothing of the last level.
  return first ? sum.mean(*first) : node.levels.back().mean;
}

/// Which quarter of a node holds a place: south-west, south-east, north-west, north-east.
std::uint32_t quarter_of(Point middle, Point at) {
  return (at.x >= middle.x ? 1U : 0U) + (at.y >= middle.y ? 2U : 0U);
}

std::array<QuadtreeNode, 4> quarters(const QuadtreeNode& node) {
  const Point middle = midpoint(node.low, node.high);
  std::array<QuadtreeNode, 4> out;
  out[0] = {.low = node.low, .high = middle};
  out[1] = {.low = {middle.x, node.low.y}, .high = {node.high.x, middle.y}};
  out[2] = {.low = {node.low.x, middle.y}, .high = {middle.x, node.high.y}};
  out[3] = {.low = middle, .high = node.high};
  return out;
}

LeafReason reason_to_stop(const QuadtreeNode& node, std::span<const Point> places,
                          const QuadtreeOptions& options) {
  if (static_cast<std::int64_t>(places.size()) < options.min_points) return LeafReason::kMinPoints;
  if (0.25 * node.area_m2() < options.min_area_m2) return LeafReason::kMinArea;
  if (is_uniform(places, node.low, node.high, options.significance_01)) return LeafReason::kUniform;
  return LeafReason::kNotALeaf;
}

}  // namespace

PointQuadtree::PointQuadtree(std::span<const IntersectionPoint> points,
                             const QuadtreeOptions& options) {
  if (points.empty()) return;
  std::vector<Point> places;
  for (const IntersectionPoint& point : points) places.push_back(point.place);
  box_ = minimum_area_box(places);
  const Point half{0.5 * box_.length_m, 0.5 * box_.width_m};
  std::vector<Point> in_frame;
  for (const Point p : places) {
    const Point at = to_frame(p);
    in_frame.push_back({std::clamp(at.x, -half.x, half.x), std::clamp(at.y, -half.y, half.y)});
  }
  QuadtreeNode root{.low = -half, .high = half};
  for (std::uint32_t i = 0; i < points.size(); ++i) root.points.push_back(i);
  nodes_.push_back(std::move(root));
  for (std::uint32_t at = 0; at < nodes_.size(); ++at) {
    std::vector<Point> distinct;
    for (const std::uint32_t i : nodes_[at].points) distinct.push_back(in_frame[i]);
    std::ranges::sort(distinct);
    const auto repeated = std::ranges::unique(distinct);
    distinct.erase(repeated.begin(), repeated.end());
    place_counts_.push_back(distinct.size());
    describe(nodes_[at], points);
    nodes_[at].reason = reason_to_stop(nodes_[at], distinct, options);
    if (nodes_[at].is_leaf()) continue;
    std::array<QuadtreeNode, 4> children = quarters(nodes_[at]);
    for (const std::uint32_t i : nodes_[at].points) {
      children[quarter_of(children[3].low, in_frame[i])].points.push_back(i);
    }
    nodes_[at].first_child = static_cast<std::uint32_t>(nodes_.size());
    for (QuadtreeNode& child : children) nodes_.push_back(std::move(child));
  }
}

std::size_t PointQuadtree::leaf_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(nodes_, &QuadtreeNode::is_leaf));
}

std::optional<double> PointQuadtree::density_per_m2(std::uint32_t node) const {
  expects(node < nodes_.size(), "node in range");
  const double area = nodes_[node].area_m2();
  if (area <= 0.0) return std::nullopt;
  return static_cast<double>(place_counts_[node]) / area;
}

Ring PointQuadtree::corners(std::uint32_t node) const {
  expects(node < nodes_.size(), "node in range");
  const Point low = nodes_[node].low;
  const Point high = nodes_[node].high;
  return {from_frame(low), from_frame({high.x, low.y}), from_frame(high),
          from_frame({low.x, high.y})};
}

bool PointQuadtree::contains(Point place) const {
  if (nodes_.empty()) return false;
  const Point at = to_frame(place);
  return std::abs(at.x) <= 0.5 * box_.length_m + kFrameTolerance_m &&
         std::abs(at.y) <= 0.5 * box_.width_m + kFrameTolerance_m;
}

std::vector<std::uint32_t> PointQuadtree::path_to(Point place) const {
  if (!contains(place)) return {};
  const Point at = to_frame(place);
  std::vector<std::uint32_t> path{0};
  while (!nodes_[path.back()].is_leaf()) {
    const QuadtreeNode& node = nodes_[path.back()];
    path.push_back(node.first_child + quarter_of(midpoint(node.low, node.high), at));
  }
  return path;
}

std::optional<RankRange> PointQuadtree::ranks_at(Point place, int hierarchy) const {
  const std::vector<std::uint32_t> path = path_to(place);
  for (std::size_t i = path.size(); i > 0; --i) {
    double below_01 = 0.0;
    for (const LevelStyle& level : nodes_[path[i - 1]].levels) {
      if (level.hierarchy == hierarchy) return RankRange{below_01, below_01 + level.probability_01};
      below_01 += level.probability_01;
    }
  }
  expects(path.empty(), "the set has streets of the level");
  return std::nullopt;
}

std::optional<PassingStreet> PointQuadtree::style_at(Point place, const RankRange& ranks) const {
  const std::vector<std::uint32_t> path = path_to(place);
  for (std::size_t i = path.size(); i > 0; --i) {
    const QuadtreeNode& node = nodes_[path[i - 1]];
    if (!node.points.empty()) return style_between(node, ranks);
  }
  return std::nullopt;
}

std::optional<double> PointQuadtree::parcel_area_at_m2(Point place) const {
  const std::vector<std::uint32_t> path = path_to(place);
  for (std::size_t i = path.size(); i > 0; --i) {
    if (nodes_[path[i - 1]].parcel_area_m2) return nodes_[path[i - 1]].parcel_area_m2;
  }
  return std::nullopt;
}

Point PointQuadtree::to_frame(Point place) const {
  const Point arm = place - box_.center;
  return {dot(arm, box_.axis), dot(arm, perpendicular(box_.axis))};
}

Point PointQuadtree::from_frame(Point at) const {
  return box_.center + at.x * box_.axis + at.y * perpendicular(box_.axis);
}

}  // namespace plat::synthesis
