#include "streets/nearest_grower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "streets/place_tree.h"
#include "streets/proximity_growth.h"

namespace plat::streets {
namespace {

/// Mean + k deviations of the distances that all streets of the sockets know, taken together;
/// unlimited where they know none.
double largest_length_m(const std::vector<Socket>& sockets, std::optional<double> deviations) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  if (!deviations) return kUnlimited;
  double count = 0.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const Socket& socket : sockets) {
    for (const PassingStreet& street : socket.streets) {
      if (!(street.distance_mean_m > 0.0)) continue;
      count += 1.0;
      sum += street.distance_mean_m;
      sum_of_squares +=
          street.distance_variance_m2 + street.distance_mean_m * street.distance_mean_m;
    }
  }
  if (count == 0.0) return kUnlimited;
  const double mean = sum / count;
  return mean + *deviations * std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean));
}

std::vector<SocketPair> near_pairs(const std::vector<Socket>& sockets, int neighbours,
                                   double largest_m) {
  std::vector<Point> places;
  for (const Socket& socket : sockets) places.push_back(socket.place);
  const PlaceTree tree(places);
  std::vector<SocketPair> pairs;
  for (std::uint32_t i = 0; i < sockets.size(); ++i) {
    for (const std::uint32_t j : tree.nearest(i, static_cast<std::size_t>(neighbours))) {
      if (distance(places[i], places[j]) > largest_m) break;
      pairs.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::ranges::sort(pairs);
  const auto [first, last] = std::ranges::unique(pairs);
  pairs.erase(first, last);
  return pairs;
}

}  // namespace

Expected<Growth> NearestGrower::grow(const GrowthSite& site, Rng& /*rng*/) const {
  auto plane = GrowthPlane::over(site);
  if (!plane) return tl::unexpected(plane.error());
  std::vector<Socket> sockets = sockets_of(site, *plane);
  const double largest_m = largest_length_m(sockets, options_.length_deviations);
  const auto pairs = near_pairs(sockets, options_.neighbours, largest_m);
  if (options_.max_connections) {
    for (Socket& socket : sockets)
      socket.free_connections =
          std::min(socket.free_connections, static_cast<std::uint32_t>(*options_.max_connections));
  }
  return grow_shortest_first(site, *plane, std::move(sockets), pairs, options_.clearance_widths);
}

}  // namespace plat::streets
