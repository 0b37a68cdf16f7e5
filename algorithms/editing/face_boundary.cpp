#include <algorithm>
#include <map>
#include <tuple>

#include "editing/block_update_internal.h"

namespace plat::editing::detail {
namespace {

using blocks::StreetSide;

/// Collects the streets of a face in a network of their own.
class FaceStreets {
 public:
  FaceStreets(const City& city, streets::StreetNetwork& network, std::vector<StreetId>& ids)
      : city_(city), network_(network), ids_(ids) {}

  std::vector<StreetSide> sides_of(const Walk& walk) {
    std::vector<StreetSide> sides;
    std::vector<bool> runs_along;
    for (const HalfEdge h : walk.half_edges) {
      const CityStreet& street = city_.streets().at(street_of(h));
      const std::uint32_t index = index_of(street_of(h), street);
      const auto add = [&](Point a, Point b) {
        sides.push_back({{a, b}, 0.5 * street.width_m, index});
        runs_along.push_back((h & 1U) == 0U);
      };
      const Polyline& line = street.line;
      if ((h & 1U) == 0U) {
        for (std::size_t i = 1; i < line.size(); ++i) add(line[i - 1], line[i]);
      } else {
        for (std::size_t i = line.size(); i-- > 1;) add(line[i], line[i - 1]);
      }
    }
    // Where find_faces() starts a walk: at the lowest edge, along its street first.
    const auto key = [&](std::size_t i) {
      const auto& [a, b] = sides[i].segment;
      return std::tuple(std::min(a, b), std::max(a, b), !runs_along[i]);
    };
    std::size_t start = 0;
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (key(i) < key(start)) start = i;
    }
    std::rotate(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(start), sides.end());
    return sides;
  }

 private:
  std::uint32_t index_of(StreetId id, const CityStreet& street) {
    const auto [it, is_new] = index_.emplace(id, static_cast<std::uint32_t>(ids_.size()));
    if (is_new) {
      ids_.push_back(id);
      streets::Street copy;
      copy.id = StreetId{it->second};
      copy.attributes.name = street.name;
      copy.attributes.street_class = street.street_class;
      copy.width_m = street.width_m;
      copy.width_source = street.width_source;
      network_.streets.push_back(std::move(copy));
    }
    return it->second;
  }

  const City& city_;
  streets::StreetNetwork& network_;
  std::vector<StreetId>& ids_;
  std::map<StreetId, std::uint32_t> index_;
};

}  // namespace

blocks::FaceBoundary boundary_of(const City& city, const Walk& face,
                                 streets::StreetNetwork& network, std::vector<StreetId>& ids) {
  FaceStreets collect(city, network, ids);
  blocks::FaceBoundary out;
  out.outer = collect.sides_of(face);
  std::vector<std::pair<Point, WalkId>> islands;
  for (const WalkId id : face.islands)
    islands.emplace_back(leftmost_point(city, city.walks().at(id)), id);
  std::sort(islands.begin(), islands.end());
  for (const auto& [place, id] : islands)
    out.islands.push_back(collect.sides_of(city.walks().at(id)));
  return out;
}

blocks::FaceBlocks blocks_in(const City& city, WalkId face) {
  streets::StreetNetwork network;
  std::vector<StreetId> ids;
  const blocks::FaceBoundary boundary = boundary_of(city, city.walks().at(face), network, ids);
  blocks::FaceBlocks out = blocks::blocks_of_face(boundary, network, city.options().face);
  for (blocks::Block& block : out.blocks) {
    for (auto& ring : block.edges) {
      for (blocks::BlockEdge& edge : ring) {
        if (edge.street) edge.street = ids[edge.street->value];
      }
    }
  }
  return out;
}

}  // namespace plat::editing::detail
