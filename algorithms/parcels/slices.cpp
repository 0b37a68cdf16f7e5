#include "parcels/slices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "core/working_grid.h"

namespace plat::parcels {
namespace {

using ArcRole = StripLayout::ArcRole;

/// A spacing is kept above this share of its mean, so that no draw makes a lot of no width.
constexpr double kMinSpacingShare = 0.25;

struct Front {
  Point point;
  std::uint32_t edge = 0;
};

/// The point at `s` metres along psi.
Front point_on_front(const StripLayout& layout, const Strip& strip, double s) {
  for (const std::uint32_t e : strip.edges) {
    const Segment edge = contour_segment(layout, e);
    const double size = length(edge);
    if (s < size || e == strip.edges.back())
      return {lerp(edge.a, edge.b, std::min(s / size, 1.0)), e};
    s -= size;
  }
  return {};
}

class Slicer {
 public:
  explicit Slicer(const StripLayout& layout) : layout_(layout) {
    find_ways_to_walls();
    hits_.resize(layout.skeleton.arcs.size());
    is_passed_.resize(layout.skeleton.arcs.size(), false);
    const auto& nodes = layout.skeleton.nodes;
    for (std::uint32_t k = 0; k < layout.skeleton.arcs.size(); ++k) {
      const auto& arc = layout.skeleton.arcs[k];
      // An arc from which no wall is reached cannot guide: the slice goes straight on instead.
      if (layout.roles[k] == ArcRole::kGuide && reaches_wall(arc.upper)) {
        obstacles_.push_back({{nodes[arc.lower].position, nodes[arc.upper].position}, k, false});
      }
    }
    for (const Segment& wall : layout.walls) obstacles_.push_back({wall, kNone, false});
    for_each_edge(layout.contour,
                  [&](const Segment& s) { obstacles_.push_back({s, kNone, true}); });
    reach_m_ = box_of(layout.contour).width() + box_of(layout.contour).height();
  }

  void slice(const Front& front, std::vector<Segment>& cuts) {
    const Segment edge = contour_segment(layout_, front.edge);
    const Point inward = perpendicular(normalized(edge.b - edge.a));
    const Segment ray{front.point, front.point + reach_m_ * inward};
    double nearest = std::numeric_limits<double>::infinity();
    Obstacle met;
    for (const Obstacle& obstacle : obstacles_) {
      const std::optional<double> t = meet(ray, obstacle.segment);
      if (t && *t * reach_m_ > kClearance_m && *t < nearest) {
        nearest = *t;
        met = obstacle;
      }
    }
    if (!std::isfinite(nearest)) return;
    const Point hit = lerp(ray.a, ray.b, nearest);
    const double beyond_m = met.is_contour ? layout_.slack_m : 0.0;
    cuts.push_back({snap(front.point - layout_.slack_m * inward), snap(hit + beyond_m * inward)});
    if (met.guide != kNone) follow(met.guide, hit);
  }

  /// The guides that slices follow, each once, from slice to slice: hundreds of slices may share
  /// one, and cuts on top of each other cost noding the square of their number.
  void add_guides(std::vector<Segment>& cuts) const {
    for (std::size_t k = 0; k < hits_.size(); ++k) {
      if (hits_[k].empty() && !is_passed_[k]) continue;
      const Point lower = layout_.skeleton.nodes[layout_.skeleton.arcs[k].lower].position;
      const Point upper = layout_.skeleton.nodes[layout_.skeleton.arcs[k].upper].position;
      std::vector<std::pair<double, Point>> stops;
      for (const Point hit : hits_[k]) stops.emplace_back(dot(hit - lower, upper - lower), hit);
      std::sort(stops.begin(), stops.end());
      if (is_passed_[k]) cuts.push_back({lower, stops.empty() ? upper : stops.front().second});
      for (std::size_t i = 0; i < stops.size(); ++i) {
        cuts.push_back({stops[i].second, i + 1 < stops.size() ? stops[i + 1].second : upper});
      }
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  /// A ray has left its own edge, whose point was rounded, after this much.
  static constexpr double kClearance_m = 2.0 * kGridStep_m;

  struct Obstacle {
    Segment segment;
    std::uint32_t guide = kNone;  ///< the arc, if it is one to follow
    bool is_contour = false;
  };

  /// The ray's parameter where it meets the segment.
  static std::optional<double> meet(const Segment& ray, const Segment& s) {
    const Point d = ray.b - ray.a;
    const Point e = s.b - s.a;
    const double denominator = cross(d, e);
    if (denominator == 0.0) return std::nullopt;
    const double t = cross(s.a - ray.a, e) / denominator;
    const double u = cross(s.a - ray.a, d) / denominator;
    if (t < 0.0 || u < 0.0 || u > 1.0) return std::nullopt;
    return t;
  }

  [[nodiscard]] bool reaches_wall(std::uint32_t node) const {
    return layout_.is_wall_node[node] || way_[node] != kNone;
  }

  /// Per node, the arc that starts the shortest way to a wall along guides that do not descend to
  /// the street (Dijkstra from the walls; equal heights are common, where the streets of a strip
  /// run parallel).
  void find_ways_to_walls() {
    const auto& nodes = layout_.skeleton.nodes;
    way_.assign(nodes.size(), kNone);
    std::vector<std::vector<std::uint32_t>> arcs_at(nodes.size());
    for (std::uint32_t k = 0; k < layout_.skeleton.arcs.size(); ++k) {
      if (layout_.roles[k] != ArcRole::kGuide) continue;
      arcs_at[layout_.skeleton.arcs[k].lower].push_back(k);
      arcs_at[layout_.skeleton.arcs[k].upper].push_back(k);
    }
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<double> best(nodes.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t v = 0; v < nodes.size(); ++v) {
      if (!layout_.is_wall_node[v]) continue;
      best[v] = 0.0;
      open.emplace(0.0, v);
    }
    while (!open.empty()) {
      const auto [d, v] = open.top();
      open.pop();
      if (d > best[v]) continue;
      for (const std::uint32_t k : arcs_at[v]) {
        const auto& arc = layout_.skeleton.arcs[k];
        const std::uint32_t below = arc.lower == v ? arc.upper : arc.lower;
        if (nodes[below].time_m > nodes[v].time_m + kGridStep_m) continue;
        const double through = d + distance(nodes[v].position, nodes[below].position);
        if (through >= best[below]) continue;
        best[below] = through;
        way_[below] = k;
        open.emplace(through, below);
      }
    }
  }

  /// Marks the way along the arc and those after it, away from the street, to the strip's boundary.
  void follow(std::uint32_t guide, Point from) {
    hits_[guide].push_back(snap(from));
    std::uint32_t node = layout_.skeleton.arcs[guide].upper;
    while (!layout_.is_wall_node[node] && !is_passed_[way_[node]]) {  // ways get shorter: this ends
      is_passed_[way_[node]] = true;
      const auto& arc = layout_.skeleton.arcs[way_[node]];
      node = arc.lower == node ? arc.upper : arc.lower;
    }
  }

  const StripLayout& layout_;
  std::vector<Obstacle> obstacles_;
  std::vector<std::uint32_t> way_;        ///< per node: the guide on which to go on to a wall
  std::vector<std::vector<Point>> hits_;  ///< per arc: where slices meet it and turn into it
  std::vector<bool> is_passed_;           ///< per arc: a slice follows it from end to end
  double reach_m_ = 0.0;
};

}  // namespace

std::vector<double> slice_positions(double from_m, double to_m, bool is_closed,
                                    const SliceSpacing& spacing, Rng& rng) {
  const double room = to_m - from_m;
  const int lots = std::max(1, static_cast<int>(std::min(std::round(room / spacing.mean_m), 1e5)));
  const double deviation = std::sqrt(3.0 * spacing.irregularity);
  std::vector<double> widths;
  double sum = 0.0;
  for (int i = 0; i < lots; ++i) {
    widths.push_back(
        std::max(rng.normal(spacing.mean_m, deviation), kMinSpacingShare * spacing.mean_m));
    sum += widths.back();
  }
  std::vector<double> out;
  double at = from_m;
  if (is_closed && lots > 1) out.push_back(at);  // a front without ends needs a first cut, too
  for (int i = 0; i + 1 < lots; ++i) {
    at += widths[static_cast<std::size_t>(i)] * room / sum;
    out.push_back(at);
  }
  return out;
}

std::vector<Segment> slice_strips(const StripLayout& layout, const SliceSpacing& spacing,
                                  Rng& rng) {
  Slicer slicer(layout);
  std::vector<Segment> cuts;
  const std::uint64_t seed = rng();
  for (const Strip& strip : layout.strips) {
    Rng stream(derive_seed(seed, {static_cast<std::uint64_t>(&strip - layout.strips.data())}));
    const double from = strip.trimmed_start_m;
    const double to = front_length_m(layout, strip) - strip.trimmed_end_m;
    if (to <= from) continue;  // all of the strip changed hands
    for (const double s : slice_positions(from, to, strip.is_closed, spacing, stream)) {
      slicer.slice(point_on_front(layout, strip, s), cuts);
    }
  }
  slicer.add_guides(cuts);
  return cuts;
}

}  // namespace plat::parcels
