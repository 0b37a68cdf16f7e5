#include "editing/city_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/planar_graph.h"
#include "editing/block_update_internal.h"
#include "editing/change.h"
#include "editing/network_edit_internal.h"

namespace plat::editing {
namespace {

Failure strange_block(const Polygon& contour, std::string_view what) {
  const Point p = contour.outer.front();
  return {FailureCode::kNotCovered, fmt::format("the block at ({}, {}) {}", p.x, p.y, what)};
}

/// Gives every face its blocks out of the parts.
class BlockRestorer {
 public:
  BlockRestorer(Change& change, const CityParts& parts) : change_(change) {
    for (const CityBlock& block : parts.blocks)
      known_[block.block.contour.outer.front()].push_back(&block);
  }

  std::optional<Failure> restore(std::span<const WalkId> faces) {
    const City& city = change_.city();
    auto found = parallel_map<blocks::FaceBlocks>(
        faces.size(), city.options().jobs,
        [&](std::size_t i) { return detail::blocks_in(city, faces[i]); });
    for (std::size_t i = 0; i < faces.size(); ++i) {
      Walk face = city.walks().at(faces[i]);
      face.refused = std::move(found[i].refused);
      for (blocks::Block& block : found[i].blocks) {
        const CityBlock* part = take(block.contour);
        if (part == nullptr) return strange_block(block.contour, "of the streets is not given");
        CityBlock record = *part;
        record.block.edges = std::move(block.edges);
        face.blocks.push_back(record.block.id);
        change_.set(record.block.id, std::move(record));
      }
      std::sort(face.blocks.begin(), face.blocks.end());
      change_.set(faces[i], std::move(face));
    }
    for (const auto& [place, blocks] : known_) {
      if (!blocks.empty())
        return strange_block(blocks.front()->block.contour, "is not one that streets enclose");
    }
    return std::nullopt;
  }

 private:
  const CityBlock* take(const Polygon& contour) {
    const auto it = known_.find(contour.outer.front());
    if (it == known_.end()) return nullptr;
    for (auto block = it->second.begin(); block != it->second.end(); ++block) {
      if ((*block)->block.contour != contour) continue;
      const CityBlock* out = *block;
      it->second.erase(block);
      return out;
    }
    return nullptr;
  }

  Change& change_;
  std::map<Point, std::vector<const CityBlock*>> known_;
};

/// Whether noding leaves the streets as they are: the first invariant of a city.
bool is_noded(const City& city) {
  std::vector<Segment> segments;
  std::size_t places = city.nodes().size();
  city.streets().for_each([&](StreetId, const CityStreet& street) {
    for (std::size_t i = 1; i < street.line.size(); ++i)
      segments.push_back({street.line[i - 1], street.line[i]});
    places += street.line.size() - 2;
  });
  const PlanarGraph graph = node_segments(segments);
  return graph.edges.size() == segments.size() && graph.overlaps.empty() &&
         graph.nodes.size() == places;
}

}  // namespace

CityParts parts_of(const City& city) {
  CityParts out{city.options(), city.counters(), {}, {}, {}, city.tiles()};
  city.nodes().for_each(
      [&](NodeId id, const CityNode& node) { out.nodes.emplace_back(id, node.position); });
  city.streets().for_each(
      [&](StreetId id, const CityStreet& street) { out.streets.emplace_back(id, street); });
  city.blocks().for_each([&](BlockId, const CityBlock& block) { out.blocks.push_back(block); });
  return out;
}

Expected<City> restore_city(const CityParts& parts) {
  City city(parts.options);
  Change change(city);
  IdCounters counters = parts.counters;
  counters.walk = 0;
  change.reserve(counters);
  change.set(parts.tiles);
  detail::NetworkEdit edit(change);
  for (const auto& [id, position] : parts.nodes) edit.insert(id, position);
  for (const auto& [id, street] : parts.streets) edit.insert(id, street);
  if (!is_noded(city))
    return fail(FailureCode::kStreetsCross, "streets cross or touch where they have no node");
  const Expected<detail::NetworkOutcome> outcome = edit.settle(detail::NetworkEdit::Check::kNone);
  if (!outcome) return tl::unexpected<Failure>(outcome.error());
  if (auto failure = BlockRestorer(change, parts).restore(outcome->faces))
    return tl::unexpected<Failure>(*std::move(failure));
  change.keep();
  return city;
}

}  // namespace plat::editing
