#include "streets/relative_neighbourhood_grower.h"

#include <limits>
#include <utility>
#include <vector>

#include "streets/beta_skeleton.h"
#include "streets/proximity_growth.h"

namespace plat::streets {

Expected<Growth> RelativeNeighbourhoodGrower::grow(const GrowthSite& site, Rng& /*rng*/) const {
  auto plane = GrowthPlane::over(site);
  if (!plane) return tl::unexpected(plane.error());
  std::vector<Socket> sockets = sockets_of(site, *plane);
  std::vector<Point> places;
  for (Socket& socket : sockets) {
    places.push_back(socket.place);
    // How many streets meet at a point is the skeleton's affair.
    if (socket.has_point) socket.free_connections = std::numeric_limits<std::uint32_t>::max();
  }
  std::vector<SocketPair> pairs;
  for (const auto& [a, b] : beta_skeleton(places, options_.beta)) pairs.push_back({a, b});
  return grow_shortest_first(site, *plane, std::move(sockets), pairs);
}

}  // namespace plat::streets
