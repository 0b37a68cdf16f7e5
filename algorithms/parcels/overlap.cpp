#include "parcels/overlap.h"

#include <map>
#include <utility>

#include "core/planar_faces.h"

namespace plat::parcels {
namespace {

std::vector<std::uint32_t> shapes_at(std::span<const Parcel> shapes, std::span<const Box> boxes,
                                     Point p) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (boxes[i].contains(p) && locate(shapes[i].shape, p) == Side::kInside) out.push_back(i);
  }
  return out;
}

}  // namespace

std::vector<Overlap> find_overlaps(std::span<const Parcel> first, std::span<const Parcel> second) {
  std::vector<Segment> segments;
  std::vector<Box> first_boxes;
  std::vector<Box> second_boxes;
  const auto add = [&](std::span<const Parcel> shapes, std::vector<Box>& boxes) {
    for (const Parcel& parcel : shapes) {
      boxes.push_back(box_of(parcel.shape));
      for_each_edge(parcel.shape, [&](const Segment& s) { segments.push_back(s); });
    }
  };
  add(first, first_boxes);
  add(second, second_boxes);
  const PlanarGraph graph = node_segments(segments);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> areas;
  for (const Face& face : find_faces(graph).faces) {
    const Polygon region = polygon_of(graph, face);
    const double area = area_m2(region);
    if (area <= 0.0) continue;
    const Point p = interior_point(region);
    const std::vector<std::uint32_t> others = shapes_at(second, second_boxes, p);
    if (others.empty()) continue;
    for (const std::uint32_t i : shapes_at(first, first_boxes, p)) {
      for (const std::uint32_t j : others) areas[{i, j}] += area;
    }
  }
  std::vector<Overlap> out;
  for (const auto& [pair, area] : areas) out.push_back({pair.first, pair.second, area});
  return out;
}

}  // namespace plat::parcels
