#include "blocks/face_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "blocks/admission_internal.h"
#include "blocks/contour_offset_internal.h"
#include "blocks/edge_labels.h"
#include "blocks/geos_internal.h"
#include "core/planar_faces.h"
#include "core/validity.h"
#include "streets/segment_index.h"

namespace plat::blocks {
namespace {

using streets::StreetNetwork;

class FaceInset {
 public:
  FaceInset(const FaceBoundary& face, const StreetNetwork& network, const FaceOptions& options)
      : face_(face), network_(network), options_(options) {}

  [[nodiscard]] detail::Admitted contours() const {
    if (auto contour = simple_contour()) {
      detail::Admitted out;
      out.polygons.push_back(*std::move(contour));
      return out;
    }
    if (options_.dead_ends == DeadEndCut::kDeadEnds && face_.islands.empty()) {
      detail::Admitted found = cut_dead_ends();
      if (!found.polygons.empty()) return found;
    }
    return cut_contours();
  }

  /// The contour's edges with the streets that they were offset from.
  [[nodiscard]] Block labelled(Polygon contour) const {
    std::vector<StreetSide> sides = face_.outer;
    for (const auto& island : face_.islands)
      sides.insert(sides.end(), island.begin(), island.end());
    std::vector<Segment> segments;
    double widest_m = 0.0;
    for (const StreetSide& side : sides) {
      segments.push_back(side.segment);
      widest_m = std::max(widest_m, side.half_width_m);
    }
    const streets::SegmentIndex index(std::move(segments));
    Block block;
    block.contour = std::move(contour);
    for (std::size_t r = 0; r <= block.contour.holes.size(); ++r) {
      const Ring& ring = ring_at(block, r);
      std::vector<BlockEdge> labels;
      for (std::size_t i = 0; i < ring.size(); ++i)
        labels.push_back(label({ring[i], ring[(i + 1) % ring.size()]}, sides, index, widest_m));
      block.edges.push_back(std::move(labels));
    }
    number_logical_streets(block, network_);
    return block;
  }

 private:
  /// The offset line of sides that visit no place twice; nullopt where one of them vanishes.
  [[nodiscard]] static std::optional<Ring> simple_inset(std::span<const StreetSide> sides) {
    std::vector<Point> visited;
    for (const StreetSide& side : sides) visited.push_back(side.segment.a);
    std::sort(visited.begin(), visited.end());
    if (std::adjacent_find(visited.begin(), visited.end()) != visited.end()) return std::nullopt;
    Ring inset = detail::inset_ring(sides);
    if (inset.empty() || signed_area_m2(inset) <= 0.0) return std::nullopt;
    return inset;
  }

  /// nullopt where the face has dead ends, islands or narrow places.
  [[nodiscard]] std::optional<Polygon> simple_contour() const {
    if (!face_.islands.empty()) return std::nullopt;
    const auto inset = simple_inset(face_.outer);
    if (!inset) return std::nullopt;
    auto contour = admit_polygon({*inset, {}}, options_.max_vertices);
    if (!contour || area_m2(*contour) < options_.min_area_m2) return std::nullopt;
    return *std::move(contour);
  }

  /// Whether each side of the outer walk is walked the other way, too: a dead end.
  [[nodiscard]] std::vector<bool> dead_ends() const {
    std::vector<std::pair<Point, Point>> walked;
    for (const StreetSide& side : face_.outer) walked.emplace_back(side.segment.a, side.segment.b);
    std::sort(walked.begin(), walked.end());
    std::vector<bool> out;
    for (const StreetSide& side : face_.outer) {
      out.push_back(std::binary_search(walked.begin(), walked.end(),
                                       std::pair(side.segment.b, side.segment.a)));
    }
    return out;
  }

  /// The contour without dead ends, the dead ends cut out of it; nothing where that is not so
  /// simple.
  [[nodiscard]] detail::Admitted cut_dead_ends() const {
    const std::vector<bool> is_dead = dead_ends();
    std::vector<StreetSide> ring;
    for (std::size_t i = 0; i < is_dead.size(); ++i) {
      if (is_dead[i]) continue;
      const bool goes_on = ring.empty() || ring.back().segment.b == face_.outer[i].segment.a;
      if (!goes_on) return {};  // a dead end leads to another ring
      ring.push_back(face_.outer[i]);
    }
    if (ring.size() < 3) return {};
    const auto inset = simple_inset(ring);
    if (!inset) return {};
    const auto contour = admit_polygon({*inset, {}}, options_.max_vertices);
    if (!contour) return {};
    const detail::Geos geos;
    std::vector<detail::GeosShape> strips;
    for (const Polygon& strip : detail::street_strips(face_.outer, is_dead))
      strips.push_back(geos.from(strip));
    return regions_left(geos, *contour, std::move(strips));
  }

  /// `whole` without the strips, as usable regions.
  [[nodiscard]] detail::Admitted regions_left(const detail::Geos& geos, const Polygon& whole,
                                              std::vector<detail::GeosShape> strips) const {
    const auto streets = geos.union_of(std::move(strips));
    const auto left = geos.difference(geos.from(whole).get(), streets.get());
    detail::Admitted out;
    if (!left) {
      out.refused.push_back({{FailureCode::kNotSimple, "the streets could not be cut out"}, whole});
      return out;
    }
    const auto simple = geos.simplified(left.get(), options_.simplify_m);
    for (const Polygon& region : geos.polygons_of(simple.get())) {
      detail::Admitted part =
          detail::admit_region(geos, region, options_.min_area_m2, options_.max_vertices);
      std::move(part.polygons.begin(), part.polygons.end(), std::back_inserter(out.polygons));
      std::move(part.refused.begin(), part.refused.end(), std::back_inserter(out.refused));
    }
    return out;
  }

  [[nodiscard]] detail::Admitted cut_contours() const {
    const detail::Geos geos;
    std::vector<detail::GeosShape> strips;
    std::vector<Ring> walks;
    const auto add_walk = [&](const std::vector<StreetSide>& walk) {
      for (const Polygon& strip : detail::street_strips(walk)) strips.push_back(geos.from(strip));
      Ring& ring = walks.emplace_back();
      for (const StreetSide& side : walk) ring.push_back(side.segment.a);
    };
    add_walk(face_.outer);
    for (const auto& island : face_.islands) add_walk(island);
    const Polygon whole = polygon_of_walks(walks);
    detail::Admitted out = regions_left(geos, whole, std::move(strips));
    if (out.polygons.empty() && out.refused.empty()) {
      out.refused.push_back(
          {{FailureCode::kTooSmall,
            fmt::format("a face of {:.1f} m2 lies within its streets", area_m2(whole))},
           whole});
    }
    return out;
  }

  /// The side whose offset line passes nearest to the edge's middle; running along counts too.
  [[nodiscard]] BlockEdge label(const Segment& edge, const std::vector<StreetSide>& sides,
                                const streets::SegmentIndex& index, double widest_m) const {
    const Point middle = midpoint(edge.a, edge.b);
    const Point along = normalized(edge.b - edge.a);
    // Half a metre for being perpendicular: more than rounding and simplification, less than a
    // street.
    constexpr double kTurnWeight_m = 0.5;
    std::optional<std::pair<double, std::uint32_t>> best;
    for (double reach = 2.0 * widest_m + 1.0; !best; reach *= 4.0) {
      index.for_each_near(Box{middle, middle}.expanded(reach), [&](std::uint32_t i) {
        const StreetSide& side = sides[i];
        const Point direction = normalized(side.segment.b - side.segment.a);
        const double score = std::abs(distance(side.segment, middle) - side.half_width_m) +
                             kTurnWeight_m * (1.0 - dot(direction, along));
        const std::pair candidate(score, i);
        if (!best || candidate < *best) best = candidate;
      });
    }
    const streets::Street& street = network_.streets[sides[best->second].street];
    BlockEdge out;
    out.logical_street = 0;
    out.street = street.id;
    out.street_width_m = street.width_m;
    out.width_source = street.width_source;
    return out;
  }

  const FaceBoundary& face_;
  const StreetNetwork& network_;
  FaceOptions options_;
};

}  // namespace

FaceBlocks blocks_of_face(const FaceBoundary& boundary, const StreetNetwork& network,
                          const FaceOptions& options) {
  const FaceInset inset(boundary, network, options);
  detail::Admitted found = inset.contours();
  FaceBlocks out;
  for (Polygon& contour : found.polygons) out.blocks.push_back(inset.labelled(std::move(contour)));
  for (auto& [failure, shape] : found.refused)
    out.refused.push_back({std::move(failure), std::move(shape)});
  return out;
}

}  // namespace plat::blocks
