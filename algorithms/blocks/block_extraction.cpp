#include "blocks/block_extraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "blocks/admission_internal.h"
#include "blocks/contour_offset_internal.h"
#include "blocks/edge_labels.h"
#include "blocks/geos_internal.h"
#include "core/planar_faces.h"
#include "core/validity.h"
#include "streets/segment_index.h"

namespace plat::blocks {
namespace {

using detail::StreetSide;
using streets::StreetNetwork;

/// The noded map of the streets that bound blocks.
struct StreetMap {
  PlanarGraph graph;
  PlanarFaces faces;
  std::vector<std::uint32_t> street_of;  ///< per input segment
};

StreetMap map_streets(const StreetNetwork& network, const ExtractionOptions& options) {
  StreetMap map;
  std::vector<Segment> segments;
  for (const streets::Street& street : network.streets) {
    if (street.attributes.structure == streets::Structure::kTunnel ||
        !streets::bounds_blocks(street.attributes.street_class, options.bounding)) {
      continue;
    }
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      segments.push_back({street.line[i - 1], street.line[i]});
      map.street_of.push_back(street.id.value);
    }
  }
  map.graph = node_segments(segments);
  map.faces = find_faces(map.graph);
  return map;
}

class FaceInset {
 public:
  FaceInset(const StreetNetwork& network, const StreetMap& map, const ExtractionOptions& options)
      : network_(network), map_(map), options_(options) {}

  [[nodiscard]] detail::Admitted contours(const Face& face) const {
    if (auto contour = simple_contour(face)) {
      detail::Admitted out;
      out.polygons.push_back(*std::move(contour));
      return out;
    }
    return cut_contours(face);
  }

  /// The contour's edges with the streets that they were offset from.
  [[nodiscard]] Block labelled(const Face& face, Polygon contour) const {
    std::vector<StreetSide> sides = sides_of(face.outer);
    for (const auto& island : face.islands) {
      const std::vector<StreetSide> more = sides_of(island);
      sides.insert(sides.end(), more.begin(), more.end());
    }
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
  [[nodiscard]] std::vector<StreetSide> sides_of(const std::vector<HalfEdge>& walk) const {
    std::vector<StreetSide> sides;
    sides.reserve(walk.size());
    for (const HalfEdge h : walk) {
      const std::uint32_t street = map_.street_of[map_.graph.edges[edge_of(h)].source];
      sides.push_back(
          {{map_.graph.nodes[origin(map_.graph, h)], map_.graph.nodes[target(map_.graph, h)]},
           0.5 * network_.streets[street].width_m,
           street});
    }
    return sides;
  }

  /// nullopt where the face has dead ends, islands or narrow places.
  [[nodiscard]] std::optional<Polygon> simple_contour(const Face& face) const {
    if (!face.islands.empty()) return std::nullopt;
    std::vector<std::uint32_t> visited;
    for (const HalfEdge h : face.outer) visited.push_back(origin(map_.graph, h));
    std::sort(visited.begin(), visited.end());
    if (std::adjacent_find(visited.begin(), visited.end()) != visited.end()) return std::nullopt;
    const Ring inset = detail::inset_ring(sides_of(face.outer));
    if (inset.empty() || signed_area_m2(inset) <= 0.0) return std::nullopt;
    auto contour = admit_polygon({inset, {}}, options_.max_vertices);
    if (!contour || area_m2(*contour) < options_.min_area_m2) return std::nullopt;
    return *std::move(contour);
  }

  [[nodiscard]] detail::Admitted cut_contours(const Face& face) const {
    const detail::Geos geos;
    std::vector<detail::GeosShape> strips;
    const auto add_strips = [&](const std::vector<HalfEdge>& walk) {
      for (const Polygon& strip : detail::street_strips(sides_of(walk)))
        strips.push_back(geos.from(strip));
    };
    add_strips(face.outer);
    for (const auto& island : face.islands) add_strips(island);
    const Polygon whole = polygon_of(map_.graph, face);
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

  const StreetNetwork& network_;
  const StreetMap& map_;
  ExtractionOptions options_;
};

bool fronts(const Block& block, StreetId street) {
  return std::any_of(block.edges.begin(), block.edges.end(), [&](const auto& ring) {
    return std::any_of(ring.begin(), ring.end(),
                       [&](const BlockEdge& edge) { return edge.street == street; });
  });
}

std::vector<DualEdge> find_dual(const StreetMap& map, std::span<const Block> blocks,
                                const std::vector<std::vector<BlockId>>& blocks_of_face) {
  std::map<std::tuple<BlockId, BlockId, StreetId>, double> lengths;
  for (std::uint32_t e = 0; e < map.graph.edges.size(); ++e) {
    const std::uint32_t left = map.faces.face_of[2 * e];
    const std::uint32_t right = map.faces.face_of[2 * e + 1];
    if (left == right || left == PlanarFaces::kUnbounded || right == PlanarFaces::kUnbounded)
      continue;
    const PlanarGraph::Edge& edge = map.graph.edges[e];
    const StreetId street{map.street_of[edge.source]};
    const double length_m = distance(map.graph.nodes[edge.from], map.graph.nodes[edge.to]);
    for (const BlockId a : blocks_of_face[left]) {
      if (!fronts(blocks[a.value], street)) continue;
      for (const BlockId b : blocks_of_face[right]) {
        if (fronts(blocks[b.value], street))
          lengths[{std::min(a, b), std::max(a, b), street}] += length_m;
      }
    }
  }
  std::vector<DualEdge> dual;
  for (const auto& [key, length_m] : lengths)
    dual.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), length_m});
  return dual;
}

}  // namespace

BlocksOfNetwork extract_blocks(const StreetNetwork& network, const ExtractionOptions& options,
                               Jobs jobs) {
  for (const streets::Street& street : network.streets)
    expects(street.width_m > 0.0, "every street has a width");
  const StreetMap map = map_streets(network, options);
  const FaceInset inset(network, map, options);
  struct FaceResult {
    std::vector<Block> blocks;
    std::vector<detail::Admitted::Refused> refused;
  };
  const std::vector<Face>& faces = map.faces.faces;
  auto results = parallel_map<FaceResult>(faces.size(), jobs, [&](std::size_t f) {
    detail::Admitted found = inset.contours(faces[f]);
    FaceResult result;
    for (Polygon& contour : found.polygons)
      result.blocks.push_back(inset.labelled(faces[f], std::move(contour)));
    result.refused = std::move(found.refused);
    return result;
  });

  BlocksOfNetwork out;
  out.face_count = faces.size();
  std::vector<std::vector<BlockId>> blocks_of_face(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (Block& block : results[f].blocks) {
      block.id = {static_cast<std::uint32_t>(out.blocks.size())};
      blocks_of_face[f].push_back(block.id);
      out.blocks.push_back(std::move(block));
    }
    for (auto& [failure, shape] : results[f].refused) {
      const std::uint32_t edge = edge_of(faces[f].outer.front());
      const auto& street = network.streets[map.street_of[map.graph.edges[edge].source]];
      out.failures.push_back({street.source_id, std::move(failure), std::move(shape)});
    }
  }
  out.dual = find_dual(map, out.blocks, blocks_of_face);
  return out;
}

}  // namespace plat::blocks
