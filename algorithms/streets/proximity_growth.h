#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "streets/growth_plane.h"
#include "streets/street_grower.h"

namespace plat::streets {

/// Where a grower that looks at distances only may connect: a vertex of the plane at which there
/// are points, open ends of the existing network, or both.
struct Socket {
  std::uint32_t vertex = 0;
  Point place;
  bool has_point = false;
  std::uint32_t free_connections = 0;  ///< of its points' streets, and one per open end
  std::vector<PassingStreet> streets;  ///< of its points and open ends
};

/// Sorted by place, so that nothing depends on the order of the site's points.
std::vector<Socket> sockets_of(const GrowthSite& site, const GrowthPlane& plane);

/// Two sockets, a < b, that a grower wants to connect.
struct SocketPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;

  friend auto operator<=>(const SocketPair&, const SocketPair&) = default;
};

/// Level and width of a street between two sockets. The level is the highest order (lowest number)
/// that both know; where they have none in common, that of the socket whose main street is the
/// deeper. The width is the mean of what both know of a street of that level, or of the nearest
/// level; who does not know a width is not asked.
struct SegmentStyle {
  int hierarchy = 0;
  double width_m = 0.0;
};
SegmentStyle style_between(const Socket& a, const Socket& b);

/// Connects pairs by straight segments, the shortest first, of equally long ones that of the lower
/// numbers: each where both sockets have a connection left, the plane admits it, and it passes no
/// vertex nearer than `clearance_widths` of its width. Every segment is a street of its own.
Growth grow_shortest_first(const GrowthSite& site, GrowthPlane& plane, std::vector<Socket> sockets,
                           std::span<const SocketPair> pairs, double clearance_widths = 0.0);

}  // namespace plat::streets
