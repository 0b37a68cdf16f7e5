#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/face_blocks.h"
#include "buildings/building_design.h"
#include "buildings/part_kits.h"
#include "core/failure.h"
#include "core/validity.h"

namespace plat::buildings {
namespace {

/// The contour moved inwards, as the blocks of a network whose only street runs round it.
Ring inset(const Ring& contour, double offset_m) {
  streets::StreetNetwork network;
  network.streets.emplace_back().width_m = 2.0 * offset_m;
  blocks::FaceBoundary boundary;
  for (std::size_t i = 0; i < contour.size(); ++i)
    boundary.outer.push_back({{contour[i], contour[(i + 1) % contour.size()]}, offset_m, 0});
  const blocks::FaceBlocks inner = blocks::blocks_of_face(boundary, network);
  if (inner.blocks.size() != 1 || !inner.blocks.front().contour.holes.empty()) {
    throw InputError(
        fmt::format("contour: moved inwards by {} m it {}; a smaller offset_m is needed", offset_m,
                    inner.blocks.empty() ? "has no area left" : "falls apart"));
  }
  return inner.blocks.front().contour.outer;
}

Point corner_before(const Ring& ring, std::size_t i) {
  return ring[(i + ring.size() - 1) % ring.size()];
}
Point corner_after(const Ring& ring, std::size_t i) { return ring[(i + 1) % ring.size()]; }

/// Takes away the corner that matters least to the area, of those that are hardly a turn and those
/// at a side that is too short. @returns false where there is none
bool drop_corner(Ring& ring, double min_edge_m) {
  std::optional<std::size_t> least;
  double least_area = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point before = corner_before(ring, i);
    const Point after = corner_after(ring, i);
    const bool is_short =
        std::min(distance(before, ring[i]), distance(ring[i], after)) < min_edge_m;
    if (!is_short && std::abs(turn_rad(ring, i)) >= kMinCornerTurn_rad) continue;
    const double area = std::abs(orientation(before, ring[i], after));
    if (least && area >= least_area) continue;
    least = i;
    least_area = area;
  }
  if (!least) return false;
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(*least));
  return true;
}

}  // namespace

BuildingSkeleton skeleton_of(const ContourDesign& design) {
  const Expected<Polygon> admitted = admit_polygon({design.contour, {}}, 10000);
  if (!admitted) throw InputError("contour: " + admitted.error().message);
  Ring ring = inset(admitted->outer, design.offset_m);
  while (ring.size() > 3 && drop_corner(ring, design.min_edge_m)) {
  }
  BuildingSkeleton skeleton{ring, {}, design.bounds};
  // Counter-clockwise, so that the street is on the right.
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % ring.size());
    skeleton.edges.push_back({i, next, FrontSide::kRight, {}});
  }
  return skeleton;
}

}  // namespace plat::buildings
