#include <fmt/format.h>

#include <algorithm>

#include "editing/network_edit_internal.h"

namespace plat::editing::detail {
namespace {

bool is_upper(Point d) { return d.y > 0.0 || (d.y == 0.0 && d.x > 0.0); }

/// Counter-clockwise from east; exact on the working grid.
bool is_before(Point d, Point e) {
  if (is_upper(d) != is_upper(e)) return is_upper(d);
  return cross(d, e) > 0.0;
}

/// The direction in which a half-edge leaves its origin.
Point direction_of(const City& city, HalfEdge h) {
  const Polyline& line = city.streets().at(street_of(h)).line;
  return (h & 1U) == 0U ? line[1] - line[0] : line[line.size() - 2] - line.back();
}

bool are_cyclically_equal(std::vector<HalfEdge> a, const std::vector<HalfEdge>& b) {
  if (a.size() != b.size()) return false;
  if (a.empty()) return true;
  const auto start = std::find(a.begin(), a.end(), b.front());
  if (start == a.end()) return false;
  std::rotate(a.begin(), start, a.end());
  return a == b;
}

/// Calls visit(point) for the points of a walk, each street's last one left out.
template <class Visit>
void for_each_point(const City& city, const Walk& walk, Visit visit) {
  for (const HalfEdge h : walk.half_edges) {
    const Polyline& line = city.streets().at(street_of(h)).line;
    if ((h & 1U) == 0U) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i) visit(line[i]);
    } else {
      for (std::size_t i = line.size(); i-- > 1;) visit(line[i]);
    }
  }
}

}  // namespace

Ring ring_of(const City& city, const Walk& walk) {
  Ring ring;
  for_each_point(city, walk, [&](Point p) { ring.push_back(p); });
  return ring;
}

Point leftmost_point(const City& city, const Walk& walk) {
  std::optional<Point> best;
  for_each_point(city, walk, [&](Point p) {
    if (!best || p < *best) best = p;
  });
  return *best;
}

Expected<void> NetworkEdit::sort_around() {
  for (const NodeId id : nodes_) {
    CityNode node = city().nodes().at(id);
    const std::vector<HalfEdge> before = node.around;
    std::sort(node.around.begin(), node.around.end(), [&](HalfEdge g, HalfEdge h) {
      return is_before(direction_of(city(), g), direction_of(city(), h));
    });
    if (!is_rewired_ && !are_cyclically_equal(before, node.around)) {
      return fail(FailureCode::kFaceInverted,
                  fmt::format("at node {} a street would jump over another", id.value));
    }
    if (node.around != before) change_.set(id, std::move(node));
  }
  return {};
}

void NetworkEdit::measure(Walk& walk) const {
  const Ring ring = ring_of(city(), walk);
  walk.area_m2 = signed_area_m2(ring);
  walk.box = {};
  for (const Point p : ring) walk.box.add(p);
}

std::vector<HalfEdge> NetworkEdit::walk_from(HalfEdge start) const {
  std::vector<HalfEdge> out;
  HalfEdge h = start;
  do {
    out.push_back(h);
    // Arriving at a node, leave by the next street clockwise.
    const std::vector<HalfEdge>& around = city().nodes().at(city().origin_of(twin(h))).around;
    const auto it = std::find(around.begin(), around.end(), twin(h));
    h = it == around.begin() ? around.back() : *(it - 1);
  } while (h != start);
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

void NetworkEdit::retrace() {
  std::set<HalfEdge> open;
  std::map<std::vector<HalfEdge>, WalkId> known;
  for (const WalkId id : walks_) {
    const Walk& walk = city().walks().at(id);
    known.emplace(walk.half_edges, id);
    for (const HalfEdge h : walk.half_edges) {
      if (city().streets().contains(street_of(h))) open.insert(h);
    }
  }
  for (const StreetId street : new_) open.insert({2 * street.value, 2 * street.value + 1});
  std::set<WalkId> after;
  std::map<StreetId, StreetSides> sides;
  while (!open.empty()) {
    Walk walk;
    walk.half_edges = walk_from(*open.begin());
    for (const HalfEdge h : walk.half_edges) open.erase(h);
    const auto it = known.find(walk.half_edges);
    const WalkId id = it == known.end() ? change_.new_walk() : it->second;
    after.insert(id);
    for (const HalfEdge h : walk.half_edges) {
      const StreetId street = street_of(h);
      if (it != known.end() && !new_.contains(street)) continue;
      auto place = sides.find(street);
      if (place == sides.end()) {
        const bool is_new = new_.contains(street);
        place = sides
                    .emplace(street, is_new ? StreetSides{}
                                            : StreetSides{city().walk_of(2 * street.value),
                                                          city().walk_of(2 * street.value + 1)})
                    .first;
      }
      ((h & 1U) == 0U ? place->second.left : place->second.right) = id;
    }
    if (it == known.end()) change_.set(id, std::move(walk));
  }
  for (const auto& [street, both] : sides) change_.set(street, both);
  for (const WalkId id : walks_) {
    if (after.contains(id)) continue;
    const Walk& gone = city().walks().at(id);
    orphans_.insert(gone.blocks.begin(), gone.blocks.end());
    islands_.insert(gone.islands.begin(), gone.islands.end());
    if (gone.container && city().walks().contains(*gone.container)) {
      Walk holder = city().walks().at(*gone.container);
      std::erase(holder.islands, id);
      nested_.insert(*gone.container);
      change_.set(*gone.container, std::move(holder));
    }
    change_.erase(id);
  }
  walks_ = std::move(after);
  std::erase_if(islands_, [&](WalkId id) { return !city().walks().contains(id); });
  std::erase_if(nested_, [&](WalkId id) { return !city().walks().contains(id); });
}

Expected<void> NetworkEdit::update_walks() {
  if (is_rewired_) retrace();
  for (const WalkId id : walks_) {
    const Walk& before = city().walks().at(id);
    Walk walk = before;
    measure(walk);
    const bool is_same = walk.area_m2 == before.area_m2 && walk.box.min == before.box.min &&
                         walk.box.max == before.box.max;
    if (is_same) continue;
    if (!is_rewired_ && walk.is_face() != before.is_face()) {
      return fail(FailureCode::kFaceInverted,
                  fmt::format("the face along street {} would be turned inside out",
                              street_of(walk.half_edges.front()).value));
    }
    change_.set(id, std::move(walk));
  }
  return {};
}

std::optional<WalkId> NetworkEdit::container_of(const Walk& component) const {
  const Point p = leftmost_point(city(), component);
  std::optional<std::pair<double, WalkId>> best;
  city().walks().for_each([&](WalkId id, const Walk& face) {
    if (!face.is_face() || !face.box.contains(p) || (best && best->first <= face.area_m2)) return;
    if (locate(ring_of(city(), face), p) == Side::kInside) best = {face.area_m2, id};
  });
  if (!best) return std::nullopt;
  return best->second;
}

Expected<void> NetworkEdit::update_nesting() {
  // Components that changed, lie in a face that changed, or may have come to lie in one.
  Box changed;
  for (const WalkId id : walks_) {
    const Walk& walk = city().walks().at(id);
    if (!walk.is_face()) {
      islands_.insert(id);
      if (walk.container) nested_.insert(*walk.container);
      continue;
    }
    islands_.insert(walk.islands.begin(), walk.islands.end());
    changed.add(walk.box);
  }
  city().walks().for_each([&](WalkId id, const Walk& walk) {
    if (!walk.is_face() && !islands_.contains(id) && changed.intersects(walk.box))
      islands_.insert(id);
  });
  for (const WalkId id : islands_) {
    const Walk& component = city().walks().at(id);
    const std::optional<WalkId> container = container_of(component);
    if (container == component.container) continue;
    if (!is_rewired_) {
      return fail(FailureCode::kFaceInverted,
                  fmt::format("the part around street {} would jump into another face",
                              street_of(component.half_edges.front()).value));
    }
    const std::optional<WalkId> old = component.container;
    Walk moved = component;
    moved.container = container;
    change_.set(id, std::move(moved));
    if (old && city().walks().contains(*old)) {
      Walk left = city().walks().at(*old);
      std::erase(left.islands, id);
      change_.set(*old, std::move(left));
      nested_.insert(*old);
    }
    if (container) {
      Walk holder = city().walks().at(*container);
      holder.islands.push_back(id);
      std::sort(holder.islands.begin(), holder.islands.end());
      change_.set(*container, std::move(holder));
      nested_.insert(*container);
    }
  }
  return {};
}

Expected<NetworkOutcome> NetworkEdit::settle(Check check) {
  if (check == Check::kAll) {
    if (auto checked = check_lines(); !checked) return tl::unexpected<Failure>(checked.error());
  }
  if (auto sorted = sort_around(); !sorted) return tl::unexpected<Failure>(sorted.error());
  if (auto walked = update_walks(); !walked) return tl::unexpected<Failure>(walked.error());
  if (auto nested = update_nesting(); !nested) return tl::unexpected<Failure>(nested.error());
  NetworkOutcome out;
  std::set<WalkId> faces = nested_;
  faces.insert(walks_.begin(), walks_.end());
  for (const WalkId id : faces) {
    if (city().walks().at(id).is_face()) out.faces.push_back(id);
  }
  // By their lowest half-edge: ids of walks are not kept in files, and must not show in new ids.
  std::sort(out.faces.begin(), out.faces.end(), [&](WalkId a, WalkId b) {
    return city().walks().at(a).half_edges.front() < city().walks().at(b).half_edges.front();
  });
  out.orphans.assign(orphans_.begin(), orphans_.end());
  out.split_from = std::move(split_from_);
  return out;
}

}  // namespace plat::editing::detail
