#include "editing/street_following.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plat::editing {
namespace {

/// Keeps the weight of a tile finite that a street runs through, metres.
constexpr double kLeastDistance_m = 1.0;
/// A link belongs to a street whose line passes nearer than this beyond half its width, metres:
/// centre lines of maps lie off the middle between fronts.
constexpr double kLinkSlack_m = 5.0;

double distance_m(const Polygon& shape, Point p) {
  return locate(shape, p) == Side::kOutside ? boundary_distance_m(shape, p) : 0.0;
}

double weight_of(double distance_m) {
  const double near_01 = 1.0 - distance_m / kFollowReach_m;
  const double far_m = distance_m + kLeastDistance_m;
  return near_01 * near_01 / (far_m * far_m);
}

/// Full up to half the reach, then falling to nothing.
double share_of(double nearest_m) {
  return std::clamp(2.0 * (1.0 - nearest_m / kFollowReach_m), 0.0, 1.0);
}

struct NearStreet {
  StreetId street;
  Point across;  ///< unit vector
};

/// The street that the point of a link lies on.
std::optional<NearStreet> street_at(const City& city, Point p, double link_width_m) {
  const double reach = 0.5 * link_width_m + kLinkSlack_m;
  std::optional<NearStreet> best;
  double least = std::numeric_limits<double>::infinity();
  for (const StreetId id : city.grid().near(Box{p, p}.expanded(reach))) {
    const CityStreet& street = city.streets().at(id);
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      const Segment piece{street.line[i - 1], street.line[i]};
      const double d = distance(piece, p);
      if (d >= std::min(least, 0.5 * std::max(link_width_m, street.width_m) + kLinkSlack_m))
        continue;
      least = d;
      best = NearStreet{id, normalized(perpendicular(piece.b - piece.a))};
    }
  }
  return best;
}

}  // namespace

StreetFollowing::StreetFollowing(const tiles::TileLayout& before, const tiles::TileLayout& after) {
  std::map<tiles::TileId, Affine> placements;
  for (const tiles::Tile& tile : after.tiles) placements.emplace(tile.id, tile.placement);
  for (std::uint32_t i = 0; i < before.tiles.size(); ++i) {
    const tiles::Tile& tile = before.tiles[i];
    std::optional<Affine>& motion = motions_.emplace_back();
    const auto it = placements.find(tile.id);
    if (it != placements.end()) {
      if (it->second == tile.placement) {
        motion = Affine{};
      } else if (const auto back = tile.placement.inverse()) {
        motion = it->second * *back;
      }
    }
    is_moved_.push_back(motion && *motion != Affine{});
    shapes_.push_back(tiles::shape_of(before, tile));
    if (motion && shapes_.back().outer.size() >= 3) grid_.insert({i}, box_of(shapes_.back()));
  }
}

bool StreetFollowing::reaches(Point p) const {
  return std::ranges::any_of(grid_.near(Box{p, p}.expanded(kFollowReach_m)), [&](TileIndex tile) {
    return is_moved_[tile.value] && distance_m(shapes_[tile.value], p) < kFollowReach_m;
  });
}

Point StreetFollowing::operator()(Point p) const {
  if (!reaches(p)) return p;
  Point sum{};
  double weights = 0.0;
  double nearest_m = kFollowReach_m;
  for (const TileIndex tile : grid_.near(Box{p, p}.expanded(kFollowReach_m))) {
    const double d = distance_m(shapes_[tile.value], p);
    if (d >= kFollowReach_m) continue;
    nearest_m = std::min(nearest_m, d);
    const double weight = weight_of(d);
    sum = sum + weight * ((*motions_[tile.value])(p)-p);
    weights += weight;
  }
  if (!(weights > 0.0)) return p;
  return p + share_of(nearest_m) * (sum / weights);
}

std::map<StreetId, double> width_changes(const City& city, const tiles::TileLayout& before,
                                         const StreetFollowing& following) {
  struct Sum {
    double change_m = 0.0;
    int links = 0;
  };
  std::map<StreetId, Sum> sums;
  for (const tiles::StreetLink& link : before.links) {
    const auto& motion_a = following.motion(link.a);
    const auto& motion_b = following.motion(link.b);
    if (!motion_a || !motion_b) continue;
    const tiles::Tile& a = before.tiles[link.a];
    const tiles::Tile& b = before.tiles[link.b];
    const Point end_a = a.placement(link.rest_a);
    const Point end_b = b.placement(link.rest_b);
    const auto near = street_at(city, midpoint(end_a, end_b), link.width_m);
    if (!near) continue;
    const Point between =
        centroid(tiles::shape_of(before, b)) - centroid(tiles::shape_of(before, a));
    const Point across = dot(between, near->across) < 0.0 ? -near->across : near->across;
    const Point turned = normalized(motion_a->linear(across) + motion_b->linear(across));
    Sum& sum = sums[near->street];
    sum.change_m +=
        dot((*motion_b)(end_b) - (*motion_a)(end_a), turned) - dot(end_b - end_a, across);
    ++sum.links;
  }
  std::map<StreetId, double> out;
  for (const auto& [street, sum] : sums) {
    const double change_m = sum.change_m / sum.links;
    if (std::abs(change_m) >= kWidthStep_m) out.emplace(street, change_m);
  }
  return out;
}

}  // namespace plat::editing
