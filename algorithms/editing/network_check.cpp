#include <fmt/format.h>

#include <algorithm>

#include "editing/network_edit_internal.h"

namespace plat::editing::detail {
namespace {

bool cross_properly(const Segment& s, const Segment& t) {
  const auto sides = [](const Segment& line, const Segment& other) {
    return orientation(line.a, line.b, other.a) * orientation(line.a, line.b, other.b);
  };
  return sides(s, t) < 0.0 && sides(t, s) < 0.0;
}

/// Where the segments meet but for `common`, which both may have as an end; nullopt where they keep
/// apart.
std::optional<Point> meeting_of(const Segment& s, const Segment& t, std::span<const Point> common) {
  const auto is_common = [&](Point p) {
    return (p == s.a || p == s.b) && (p == t.a || p == t.b) &&
           std::find(common.begin(), common.end(), p) != common.end();
  };
  for (const Point p : {s.a, s.b}) {
    if (!is_common(p) && distance(t, p) < kClearance_m) return p;
  }
  for (const Point p : {t.a, t.b}) {
    if (!is_common(p) && distance(s, p) < kClearance_m) return p;
  }
  // Both ends in common: two straight streets between the same nodes.
  if (is_common(s.a) && is_common(s.b)) return midpoint(s.a, s.b);
  if (!cross_properly(s, t)) return std::nullopt;
  const double along = cross(t.a - s.a, t.b - t.a) / cross(s.b - s.a, t.b - t.a);
  return lerp(s.a, s.b, along);
}

bool is_far(const Segment& s, const Segment& t) {
  return std::max(s.a.x, s.b.x) + kClearance_m < std::min(t.a.x, t.b.x) ||
         std::max(t.a.x, t.b.x) + kClearance_m < std::min(s.a.x, s.b.x) ||
         std::max(s.a.y, s.b.y) + kClearance_m < std::min(t.a.y, t.b.y) ||
         std::max(t.a.y, t.b.y) + kClearance_m < std::min(s.a.y, s.b.y);
}

}  // namespace

std::optional<Point> find_meeting(const City& city, StreetId first, StreetId second) {
  const CityStreet& a = city.streets().at(first);
  const CityStreet& b = city.streets().at(second);
  std::vector<Point> common;
  for (const NodeId node : {a.from, a.to}) {
    if (node == b.from || node == b.to) common.push_back(city.nodes().at(node).position);
  }
  for (std::size_t i = 1; i < a.line.size(); ++i) {
    const Segment s{a.line[i - 1], a.line[i]};
    for (std::size_t k = 1; k < b.line.size(); ++k) {
      const Segment t{b.line[k - 1], b.line[k]};
      if (is_far(s, t)) continue;
      if (const auto place = meeting_of(s, t, common)) return place;
    }
  }
  return std::nullopt;
}

std::optional<Point> find_meeting(const CityStreet& street) {
  const Polyline& line = street.line;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Segment s{line[i - 1], line[i]};
    for (std::size_t k = i + 1; k < line.size(); ++k) {
      const std::vector<Point> common =
          k == i + 1 ? std::vector<Point>{line[i]} : std::vector<Point>{};
      if (const auto place = meeting_of(s, {line[k - 1], line[k]}, common)) return place;
    }
  }
  return std::nullopt;
}

Expected<void> NetworkEdit::check_lines() const {
  for (const StreetId id : moved_) {
    const CityStreet& street = city().streets().at(id);
    if (street.from == street.to || length_m(street.line) < kMinStreet_m)
      return fail(FailureCode::kStreetCollapsed, fmt::format("street {} would vanish", id.value));
    if (const auto place = find_meeting(street)) {
      return fail(FailureCode::kStreetsCross,
                  fmt::format("street {} would cross itself near ({:.3f}, {:.3f})", id.value,
                              place->x, place->y));
    }
    Box box;
    for (const Point p : street.line) box.add(p);
    for (const StreetId other : city().grid().near(box.expanded(2.0 * kClearance_m))) {
      if (other == id || (moved_.contains(other) && other < id)) continue;
      if (const auto place = find_meeting(city(), id, other)) {
        return fail(FailureCode::kStreetsCross,
                    fmt::format("street {} would cross or touch street {} near ({:.3f}, {:.3f})",
                                id.value, other.value, place->x, place->y));
      }
    }
  }
  return {};
}

}  // namespace plat::editing::detail
