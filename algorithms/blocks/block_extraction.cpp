#include "blocks/block_extraction.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/planar_faces.h"

namespace plat::blocks {
namespace {

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

FaceBoundary boundary_of(const Face& face, const StreetNetwork& network, const StreetMap& map) {
  const auto sides_of = [&](const std::vector<HalfEdge>& walk) {
    std::vector<StreetSide> sides;
    sides.reserve(walk.size());
    for (const HalfEdge h : walk) {
      const std::uint32_t street = map.street_of[map.graph.edges[edge_of(h)].source];
      sides.push_back(
          {{map.graph.nodes[origin(map.graph, h)], map.graph.nodes[target(map.graph, h)]},
           0.5 * network.streets[street].width_m,
           street});
    }
    return sides;
  };
  FaceBoundary out{sides_of(face.outer), {}};
  for (const auto& island : face.islands) out.islands.push_back(sides_of(island));
  return out;
}

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
  const std::vector<Face>& faces = map.faces.faces;
  auto results = parallel_map<FaceBlocks>(faces.size(), jobs, [&](std::size_t f) {
    return blocks_of_face(boundary_of(faces[f], network, map), network, options.face);
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
