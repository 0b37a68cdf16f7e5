#include "streets/proximity_growth.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace plat::streets {
namespace {

int main_level(const Socket& socket) {
  return std::ranges::min(socket.streets, {}, &PassingStreet::hierarchy).hierarchy;
}

bool knows_level(const Socket& socket, int level) {
  return std::ranges::find(socket.streets, level, &PassingStreet::hierarchy) !=
         socket.streets.end();
}

/// The widest street of the level nearest to `level`, the higher order where two are as near.
double width_near_level(const Socket& socket, int level) {
  const auto rank = [&](const PassingStreet& street) {
    return std::tuple(std::abs(street.hierarchy - level), street.hierarchy, -street.width_m);
  };
  return std::ranges::min(socket.streets, {}, rank).width_m;
}

}  // namespace

std::vector<Socket> sockets_of(const GrowthSite& site, const GrowthPlane& plane) {
  std::map<std::uint32_t, Socket> by_vertex;
  const auto at = [&](std::uint32_t vertex) -> Socket& {
    Socket& socket = by_vertex[vertex];
    socket.vertex = vertex;
    socket.place = plane.vertices()[vertex];
    return socket;
  };
  for (std::uint32_t i = 0; i < site.points.size(); ++i) {
    Socket& socket = at(plane.vertex_of_point(i));
    socket.has_point = true;
    for (const PassingStreet& street : streets_of(site.points[i])) {
      socket.streets.push_back(street);
      socket.free_connections += static_cast<std::uint32_t>(std::max(street.connections, 0));
    }
  }
  for (const OpenEnd& end : site.open_ends) {
    Socket& socket = at(end.node);
    socket.streets.push_back(end.street);
    ++socket.free_connections;
  }
  std::vector<Socket> out;
  out.reserve(by_vertex.size());
  for (auto& [vertex, socket] : by_vertex) out.push_back(std::move(socket));
  std::ranges::sort(out, [](const Socket& a, const Socket& b) { return a.place < b.place; });
  return out;
}

SegmentStyle style_between(const Socket& a, const Socket& b) {
  SegmentStyle style;
  style.hierarchy = std::max(main_level(a), main_level(b));
  std::optional<int> common;
  for (const PassingStreet& street : a.streets) {
    if (knows_level(b, street.hierarchy) && (!common || street.hierarchy < *common))
      common = street.hierarchy;
  }
  if (common) style.hierarchy = *common;
  const double width_a = width_near_level(a, style.hierarchy);
  const double width_b = width_near_level(b, style.hierarchy);
  style.width_m = width_a > 0.0 && width_b > 0.0 ? 0.5 * (width_a + width_b)
                                                 : std::max({width_a, width_b, 0.0});
  return style;
}

Growth grow_shortest_first(const GrowthSite& site, GrowthPlane& plane, std::vector<Socket> sockets,
                           std::span<const SocketPair> pairs, double clearance_widths) {
  // Sorted with their lengths beside them: looked up while sorting, these took a tenth of the time.
  std::vector<std::pair<double, SocketPair>> by_length;
  by_length.reserve(pairs.size());
  for (const SocketPair& pair : pairs)
    by_length.emplace_back(squared_length(sockets[pair.b].place - sockets[pair.a].place), pair);
  std::ranges::sort(by_length);
  std::vector<GrownEdge> edges;
  for (const auto& [squared_length_m2, pair] : by_length) {
    const auto [a, b] = pair;
    Socket& from = sockets[a];
    Socket& to = sockets[b];
    if (from.free_connections == 0 || to.free_connections == 0) continue;
    if (!plane.admits(from.vertex, to.vertex)) continue;
    const SegmentStyle style = style_between(from, to);
    if (plane.passes_over(from.vertex, to.vertex, clearance_widths * style.width_m)) continue;
    plane.add(from.vertex, to.vertex);
    --from.free_connections;
    --to.free_connections;
    GrownEdge edge;
    edge.from = from.vertex;
    edge.to = to.vertex;
    edge.segment = {style.hierarchy, static_cast<std::uint32_t>(edges.size())};
    edge.width_m = style.width_m;
    edges.push_back(std::move(edge));
  }
  return assemble_growth(site, plane, edges);
}

}  // namespace plat::streets
