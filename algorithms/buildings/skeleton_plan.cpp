#include "buildings/skeleton_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "buildings/part_kits.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

using Kind = SkeletonKeyPoint::Kind;

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

std::string place(const BuildingSkeleton& skeleton, std::uint32_t node) {
  return fmt::format("node {} at ({:.1f}, {:.1f})", node, skeleton.nodes[node].x,
                     skeleton.nodes[node].y);
}

/// An edge in the direction in which its front is on the right.
struct Walk {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::vector<std::uint32_t> edges;
  std::vector<AttributeBound> bounds;
};

Walk walk_of(const BuildingSkeleton& skeleton, std::uint32_t index) {
  const SkeletonEdge& edge = skeleton.edges[index];
  const bool is_forward = edge.front == FrontSide::kRight;
  return {is_forward ? edge.from : edge.to, is_forward ? edge.to : edge.from, {index}, edge.bounds};
}

double turn_between(Point in, Point out) { return std::atan2(cross(in, out), dot(in, out)); }

void expect_edges(const BuildingSkeleton& skeleton) {
  if (skeleton.edges.empty()) throw InputError("the skeleton has no edges");
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i) {
    const auto& [from, to, front, bounds] = skeleton.edges[i];
    for (const std::uint32_t node : {from, to}) {
      if (node >= skeleton.nodes.size()) {
        throw InputError(
            fmt::format("edge {}: node {}, there are {}", i, node, skeleton.nodes.size()));
      }
    }
    const double length = distance(skeleton.nodes[from], skeleton.nodes[to]);
    if (!(length >= kLengthQuantum_m) || !std::isfinite(length)) {
      throw InputError(fmt::format("edge {} from node {} to node {}: {} m long, at least {} needed",
                                   i, from, to, length, kLengthQuantum_m));
    }
    if (!seen.insert(std::minmax(from, to)).second)
      throw InputError(fmt::format("edge {} from node {} to node {}: is there twice", i, from, to));
  }
}

/// Whether two segments without a common end touch.
bool do_touch(const Segment& s, const Segment& t) {
  const auto side = [](double a, double b) { return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0); };
  if (side(orientation(s.a, s.b, t.a), orientation(s.a, s.b, t.b))) return false;
  if (side(orientation(t.a, t.b, s.a), orientation(t.a, t.b, s.b))) return false;
  const double apart = std::min({distance(s, t.a), distance(s, t.b), distance(t, s.a)});
  const bool is_crossing = orientation(s.a, s.b, t.a) != 0.0 || orientation(s.a, s.b, t.b) != 0.0;
  return is_crossing || apart <= 0.0;
}

void expect_no_crossings(const BuildingSkeleton& skeleton) {
  const auto segment = [&](const SkeletonEdge& edge) {
    return Segment{skeleton.nodes[edge.from], skeleton.nodes[edge.to]};
  };
  for (std::size_t i = 0; i < skeleton.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < skeleton.edges.size(); ++j) {
      const SkeletonEdge& a = skeleton.edges[i];
      const SkeletonEdge& b = skeleton.edges[j];
      if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) continue;
      if (do_touch(segment(a), segment(b))) {
        throw InputError(fmt::format("edges {} and {} cross; put a node where they meet", i, j));
      }
    }
  }
}

void expect_one_piece(const BuildingSkeleton& skeleton) {
  std::vector<std::uint32_t> root(skeleton.nodes.size());
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](std::uint32_t node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  for (const SkeletonEdge& edge : skeleton.edges) root[find(edge.from)] = find(edge.to);
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    if (find(i) != find(skeleton.edges.front().from)) {
      throw InputError(fmt::format(
          "{}: does not hang together with edge 0; give each building a design of its own",
          place(skeleton, i)));
    }
  }
}

/// Rows and key points from edges; one skeleton, one use.
class Planner {
 public:
  explicit Planner(const BuildingSkeleton& skeleton) : skeleton_(skeleton) {
    for (std::uint32_t i = 0; i < skeleton.edges.size(); ++i)
      walks_.push_back(walk_of(skeleton, i));
  }

  SkeletonPlan plan() {
    merge_straight();
    SkeletonPlan plan;
    std::vector<std::uint32_t> key_point_of(skeleton_.nodes.size());
    for (std::uint32_t node = 0; node < skeleton_.nodes.size(); ++node) {
      if (ending(node).empty() && beginning(node).empty()) continue;  // within a row
      key_point_of[node] = static_cast<std::uint32_t>(plan.key_points.size());
      plan.key_points.push_back(key_point(node));
    }
    for (Walk& walk : walks_) {
      plan.rows.push_back({key_point_of[walk.from], key_point_of[walk.to], PortRole::kRight,
                           PortRole::kLeft, at(walk.from), at(walk.to), std::move(walk.edges),
                           std::move(walk.bounds)});
    }
    for (const SkeletonKeyPoint& key : plan.key_points) set_stem_port(plan, key);
    return plan;
  }

 private:
  [[nodiscard]] Point at(std::uint32_t node) const { return skeleton_.nodes[node]; }
  [[nodiscard]] Point along(std::uint32_t walk) const {
    return normalized(at(walks_[walk].to) - at(walks_[walk].from));
  }
  [[nodiscard]] std::vector<std::uint32_t> ending(std::uint32_t node) const {
    return rows_with(node, &Walk::to);
  }
  [[nodiscard]] std::vector<std::uint32_t> beginning(std::uint32_t node) const {
    return rows_with(node, &Walk::from);
  }
  [[nodiscard]] std::vector<std::uint32_t> rows_with(std::uint32_t node,
                                                     std::uint32_t Walk::* end) const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < walks_.size(); ++i) {
      if (walks_[i].*end == node) out.push_back(i);
    }
    return out;
  }

  /// Joins two rows at each node that asks for nothing.
  void merge_straight() {
    for (std::uint32_t node = 0; node < skeleton_.nodes.size(); ++node) {
      const auto in = ending(node);
      const auto out = beginning(node);
      if (in.size() != 1 || out.size() != 1 || in == out) continue;
      Walk& first = walks_[in.front()];
      Walk& second = walks_[out.front()];
      if (!first.bounds.empty() || !second.bounds.empty() || first.from == second.to) continue;
      if (!is_straight(first, second)) continue;
      first.edges.insert(first.edges.end(), second.edges.begin(), second.edges.end());
      first.to = second.to;
      walks_.erase(walks_.begin() + out.front());
    }
    std::ranges::sort(walks_, {}, [](const Walk& walk) { return std::ranges::min(walk.edges); });
  }

  /// Whether no node of the two walks leaves the line between their ends.
  [[nodiscard]] bool is_straight(const Walk& first, const Walk& second) const {
    const Segment line{at(first.from), at(second.to)};
    if (dot(at(first.to) - line.a, line.b - at(first.to)) <= 0.0) return false;
    for (const Walk* walk : {&first, &second}) {
      for (const std::uint32_t edge : walk->edges) {
        const SkeletonEdge& e = skeleton_.edges[edge];
        if (distance(line, at(e.from)) > kStraightDeviation_m) return false;
        if (distance(line, at(e.to)) > kStraightDeviation_m) return false;
      }
    }
    return true;
  }

  [[nodiscard]] SkeletonKeyPoint key_point(std::uint32_t node) const {
    const auto in = ending(node);
    const auto out = beginning(node);
    switch (in.size() + out.size()) {
      case 1:
        return {node,
                in.empty() ? Kind::kLeftEnd : Kind::kRightEnd,
                0.0,
                StemSide::kBack,
                in.empty() ? std::nullopt : std::optional(in.front()),
                out.empty() ? std::nullopt : std::optional(out.front()),
                std::nullopt};
      case 2:
        return corner(node, in, out);
      case 3:
        return tee(node, in, out);
      default:
        throw InputError(fmt::format("{}: {} edges meet, at most 3 allowed", place(skeleton_, node),
                                     in.size() + out.size()));
    }
  }

  [[nodiscard]] SkeletonKeyPoint corner(std::uint32_t node, const std::vector<std::uint32_t>& in,
                                        const std::vector<std::uint32_t>& out) const {
    if (in.size() != 1) {
      throw InputError(
          fmt::format("{}: the front changes sides; both edges must have it on the same side for "
                      "who walks through",
                      place(skeleton_, node)));
    }
    const double turn = turn_between(along(in.front()), along(out.front()));
    if (std::abs(turn) > kMaxCornerTurn_rad) {
      throw InputError(fmt::format("{}: a turn of {:.1f} degrees, at most {:.1f} allowed",
                                   place(skeleton_, node), degrees(turn),
                                   degrees(kMaxCornerTurn_rad)));
    }
    const Kind kind = std::abs(turn) < kMinCornerTurn_rad ? Kind::kCut : Kind::kCorner;
    return {node, kind, turn, StemSide::kBack, in.front(), out.front(), std::nullopt};
  }

  /// The bar of the T is the pair of rows that go on straight.
  [[nodiscard]] SkeletonKeyPoint tee(std::uint32_t node, const std::vector<std::uint32_t>& in,
                                     const std::vector<std::uint32_t>& out) const {
    for (const std::uint32_t left : in) {
      for (const std::uint32_t right : out) {
        const Point bar = along(left);
        if (std::abs(turn_between(bar, along(right))) > kAngleTolerance_rad) continue;
        std::optional<std::uint32_t> stem;
        Point outward;
        for (const std::uint32_t row : in)
          if (row != left) stem = row, outward = -along(row);
        for (const std::uint32_t row : out)
          if (row != right) stem = row, outward = along(row);
        const Point across = normalized(bar + along(right));
        const double angle = turn_between(across, outward);
        if (std::abs(std::abs(angle) - std::numbers::pi / 2) > kAngleTolerance_rad) {
          throw InputError(fmt::format(
              "{}: the stem stands at {:.1f} degrees, 90 +- {:.1f} allowed", place(skeleton_, node),
              degrees(std::abs(angle)), degrees(kAngleTolerance_rad)));
        }
        return {node, Kind::kTee, 0.0, angle > 0.0 ? StemSide::kBack : StemSide::kFront,
                left, right,      stem};
      }
    }
    throw InputError(
        fmt::format("{}: three edges meet, but no two of them go on straight (within {:.1f} "
                    "degrees) with their fronts on one side",
                    place(skeleton_, node), degrees(kAngleTolerance_rad)));
  }

  static void set_stem_port(SkeletonPlan& plan, const SkeletonKeyPoint& key) {
    if (!key.stem_row) return;
    SkeletonRow& row = plan.rows[*key.stem_row];
    const bool is_beginning = plan.key_points[row.from].node == key.node;
    (is_beginning ? row.from_port : row.to_port) = PortRole::kStem;
  }

  const BuildingSkeleton& skeleton_;
  std::vector<Walk> walks_;
};

}  // namespace

double length_m(const SkeletonRow& row) { return distance(row.start, row.end); }

Point direction(const SkeletonRow& row) { return normalized(row.end - row.start); }

SkeletonPlan plan_of(const BuildingSkeleton& skeleton) {
  expect_edges(skeleton);
  expect_one_piece(skeleton);
  expect_no_crossings(skeleton);
  return Planner(skeleton).plan();
}

}  // namespace plat::buildings
