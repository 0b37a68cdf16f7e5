#include "streets/network_faces.h"

#include "core/oriented_box.h"
#include "core/planar_faces.h"

namespace plat::streets {

std::vector<FaceShape> measure_faces(const StreetNetwork& network) {
  std::vector<Segment> segments;
  for (const Street& street : network.streets) {
    if (street.attributes.structure == Structure::kTunnel) continue;
    for (std::size_t i = 1; i < street.line.size(); ++i)
      segments.push_back({street.line[i - 1], street.line[i]});
  }
  const PlanarGraph graph = node_segments(segments);
  std::vector<FaceShape> out;
  for (const Face& face : find_faces(graph).faces) {
    const Polygon region = polygon_of(graph, face);
    const OrientedBox box = minimum_area_box(region);
    const double area = area_m2(region);
    out.push_back({area, perimeter_m(region), box.aspect_ratio(), area / box.area_m2()});
  }
  return out;
}

}  // namespace plat::streets
