#include "harness/tile_shapes.h"

#include <algorithm>
#include <utility>

namespace plat::harness {
namespace {

/// A front that faces so much of an edge makes it a street edge.
constexpr double kStreetShare_01 = 0.5;

/// The edge that a part of the boundary lies on.
std::size_t edge_under(const Ring& ring, const Segment& front) {
  std::size_t best = 0;
  double least = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Segment edge{ring[i], ring[(i + 1) % ring.size()]};
    const double off = std::max(distance(edge, front.a), distance(edge, front.b));
    if (i == 0 || off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<similarity::EdgeLabel> edge_labels(const Ring& ring, std::span<const Segment> fronts) {
  std::vector<double> front_m(ring.size(), 0.0);
  for (const Segment& front : fronts) front_m[edge_under(ring, front)] += length(front);
  std::vector<similarity::EdgeLabel> labels;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double edge_m = distance(ring[i], ring[(i + 1) % ring.size()]);
    labels.push_back(front_m[i] >= kStreetShare_01 * edge_m ? similarity::EdgeLabel::kStreet
                                                            : similarity::EdgeLabel::kProperty);
  }
  return labels;
}

ReadTileShapes read_tile_shapes(const ParcelShapeSources& sources, Jobs jobs) {
  ReadFrontedParcels read = read_fronted_parcels(sources, jobs);
  ReadTileShapes out;
  out.frame = read.frame;
  out.failures = std::move(read.failures);
  out.shapes =
      parallel_map<similarity::LabelledShape>(read.parcels.size(), jobs, [&](std::size_t i) {
        const FrontedParcel& parcel = read.parcels[i];
        similarity::LabelledShape shape{parcel.polygon, {}, parcel.zone};
        if (parcel.block) shape.edges = edge_labels(parcel.polygon.outer, parcel.fronts);
        return shape;
      });
  for (FrontedParcel& parcel : read.parcels) {
    out.ids.push_back(std::move(parcel.id));
    out.blocks.push_back(parcel.block);
    if (!parcel.block) ++out.without_streets;
  }
  return out;
}

}  // namespace plat::harness
