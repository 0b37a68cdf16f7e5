#include "parcels/strips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/working_grid.h"
#include "parcels/skeleton_offset.h"

namespace plat::parcels {
namespace {

using ArcRole = StripLayout::ArcRole;
constexpr std::uint32_t kNoStrip = StripLayout::kNoStrip;
/// A corner region runs at most this many times its depth along the street that loses it. Where
/// streets meet at less than 53 degrees, the common boundary is the row's centreline, not a
/// diagonal, and stays (ADR 0006).
constexpr double kMaxCornerRatio = 2.0;

/// Consecutive range of contour edges that form one ring.
struct RingRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

std::vector<RingRange> ring_ranges(const Polygon& contour) {
  std::vector<RingRange> out{{0, static_cast<std::uint32_t>(contour.outer.size())}};
  for (const Ring& hole : contour.holes) {
    out.push_back({out.back().first + out.back().count, static_cast<std::uint32_t>(hole.size())});
  }
  return out;
}

/// Consecutive street edges with one logical street make a strip.
void make_alpha_strips(StripLayout& layout) {
  layout.strip_of_edge.assign(layout.labels.size(), kNoStrip);
  for (const RingRange& range : ring_ranges(layout.contour)) {
    const auto label = [&](std::uint32_t k) {
      return layout.labels[range.first + k % range.count].logical_street;
    };
    std::uint32_t start = 0;
    while (start < range.count && label(start) && label(start) == label(start + range.count - 1))
      ++start;
    const bool is_closed = start == range.count;
    if (is_closed) start = 0;
    for (std::uint32_t k = start; k < start + range.count; ++k) {
      if (!label(k)) continue;
      const bool continues = k > start && label(k) == label(k + range.count - 1);
      if (!continues) layout.strips.push_back({{}, 0.0, 0.0, is_closed});
      const std::uint32_t edge = range.first + k % range.count;
      layout.strips.back().edges.push_back(edge);
      layout.strip_of_edge[edge] = static_cast<std::uint32_t>(layout.strips.size() - 1);
    }
  }
}

double arc_length(const StraightSkeleton& skeleton, const StraightSkeleton::Arc& arc) {
  return distance(skeleton.nodes[arc.lower].position, skeleton.nodes[arc.upper].position);
}

/// Faces on no street join the strip they share the longest boundary with, nearest first.
void absorb_faces_without_street(StripLayout& layout) {
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> shared;  // (face, strip) -> length
    for (const auto& arc : layout.skeleton.arcs) {
      for (const int side : {0, 1}) {
        const std::uint32_t face = arc.faces[side];
        const std::uint32_t strip = layout.strip_of_edge[arc.faces[1 - side]];
        if (layout.strip_of_edge[face] == kNoStrip && strip != kNoStrip) {
          shared[{face, strip}] += arc_length(layout.skeleton, arc);
        }
      }
    }
    std::map<std::uint32_t, std::pair<double, std::uint32_t>> best;  // face -> (length, strip)
    for (const auto& [key, length] : shared) {
      auto& b = best.try_emplace(key.first, -1.0, kNoStrip).first->second;
      if (length > b.first) b = {length, key.second};
    }
    for (const auto& [face, choice] : best) {
      layout.strip_of_edge[face] = choice.second;
      changed = true;
    }
  }
}

void assign_roles(StripLayout& layout) {
  for (const auto& arc : layout.skeleton.arcs) {
    const auto strip = [&](int side) { return layout.strip_of_edge[arc.faces[side]]; };
    const auto has_street = [&](int side) { return layout.labels[arc.faces[side]].is_street(); };
    ArcRole role = ArcRole::kWall;
    if (strip(0) == kNoStrip || strip(1) == kNoStrip)
      role = ArcRole::kIgnored;
    else if (strip(0) == strip(1))
      role = has_street(0) && has_street(1) ? ArcRole::kGuide : ArcRole::kIgnored;
    layout.roles.push_back(role);
  }
}

/// Hands the corner regions over, one convex corner after the other.
class CornerRegions {
 public:
  CornerRegions(StripLayout& layout, CornerScheme scheme) : layout_(layout), scheme_(scheme) {
    arcs_at_.resize(layout.skeleton.nodes.size());
    for (std::uint32_t a = 0; a < layout.skeleton.arcs.size(); ++a) {
      arcs_at_[layout.skeleton.arcs[a].lower].push_back(a);
      arcs_at_[layout.skeleton.arcs[a].upper].push_back(a);
    }
  }

  void run() {
    for (std::uint32_t s = 0; s < layout_.strips.size(); ++s) {
      if (layout_.strips[s].is_closed) continue;
      const std::uint32_t last = layout_.strips[s].edges.back();
      const std::uint32_t vertex = edge_after(last);
      const std::uint32_t next = layout_.strip_of_edge[vertex];
      if (next == s || !layout_.labels[vertex].is_street()) continue;
      hand_over(s, next, last, vertex);
    }
  }

 private:
  [[nodiscard]] std::uint32_t edge_after(std::uint32_t edge) const {
    for (const RingRange& r : ring_ranges(layout_.contour)) {
      if (edge < r.first + r.count) return edge + 1 == r.first + r.count ? r.first : edge + 1;
    }
    return edge;
  }

  /// The share of the corner at the start of contour edge `vertex`, between strips `previous` and
  /// `next`.
  void hand_over(std::uint32_t previous, std::uint32_t next, std::uint32_t last,
                 std::uint32_t vertex) {
    const Segment in = contour_segment(layout_, last);
    const Segment out = contour_segment(layout_, vertex);
    if (cross(in.b - in.a, out.b - out.a) <= 0.0) return;  // T(v) = None at reflex corners
    const double weight = importance(previous) - importance(next);
    if (weight == 0.0) return;  // T(v) = None
    const bool to_previous = weight > 0.0;
    const std::uint32_t loser = to_previous ? next : previous;

    // (i) the point on the common boundary that is farthest from the contour.
    const std::vector<std::uint32_t> path = common_boundary(vertex, previous, next);
    if (path.empty()) return;
    const Point far = layout_.skeleton.nodes[far_node_].position;
    // (ii) the nearest point on psi of the strip that loses the region.
    const std::optional<Foot> foot = nearest_front_point(loser, far, to_previous);
    if (!foot || foot->from_corner_m > kMaxCornerRatio * layout_.skeleton.nodes[far_node_].time_m)
      return;
    double& trimmed =
        to_previous ? layout_.strips[loser].trimmed_start_m : layout_.strips[loser].trimmed_end_m;
    trimmed = std::max(trimmed, foot->from_corner_m);
    for (const std::uint32_t a : path) layout_.roles[a] = ArcRole::kIgnored;
    const Point beyond = foot->point + layout_.slack_m * normalized(foot->point - far);
    layout_.walls.push_back({far, snap(beyond)});
    layout_.is_wall_node[far_node_] = true;
    ignore_guides_inside(region(path, vertex, *foot, far));
  }

  [[nodiscard]] double importance(std::uint32_t strip) const {
    const Strip& s = layout_.strips[strip];
    if (scheme_ == CornerScheme::kStreetLength) return front_length_m(layout_, s);
    double sum = 0.0;
    for (const std::uint32_t e : s.edges)
      sum += layout_.labels[e].street_width_m * length(contour_segment(layout_, e));
    const double width = sum / front_length_m(layout_, s);
    // Streets of equal measured width: the longer one is the more important. A metre and a
    // kilometre of front differ by less than the least difference of widths on the working grid.
    return std::round(width * 100.0) + 1e-6 * std::min(front_length_m(layout_, s), 1e5);
  }

  /// Arcs from the corner up to the farthest node that still separate the two strips; sets
  /// far_node_.
  std::vector<std::uint32_t> common_boundary(std::uint32_t vertex, std::uint32_t a,
                                             std::uint32_t b) {
    std::vector<std::uint32_t> path;
    std::uint32_t node = vertex;
    far_node_ = vertex;
    for (;;) {
      std::optional<std::uint32_t> up;
      for (const std::uint32_t k : arcs_at_[node]) {
        const auto& arc = layout_.skeleton.arcs[k];
        if (arc.lower != node || layout_.roles[k] != ArcRole::kWall) continue;
        const std::uint32_t s = layout_.strip_of_edge[arc.faces[0]];
        const std::uint32_t t = layout_.strip_of_edge[arc.faces[1]];
        if ((s == a && t == b) || (s == b && t == a)) up = k;
      }
      if (!up || path.size() > layout_.skeleton.arcs.size()) return path;
      path.push_back(*up);
      node = layout_.skeleton.arcs[*up].upper;
      far_node_ = node;
    }
  }

  struct Foot {
    Point point;
    double from_corner_m = 0.0;  ///< along psi, from the corner
    std::vector<Point> front;    ///< contour vertices passed on the way from the corner
  };

  /// The nearest point of psi(loser) to `far` that a straight line inside the strip reaches.
  [[nodiscard]] std::optional<Foot> nearest_front_point(std::uint32_t loser, Point far,
                                                        bool from_start) const {
    std::vector<std::uint32_t> edges = layout_.strips[loser].edges;
    if (!from_start) std::reverse(edges.begin(), edges.end());
    std::vector<std::pair<double, Foot>> candidates;
    double passed = 0.0;
    std::vector<Point> front;
    for (const std::uint32_t e : edges) {
      Segment s = contour_segment(layout_, e);
      if (!from_start) std::swap(s.a, s.b);
      const double t = nearest_parameter(s, far);
      const Point at = snap(lerp(s.a, s.b, t));
      candidates.push_back({distance(at, far), Foot{at, passed + t * length(s), front}});
      passed += length(s);
      front.push_back(s.b);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [d, foot] : candidates) {
      if (foot.from_corner_m > 0.0 && is_inside_strip(loser, far, foot.point))
        return std::move(foot);
    }
    return std::nullopt;
  }

  /// Whether the open segment meets neither the contour nor a wall of the strip; its ends, which
  /// lie on them, are left out of the test.
  [[nodiscard]] bool is_inside_strip(std::uint32_t strip, Point from, Point to) const {
    // Its ends lie on what must not be crossed, give or take the rounding to the grid.
    const double margin =
        std::min(0.25, 4.0 * kGridStep_m / std::max(distance(from, to), kGridStep_m));
    const Segment probe{lerp(from, to, margin), lerp(from, to, 1.0 - margin)};
    const auto crosses = [&](const Segment& s) {
      return orientation(s.a, s.b, probe.a) * orientation(s.a, s.b, probe.b) < 0.0 &&
             orientation(probe.a, probe.b, s.a) * orientation(probe.a, probe.b, s.b) < 0.0;
    };
    bool is_free = true;
    for_each_edge(layout_.contour, [&](const Segment& s) { is_free = is_free && !crosses(s); });
    for (std::uint32_t k = 0; is_free && k < layout_.skeleton.arcs.size(); ++k) {
      const auto& arc = layout_.skeleton.arcs[k];
      const bool is_wall_of_strip = (layout_.strip_of_edge[arc.faces[0]] == strip) !=
                                    (layout_.strip_of_edge[arc.faces[1]] == strip);
      if (is_wall_of_strip) {
        is_free = !crosses({layout_.skeleton.nodes[arc.lower].position,
                            layout_.skeleton.nodes[arc.upper].position});
      }
    }
    return is_free;
  }

  /// The outline of the region that changes hands; its orientation depends on the corner's side.
  [[nodiscard]] Ring region(const std::vector<std::uint32_t>& path, std::uint32_t vertex,
                            const Foot& foot, Point far) const {
    Ring ring{layout_.skeleton.nodes[vertex].position};
    for (const Point p : foot.front) ring.push_back(p);
    ring.push_back(foot.point);
    ring.push_back(far);
    for (auto it = path.rbegin(); it != path.rend(); ++it) {
      ring.push_back(layout_.skeleton.nodes[layout_.skeleton.arcs[*it].lower].position);
    }
    ring.pop_back();  // the corner again
    return ring;
  }

  /// (iii) the loser's arcs in the region no longer guide slices: those stay perpendicular to the
  /// winner's edges.
  void ignore_guides_inside(const Ring& ring) {
    for (std::uint32_t k = 0; k < layout_.roles.size(); ++k) {
      if (layout_.roles[k] != ArcRole::kGuide) continue;
      const auto& arc = layout_.skeleton.arcs[k];
      const Point middle = midpoint(layout_.skeleton.nodes[arc.lower].position,
                                    layout_.skeleton.nodes[arc.upper].position);
      if (locate(std::span<const Point>(ring), middle) == Side::kInside)
        layout_.roles[k] = ArcRole::kIgnored;
    }
  }

  StripLayout& layout_;
  CornerScheme scheme_;
  std::vector<std::vector<std::uint32_t>> arcs_at_;
  std::uint32_t far_node_ = 0;
};

/// The offset contour, but where it would part a patio from a face that no street reaches.
void add_rim(StripLayout& layout, const std::vector<OffsetEdge>& rim) {
  for (const OffsetEdge& edge : rim) {
    if (layout.strip_of_edge[edge.face] == kNoStrip) continue;
    layout.is_wall_node[edge.from] = layout.is_wall_node[edge.to] = true;
    layout.rim.push_back(
        {layout.skeleton.nodes[edge.from].position, layout.skeleton.nodes[edge.to].position});
  }
  layout.walls.insert(layout.walls.end(), layout.rim.begin(), layout.rim.end());
}

}  // namespace

Segment contour_segment(const StripLayout& layout, std::uint32_t edge) {
  const Ring* ring = &layout.contour.outer;
  for (std::size_t hole = 0; edge >= ring->size(); ++hole) {
    edge -= static_cast<std::uint32_t>(ring->size());
    ring = &layout.contour.holes.at(hole);
  }
  return {(*ring)[edge], (*ring)[edge + 1 == ring->size() ? 0 : edge + 1]};
}

double front_length_m(const StripLayout& layout, const Strip& strip) {
  double sum = 0.0;
  for (const std::uint32_t e : strip.edges) sum += length(contour_segment(layout, e));
  return sum;
}

Expected<StripLayout> lay_out_strips(Polygon contour, std::vector<blocks::BlockEdge> labels,
                                     double slack_m, const StripRules& rules) {
  if (std::none_of(labels.begin(), labels.end(), [](const auto& l) { return l.is_street(); })) {
    return fail(FailureCode::kNoStreet, "no edge of the block faces a street");
  }
  auto skeleton = straight_skeleton(contour);
  if (!skeleton) return tl::unexpected<Failure>(skeleton.error());
  StripLayout layout;
  layout.contour = std::move(contour);
  layout.labels = std::move(labels);
  layout.slack_m = slack_m;
  LowerPart lower;
  if (rules.offset_m) {
    lower = cut_roof(*skeleton, *rules.offset_m, rules.min_patio_width_m);
    layout.skeleton = std::move(lower.skeleton);
  } else {
    layout.skeleton = *std::move(skeleton);
  }
  layout.is_wall_node.assign(layout.skeleton.nodes.size(), false);
  // From here on everything is on the working grid: a slice that ends on a wall must end on the
  // wall as it is noded.
  for (auto& node : layout.skeleton.nodes) node.position = snap(node.position);
  make_alpha_strips(layout);
  absorb_faces_without_street(layout);
  assign_roles(layout);
  CornerRegions(layout, rules.corners).run();
  add_rim(layout, lower.rim);
  for (std::uint32_t k = 0; k < layout.roles.size(); ++k) {
    if (layout.roles[k] != ArcRole::kWall) continue;
    const auto& arc = layout.skeleton.arcs[k];
    layout.is_wall_node[arc.lower] = layout.is_wall_node[arc.upper] = true;
    layout.walls.push_back(
        {layout.skeleton.nodes[arc.lower].position, layout.skeleton.nodes[arc.upper].position});
  }
  return layout;
}

}  // namespace plat::parcels
