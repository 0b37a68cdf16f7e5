#include <fmt/format.h>

#include <algorithm>

#include "core/working_grid.h"
#include "editing/network_edit_internal.h"

namespace plat::editing::detail {
namespace {

Box box_of_points(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.add(p);
  return box;
}

double distance_to(const Polyline& line, Point p) {
  double best = distance(line.front(), p);
  for (std::size_t i = 1; i < line.size(); ++i)
    best = std::min(best, distance(Segment{line[i - 1], line[i]}, p));
  return best;
}

/// The parameter along ab at which it crosses cd; an end of cd on ab counts on one side only.
std::optional<double> crossing_parameter(const Segment& ab, const Segment& cd) {
  const bool c_left = orientation(ab.a, ab.b, cd.a) > 0.0;
  const bool d_left = orientation(ab.a, ab.b, cd.b) > 0.0;
  if (c_left == d_left) return std::nullopt;
  const double t = cross(cd.a - ab.a, cd.b - cd.a) / cross(ab.b - ab.a, cd.b - cd.a);
  if (!(t > 0.0 && t < 1.0)) return std::nullopt;
  return t;
}

}  // namespace

CityStreet NetworkEdit::with_line(CityStreet street) const {
  const Point from = place(street.from);
  const Point to = place(street.to);
  street.line = street.curve ? sampled(from, *street.curve, to) : Polyline{from, to};
  return street;
}

void NetworkEdit::touch(StreetId street) {
  if (new_.contains(street)) return;
  walks_.insert(city().walk_of(2 * street.value));
  walks_.insert(city().walk_of(2 * street.value + 1));
}

void NetworkEdit::touch(NodeId node) {
  nodes_.insert(node);
  for (const HalfEdge h : city().nodes().at(node).around) touch(street_of(h));
}

void NetworkEdit::attach(NodeId node, HalfEdge h) {
  CityNode record = city().nodes().at(node);
  record.around.push_back(h);
  change_.set(node, std::move(record));
}

void NetworkEdit::detach(NodeId node, HalfEdge h) {
  CityNode record = city().nodes().at(node);
  std::erase(record.around, h);
  change_.set(node, std::move(record));
}

void NetworkEdit::insert(NodeId id, Point position) {
  change_.set(id, CityNode{position, {}});
  nodes_.insert(id);
}

void NetworkEdit::insert(StreetId id, CityStreet street) {
  is_rewired_ = true;
  touch(street.from);
  touch(street.to);
  new_.insert(id);
  moved_.insert(id);
  attach(street.from, 2 * id.value);
  attach(street.to, 2 * id.value + 1);
  change_.set(id, with_line(std::move(street)));
}

void NetworkEdit::move_nodes(std::span<const NodeId> nodes, const Transform& transform) {
  const std::set<NodeId> moving(nodes.begin(), nodes.end());
  std::set<StreetId> streets;
  for (const NodeId node : moving) {
    CityNode record = city().nodes().at(node);
    record.position = snap(transform(record.position));
    for (const HalfEdge h : record.around) streets.insert(street_of(h));
    change_.set(node, std::move(record));
  }
  for (const StreetId id : streets) {
    touch(id);
    moved_.insert(id);
    CityStreet street = city().streets().at(id);
    nodes_.insert(street.from);
    nodes_.insert(street.to);
    if (street.curve && moving.contains(street.from))
      street.curve->first = snap(transform(street.curve->first));
    if (street.curve && moving.contains(street.to))
      street.curve->second = snap(transform(street.curve->second));
    change_.set(id, with_line(std::move(street)));
  }
}

void NetworkEdit::bend(StreetId id, const std::optional<Curve>& curve) {
  CityStreet street = city().streets().at(id);
  street.curve = curve;
  if (curve) street.curve = Curve{snap(curve->first), snap(curve->second)};
  touch(id);
  moved_.insert(id);
  nodes_.insert(street.from);
  nodes_.insert(street.to);
  change_.set(id, with_line(std::move(street)));
}

void NetworkEdit::resize(StreetId id, double width_m, streets::WidthSource source) {
  CityStreet street = city().streets().at(id);
  street.width_m = width_m;
  street.width_source = source;
  touch(id);
  resized_.insert(id);
  change_.set(id, std::move(street));
}

void NetworkEdit::remove(StreetId id) {
  is_rewired_ = true;
  const CityStreet street = city().streets().at(id);
  for (const HalfEdge h : {2 * id.value, 2 * id.value + 1}) {
    const NodeId node = (h & 1U) == 0U ? street.from : street.to;
    touch(node);
    detach(node, h);
    if (city().nodes().at(node).around.empty()) {
      change_.erase(node);
      nodes_.erase(node);
    }
  }
  moved_.erase(id);
  new_.erase(id);
  change_.erase(id);
}

NodeId NetworkEdit::split(StreetId id, Point at) {
  const Point p = snap(at);
  CityStreet first = city().streets().at(id);
  if (p == place(first.from)) return first.from;
  if (p == place(first.to)) return first.to;
  is_rewired_ = true;
  touch(first.from);
  touch(first.to);
  const NodeId node = change_.new_node();
  insert(node, p);
  CityStreet second = first;
  if (first.curve) {
    const Point from = place(first.from);
    const Point to = place(first.to);
    const auto halves =
        editing::split(from, *first.curve, to, nearest_parameter(from, *first.curve, to, p));
    first.curve = halves.first;
    second.curve = halves.second;
  }
  const StreetId child = change_.new_street();
  split_from_.emplace(child, id);
  new_.insert(child);
  moved_.insert({id, child});
  detach(first.to, 2 * id.value + 1);
  attach(first.to, 2 * child.value + 1);
  attach(node, 2 * id.value + 1);
  attach(node, 2 * child.value);
  first.to = second.from = node;
  change_.set(id, with_line(std::move(first)));
  change_.set(child, with_line(std::move(second)));
  return node;
}

NodeId NetworkEdit::node_at(Point p, double snap_m) {
  const double reach = std::max(snap_m, kClearance_m);
  std::optional<std::pair<double, NodeId>> nearest_node;
  std::optional<std::pair<double, StreetId>> nearest_street;
  for (const StreetId id : city().grid().near(Box{p, p}.expanded(reach))) {
    const CityStreet& street = city().streets().at(id);
    for (const NodeId node : {street.from, street.to}) {
      const std::pair candidate(distance(place(node), p), node);
      if (candidate.first < reach && (!nearest_node || candidate < *nearest_node))
        nearest_node = candidate;
    }
    const std::pair candidate(distance_to(street.line, p), id);
    if (candidate.first < reach && (!nearest_street || candidate < *nearest_street))
      nearest_street = candidate;
  }
  if (nearest_node) return nearest_node->second;
  if (nearest_street) {
    const Polyline& line = city().streets().at(nearest_street->second).line;
    Point foot = line.front();
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Point q = nearest_point({line[i - 1], line[i]}, p);
      if (distance(q, p) < distance(foot, p)) foot = q;
    }
    return split(nearest_street->second, foot);
  }
  const NodeId node = change_.new_node();
  insert(node, snap(p));
  return node;
}

std::vector<NodeId> NetworkEdit::route(NodeId a, NodeId b, double snap_m) {
  const Segment way{place(a), place(b)};
  const double reach = std::max(snap_m, kClearance_m);
  const Box box = box_of_points(std::vector{way.a, way.b}).expanded(reach);
  std::map<NodeId, double> stops;  // with the parameter along the way
  struct Crossing {
    double parameter;
    StreetId street;
  };
  std::vector<Crossing> crossings;
  for (const StreetId id : city().grid().near(box)) {
    const CityStreet& street = city().streets().at(id);
    bool is_met = false;
    for (const NodeId node : {street.from, street.to}) {
      if (node == a || node == b) is_met = true;
      if (node == a || node == b || distance(way, place(node)) >= reach) continue;
      stops[node] = nearest_parameter(way, place(node));
      is_met = true;
    }
    if (is_met) continue;  // a second meeting with the same street is left to the check
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      if (const auto t = crossing_parameter(way, {street.line[i - 1], street.line[i]})) {
        crossings.push_back({*t, id});
        break;
      }
    }
  }
  for (const auto& [t, street] : crossings) stops[split(street, lerp(way.a, way.b, t))] = t;
  std::vector<std::pair<double, NodeId>> ordered;
  for (const auto& [node, t] : stops) ordered.emplace_back(t, node);
  std::sort(ordered.begin(), ordered.end());
  std::vector<NodeId> out{a};
  for (const auto& [t, node] : ordered) out.push_back(node);
  out.push_back(b);
  return out;
}

Expected<void> NetworkEdit::add(const AddStreet& edit) {
  // An end must not stay on a street that the other end's snapping has split: take them in turn.
  const NodeId from = node_at(edit.from, edit.snap_m);
  const NodeId to = node_at(edit.to, edit.snap_m);
  if (from == to)
    return fail(FailureCode::kStreetCollapsed, "both ends of the new street are the same node");
  const std::vector<NodeId> stops = route(from, to, edit.snap_m);
  for (std::size_t i = 1; i < stops.size(); ++i) {
    CityStreet street;
    street.from = stops[i - 1];
    street.to = stops[i];
    street.width_m = edit.width_m;
    street.name = edit.name;
    street.street_class = edit.street_class;
    insert(change_.new_street(), std::move(street));
  }
  return {};
}

bool NetworkEdit::join_near(NodeId node, Point to, double snap_m) {
  std::vector<StreetId> own;
  for (const HalfEdge h : city().nodes().at(node).around) own.push_back(street_of(h));
  bool has_near = false;
  for (const StreetId id : city().grid().near(Box{to, to}.expanded(snap_m))) {
    if (std::find(own.begin(), own.end(), id) != own.end()) continue;
    has_near = has_near || distance_to(city().streets().at(id).line, to) < snap_m;
  }
  if (!has_near) return false;
  is_rewired_ = true;
  touch(node);
  const CityNode record = city().nodes().at(node);
  // Taken out of the way, so that the node does not find itself.
  std::vector<std::pair<StreetId, CityStreet>> streets;
  for (const HalfEdge h : record.around)
    streets.emplace_back(street_of(h), city().streets().at(street_of(h)));
  for (const auto& [id, street] : streets) remove(id);
  if (city().nodes().contains(node)) change_.erase(node);
  nodes_.erase(node);
  const NodeId joined = node_at(to, snap_m);
  for (auto& [id, street] : streets) {
    if (street.from == node) street.from = joined;
    if (street.to == node) street.to = joined;
    for (const NodeId end : {street.from, street.to}) {
      if (city().nodes().contains(end)) continue;
      // The far end of a loose street went with it.
      insert(end, end == street.from ? street.line.front() : street.line.back());
    }
    insert(id, std::move(street));
  }
  return true;
}

}  // namespace plat::editing::detail
