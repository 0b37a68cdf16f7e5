#include "parcels/strip_lots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/working_grid.h"

namespace plat::parcels {
namespace {

/// Cells below this are leftovers of rounding, not lots.
constexpr double kSliver_m2 = 0.5;
/// A vertex that turns by less is no corner of a lot.
constexpr double kCornerTurn_rad = 0.175;  // 10 degrees
/// Rows lie back to back where they share at least this much; less is a corner in which they meet.
constexpr double kSharedBack_m = 1.0;
/// A ray has left its own front, whose point was rounded, after this much.
constexpr double kClearance_m = 4.0 * kGridStep_m;
/// Halving a lot this often leaves nothing of any front.
constexpr int kMaxSplits = 12;

int corner_count(const Ring& ring) {
  int corners = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point in = ring[i] - ring[(i + ring.size() - 1) % ring.size()];
    const Point out = ring[(i + 1) % ring.size()] - ring[i];
    if (std::abs(std::atan2(cross(in, out), dot(in, out))) > kCornerTurn_rad) ++corners;
  }
  return corners;
}

bool is_triangular(const Polygon& polygon) {
  return polygon.holes.empty() && corner_count(polygon.outer) == 3;
}

std::vector<Segment> street_edges(const blocks::Block& block) {
  std::vector<Segment> out;
  for (std::size_t r = 0; r < block.edges.size(); ++r) {
    const Ring& ring = blocks::ring_at(block, r);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (block.edges[r][i].is_street()) out.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  return out;
}

/// Whether no vertex of the lot is `depth_m` or more from the streets.
bool is_shallow(const Polygon& lot, const std::vector<Segment>& streets, double depth_m) {
  return std::all_of(lot.outer.begin(), lot.outer.end(), [&](Point p) {
    return std::any_of(streets.begin(), streets.end(),
                       [&](const Segment& s) { return distance(s, p) < depth_m; });
  });
}

/// The point `s` metres along the line, with the direction of the line there.
std::pair<Point, Point> point_along(const std::vector<Point>& line, double s) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = distance(line[i - 1], line[i]);
    const Point direction = normalized(line[i] - line[i - 1]);
    if (s <= step || i + 1 == line.size())
      return {line[i - 1] + std::min(s, step) * direction, direction};
    s -= step;
  }
  return {line.front(), {}};
}

/// From a point on the lot's boundary straight across to where the ray leaves the lot first.
std::optional<Segment> cut_across(const Polygon& lot, Point from, Point inward) {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_edge(lot, [&](const Segment& s) {
    const Point e = s.b - s.a;
    const double denominator = cross(inward, e);
    if (denominator == 0.0) return;
    const double t = cross(s.a - from, e) / denominator;
    const double u = cross(s.a - from, inward) / denominator;
    if (t > kClearance_m && u >= 0.0 && u <= 1.0) nearest = std::min(nearest, t);
  });
  if (!std::isfinite(nearest)) return std::nullopt;
  return Segment{snap(from), snap(from + nearest * inward)};
}

using Frontage = BlockPartition::Frontage;

const Frontage& longest(const std::vector<Frontage>& fronts) {
  return *std::max_element(fronts.begin(), fronts.end(), [](const Frontage& a, const Frontage& b) {
    return length_m(a.line) < length_m(b.line);
  });
}

/// Of the streets that a joined row fronts, the one whose lots stay.
std::uint32_t leading_street(const std::vector<Frontage>& fronts, CornerScheme scheme) {
  std::map<std::uint32_t, std::pair<double, double>> importance;  // street -> (width, length)
  for (const Frontage& front : fronts) {
    auto& [width, length] = importance[front.logical_street];
    // Widths are compared to the centimetre, as at corners (strips.cpp).
    if (scheme == CornerScheme::kStreetWidth)
      width = std::max(width, std::round(front.street_width_m * 100.0));
    length += length_m(front.line);
  }
  return std::max_element(importance.begin(), importance.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

StripLots::StripLots(const blocks::Block& block, BlockPartition partition,
                     std::vector<Polygon> patios)
    : block_(&block), partition_(std::move(partition)), patios_(std::move(patios)) {
  is_patio_.assign(partition_.cell_count(), false);
  for (std::uint32_t cell = 0; !patios_.empty() && cell < partition_.cell_count(); ++cell) {
    const Point inside = interior_point(partition_.cell_polygon(cell));
    is_patio_[cell] = std::any_of(patios_.begin(), patios_.end(), [&](const Polygon& patio) {
      return locate(patio, inside) == Side::kInside;
    });
  }
}

Expected<StripLots> StripLots::cut(const blocks::Block& block, std::span<const Segment> cuts,
                                   std::vector<Polygon> patios) {
  auto partition = BlockPartition::cut(block, cuts);
  if (!partition) return tl::unexpected<Failure>(partition.error());
  partition->join_slivers(kSliver_m2);
  return StripLots(block, *std::move(partition), std::move(patios));
}

Expected<void> StripLots::cut_again(const std::vector<Segment>& more) {
  std::vector<Segment> cuts = partition_.inner_edges();
  cuts.insert(cuts.end(), more.begin(), more.end());
  auto next = cut(*block_, cuts, std::move(patios_));
  if (!next) return tl::unexpected<Failure>(next.error());
  *this = *std::move(next);
  return {};
}

/// Lots by the row they are joined to: those that lie back to back, too shallow, between the same
/// two streets.
std::vector<std::vector<std::uint32_t>> StripLots::shallow_rows(const LotRules& rules) const {
  struct Shallow {
    std::uint32_t street = 0;
    std::vector<BlockPartition::Border> borders;
    double back_m = 0.0;  ///< the longest border with a lot of another street
    std::pair<std::uint32_t, std::uint32_t> streets;
    std::uint32_t row = 0;
  };
  std::map<std::uint32_t, Shallow> lots;
  const std::vector<Segment> streets = street_edges(*block_);
  for (const std::uint32_t region : partition_.regions()) {
    if (is_patio_[region] || partition_.frontage_m(region) < kStreetAccess_m) continue;
    if (!is_shallow(partition_.polygon(region), streets, rules.shallow_m)) continue;
    lots[region] = {longest(partition_.fronts(region)).logical_street,
                    partition_.borders(region),
                    0.0,
                    {},
                    region};
  }
  for (auto& [region, lot] : lots) {
    for (const auto& border : lot.borders) {
      const auto other = lots.find(border.neighbour);
      if (other == lots.end() || other->second.street == lot.street) continue;
      if (border.length_m < kSharedBack_m || border.length_m <= lot.back_m) continue;
      lot.back_m = border.length_m;
      lot.streets = std::minmax({lot.street, other->second.street});
    }
  }
  // Neighbours between the same two streets are one row.
  const auto find = [&](std::uint32_t r) {
    while (lots.at(r).row != r) r = lots.at(r).row;
    return r;
  };
  std::map<std::uint32_t, std::vector<std::uint32_t>> rows;
  for (auto& [region, lot] : lots) {
    for (const auto& border : lot.borders) {
      const auto other = lots.find(border.neighbour);
      const bool is_same_row = other != lots.end() && lot.back_m > 0.0 &&
                               other->second.back_m > 0.0 && other->second.streets == lot.streets;
      if (!is_same_row) continue;
      const auto [low, high] = std::minmax({find(region), find(border.neighbour)});
      lots.at(high).row = low;
    }
  }
  for (const auto& [region, lot] : lots) {
    if (lot.back_m > 0.0) rows[find(region)].push_back(region);
  }
  std::vector<std::vector<std::uint32_t>> out;
  for (auto& [first, row] : rows) {
    if (row.size() > 1) out.push_back(std::move(row));
  }
  return out;
}

void StripLots::slice_row(std::uint32_t row, const LotRules& rules, Rng& rng,
                          std::vector<Segment>& cuts) const {
  const Polygon land = partition_.polygon(row);
  const std::vector<Frontage> fronts = partition_.fronts(row);
  const std::uint32_t street = leading_street(fronts, rules.corners);
  for (const Frontage& front : fronts) {
    if (front.logical_street != street) continue;
    for (const double s : slice_positions(0.0, length_m(front.line), false, rules.spacing, rng)) {
      const auto [from, direction] = point_along(front.line, s);
      if (const auto cut = cut_across(land, from, perpendicular(direction))) cuts.push_back(*cut);
    }
  }
}

Expected<void> StripLots::group_shallow(const LotRules& rules, Rng& rng) {
  if (rules.shallow_m <= 0.0) return {};
  const std::vector<std::vector<std::uint32_t>> rows = shallow_rows(rules);
  if (rows.empty()) return {};
  std::vector<Segment> slices;
  for (const auto& row : rows) {
    for (std::size_t i = 1; i < row.size(); ++i) partition_.join(row.front(), row[i]);
    slice_row(row.front(), rules, rng, slices);
  }
  return cut_again(slices);
}

Expected<void> StripLots::split_large(const LotRules& rules) {
  for (int round = 0; round < kMaxSplits; ++round) {
    std::vector<Segment> cuts;
    for (const std::uint32_t region : partition_.regions()) {
      if (is_patio_[region] || partition_.area_m2(region) <= rules.area_max_m2) continue;
      const std::vector<Frontage> fronts = partition_.fronts(region);
      if (fronts.empty()) continue;
      const Frontage& front = longest(fronts);
      const double half_m = 0.5 * length_m(front.line);
      if (half_m < 0.5 * rules.spacing.mean_m) continue;
      const auto [from, direction] = point_along(front.line, half_m);
      const auto cut = cut_across(partition_.polygon(region), from, perpendicular(direction));
      if (cut) cuts.push_back(*cut);
    }
    if (cuts.empty()) return {};
    if (auto done = cut_again(cuts); !done) return done;
  }
  return {};
}

/// Who gets a lot that may not stay: the neighbour with the longest common boundary, a lot before a
/// patio.
std::optional<std::uint32_t> StripLots::heir(std::uint32_t region) const {
  std::optional<std::uint32_t> out;
  std::tuple<bool, double> best{false, 0.0};
  for (const auto& border : partition_.borders(region)) {
    const std::tuple<bool, double> rank{is_patio_[border.neighbour] == is_patio_[region],
                                        border.length_m};
    if (out && rank <= best) continue;
    best = rank;
    out = border.neighbour;
  }
  return out;
}

void StripLots::merge_small(const LotRules& rules) {
  partition_.join_while(
      [&](std::uint32_t region) {
        if (is_patio_[region]) return false;
        const double area = partition_.area_m2(region);
        return partition_.frontage_m(region) < kStreetAccess_m || area < rules.area_min_m2 ||
               (area < rules.triangle_max_m2 && is_triangular(partition_.polygon(region)));
      },
      [&](std::uint32_t region) { return heir(region); });
}

}  // namespace plat::parcels
