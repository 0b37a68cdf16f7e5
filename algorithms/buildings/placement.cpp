#include "buildings/placement.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace plat::buildings {
namespace {

using sequences::ElementIndex;

Point3 on_ground(Point p) { return {p.x, p.y, 0.0}; }

/// A plane across the walking direction; see cut_plane().
CutPlane plane_across(Point origin, Point along) {
  const Point across = perpendicular(along);
  return {on_ground(origin), on_ground(across), {0, 0, 1}, on_ground(along)};
}

/// Places one building; one arrangement, one use.
class Placer {
 public:
  Placer(const BuildingProblem& problem, const SkeletonPlan& plan, const PartDatabase& database,
         const sequences::ArrangementByPart& arrangement)
      : problem_(problem), plan_(plan), database_(database), arrangement_(arrangement) {}

  PlacedBuilding place() {
    for (std::size_t k = 0; k < plan_.key_points.size(); ++k) place_key_point(k);
    for (std::size_t r = 0; r < plan_.rows.size(); ++r) place_row(r);
    join_cuts();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Part& part(std::size_t placed) const {
    return database_.parts()[out_.parts[placed].part];
  }

  std::size_t add_part(std::size_t part) {
    out_.parts.push_back(
        {part, std::vector<PortTarget>(database_.parts()[part].ports.size()), std::nullopt});
    return out_.parts.size() - 1;
  }

  void place_key_point(std::size_t k) {
    const auto part = problem_.parts[arrangement_.key_points[k]];
    placed_key_.push_back(part ? std::optional(add_part(*part)) : std::nullopt);
    cut_before_.emplace_back();
    cut_after_.emplace_back();
    if (!part) return;
    // An end begins or ends its row at the node; its far side is pinned there.
    const SkeletonKeyPoint& key = plan_.key_points[k];
    if (key.kind == SkeletonKeyPoint::Kind::kLeftEnd) {
      const SkeletonRow& row = plan_.rows[*key.right_row];
      out_.parts.back().key_target = {on_ground(row.start), -1.0 * on_ground(direction(row))};
    } else if (key.kind == SkeletonKeyPoint::Kind::kRightEnd) {
      const SkeletonRow& row = plan_.rows[*key.left_row];
      out_.parts.back().key_target = {on_ground(row.end), on_ground(direction(row))};
    }
  }

  /// The arm of the part at a key point that lies in a row; 0 at a cut.
  [[nodiscard]] double arm_m(std::size_t k, PortRole role) const {
    if (!placed_key_[k]) return 0.0;
    const Part& at = part(*placed_key_[k]);
    return at.ports[*find_port(at, role)].arm_m;
  }

  [[nodiscard]] std::optional<PlacedPort> key_port(std::size_t k, PortRole role) const {
    if (!placed_key_[k]) return std::nullopt;
    return PlacedPort{*placed_key_[k], *find_port(part(*placed_key_[k]), role)};
  }

  void place_row(std::size_t r) {
    const SkeletonRow& row = plan_.rows[r];
    const Point along = direction(row);
    const double factor = rounding(row).factor;
    double at_m = arm_m(row.from, row.from_port);
    std::optional<PlacedPort> before = key_port(row.from, row.from_port);
    const auto here = [&] { return row.start + factor * at_m * along; };
    for (const ElementIndex element : arrangement_.segments[r]) {
      const std::size_t placed = add_part(*problem_.parts[element]);
      const PlacedPort left{placed, *find_port(part(placed), PortRole::kLeft)};
      meet(before, left, plane_across(here(), along), row.from);
      at_m += part(placed).shape.right_m;
      before = PlacedPort{placed, *find_port(part(placed), PortRole::kRight)};
    }
    const std::optional<PlacedPort> last = key_port(row.to, row.to_port);
    const CutPlane plane = plane_across(here(), along);
    if (last) {
      meet(before, *last, plane, row.from);
    } else {
      expects(before.has_value(), "a row between two cuts has a part");
      cut_before_[row.to] = before;
    }
  }

  /// Two ports on one plane; where there is no port before, the joint waits for the other side of
  /// the cut at `key`.
  void meet(const std::optional<PlacedPort>& before, PlacedPort after, const CutPlane& plane,
            std::size_t key) {
    if (!before) {
      cut_after_[key] = after;
      return;
    }
    target(*before) = {plane.origin, plane.outward};
    target(after) = {plane.origin, -1.0 * plane.outward};
    out_.joints.push_back({plane, *before, after});
  }

  /// At a cut, both sides meet in the plane that halves the turn.
  void join_cuts() {
    for (std::size_t k = 0; k < plan_.key_points.size(); ++k) {
      if (placed_key_[k]) continue;
      const SkeletonKeyPoint& key = plan_.key_points[k];
      const SkeletonRow& left = plan_.rows[*key.left_row];
      const Point along = normalized(direction(left) + direction(plan_.rows[*key.right_row]));
      meet(cut_before_[k], *cut_after_[k], plane_across(left.end, along), k);
    }
  }

  PortTarget& target(PlacedPort port) { return out_.parts[port.placed].targets[port.port]; }

  const BuildingProblem& problem_;
  const SkeletonPlan& plan_;
  const PartDatabase& database_;
  const sequences::ArrangementByPart& arrangement_;
  PlacedBuilding out_;
  std::vector<std::optional<std::size_t>> placed_key_;  ///< by key point; none at cuts
  std::vector<std::optional<PlacedPort>> cut_before_;   ///< by key point
  std::vector<std::optional<PlacedPort>> cut_after_;
};

/// The motion that brings one plane onto another.
Point3 moved(Point3 p, const CutPlane& from, const CutPlane& to) {
  const Point3 d = p - from.origin;
  return to.origin + dot(d, from.across) * to.across + dot(d, from.up) * to.up +
         dot(d, from.outward) * to.outward;
}

/// The plane of a port at its place.
CutPlane plane_at(const Port& port, const PortTarget& target) {
  return cut_plane({port.role, target.origin, target.outward, port.arm_m, {}});
}

/// A port, or the far side of an end: where it is and where it goes.
struct Anchor {
  CutPlane from;
  CutPlane to;
};

}  // namespace

PlacedBuilding place(const BuildingProblem& problem, const SkeletonPlan& plan,
                     const PartDatabase& database,
                     const sequences::ArrangementByPart& arrangement) {
  return Placer(problem, plan, database, arrangement).place();
}

PlacedBuilding stack(const BuildingProblem& problem, const PartDatabase& database,
                     const std::vector<ElementIndex>& floors) {
  PlacedBuilding out;
  Point3 at;
  const Point3 up{0, 0, 1};
  const auto plane = [&] { return CutPlane{at, {1, 0, 0}, {0, 1, 0}, up}; };
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const std::size_t index = *problem.parts[floors[i]];
    const Part& part = database.parts()[index];
    const std::size_t bottom = *find_port(part, PortRole::kBottom);
    const std::size_t top = *find_port(part, PortRole::kTop);
    PlacedPart placed{index, std::vector<PortTarget>(part.ports.size()), std::nullopt};
    placed.targets[bottom] = {at, -1.0 * up};
    if (i == 0) {
      out.joints.push_back({{at, {1, 0, 0}, {0, -1, 0}, -1.0 * up}, {i, bottom}, std::nullopt});
    } else {
      const std::size_t below = *find_port(database.parts()[out.parts.back().part], PortRole::kTop);
      out.joints.push_back({plane(), {i - 1, below}, PlacedPort{i, bottom}});
    }
    at.z += part.shape.right_m;
    placed.targets[top] = {at, up};
    out.parts.push_back(std::move(placed));
    if (i + 1 == floors.size()) out.joints.push_back({plane(), {i, top}, std::nullopt});
  }
  return out;
}

std::vector<Point3> fitted_vertices(const Part& part, const PlacedPart& placed) {
  std::vector<Anchor> anchors;
  for (std::size_t p = 0; p < part.ports.size(); ++p) {
    anchors.push_back({cut_plane(part.ports[p]), plane_at(part.ports[p], placed.targets[p])});
  }
  if (placed.key_target) {
    // The far side of an end looks the other way than its port.
    const PortRole role =
        part.shape.part_class == PartClass::kLeftEnd ? PortRole::kLeft : PortRole::kRight;
    const Port far_side{role, {}, -1.0 * part.ports.front().outward, 0.0, {}};
    anchors.push_back({cut_plane(far_side), plane_at(far_side, *placed.key_target)});
  }
  std::vector<Point3> out;
  out.reserve(part.mesh.vertices.size());
  std::vector<double> depth_m(anchors.size());
  for (const Point3& vertex : part.mesh.vertices) {
    for (std::size_t a = 0; a < anchors.size(); ++a)
      depth_m[a] = std::max(0.0, dot(anchors[a].from.origin - vertex, anchors[a].from.outward));
    // The weight of an anchor is the product of the depths below the others: 1 in its plane, linear
    // between two.
    Point3 sum;
    double total = 0.0;
    for (std::size_t a = 0; a < anchors.size(); ++a) {
      double weight = 1.0;
      for (std::size_t b = 0; b < anchors.size(); ++b)
        if (b != a) weight *= depth_m[b];
      sum = sum + weight * moved(vertex, anchors[a].from, anchors[a].to);
      total += weight;
    }
    out.push_back(total > 0.0 ? (1.0 / total) * sum
                              : moved(vertex, anchors.front().from, anchors.front().to));
  }
  return out;
}

}  // namespace plat::buildings
