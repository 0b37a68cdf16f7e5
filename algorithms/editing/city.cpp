#include "editing/city.h"

#include <algorithm>

#include "core/planar_graph.h"
#include "editing/block_update_internal.h"
#include "editing/change.h"
#include "editing/network_edit_internal.h"
#include "parcels/block_subdivider.h"

namespace plat::editing {
namespace {

struct Pieces {
  std::vector<Segment> segments;
  std::vector<std::uint32_t> street_of;
};

Pieces bounding_pieces(const streets::StreetNetwork& network, streets::BoundingClasses bounding) {
  Pieces out;
  for (const streets::Street& street : network.streets) {
    expects(street.width_m > 0.0, "every street has a width");
    if (street.attributes.structure == streets::Structure::kTunnel ||
        !streets::bounds_blocks(street.attributes.street_class, bounding)) {
      continue;
    }
    for (std::size_t i = 1; i < street.line.size(); ++i) {
      out.segments.push_back({street.line[i - 1], street.line[i]});
      out.street_of.push_back(street.id.value);
    }
  }
  return out;
}

City make(const streets::StreetNetwork& network, const CityOptions& options,
          streets::BoundingClasses bounding, const StyleOf& style_of,
          std::shared_ptr<const tiles::TileLayout> layout) {
  static_cast<void>(
      parcels::block_subdividers().make(options.style.strategy, options.style.options));
  City city(options);
  Change change(city);
  change.set(std::move(layout));
  detail::NetworkEdit edit(change);
  const Pieces pieces = bounding_pieces(network, bounding);
  const PlanarGraph graph = node_segments(pieces.segments);
  for (const Point p : graph.nodes) edit.insert(change.new_node(), p);
  for (const PlanarGraph::Edge& edge : graph.edges) {
    const streets::Street& source = network.streets[pieces.street_of[edge.source]];
    CityStreet street;
    street.from = NodeId{edge.from};
    street.to = NodeId{edge.to};
    street.width_m = source.width_m;
    street.width_source = source.width_source;
    street.name = source.attributes.name;
    street.street_class = source.attributes.street_class;
    street.source_id = source.source_id;
    edit.insert(change.new_street(), std::move(street));
  }
  const Expected<detail::NetworkOutcome> outcome = edit.settle(detail::NetworkEdit::Check::kNone);
  expects(outcome.has_value(), "a noded network is a planar graph");
  detail::BlockUpdate blocks(change);
  blocks.make(outcome->faces, style_of);
  blocks.finish();
  change.keep();
  return city;
}

}  // namespace

City make_city(const streets::StreetNetwork& network, const CityOptions& options,
               streets::BoundingClasses bounding, const StyleOf& style_of) {
  return make(network, options, bounding, style_of, nullptr);
}

City make_city_of_tiles(const streets::StreetNetwork& network, tiles::TileLayout layout,
                        const CityOptions& options, streets::BoundingClasses bounding) {
  return make(network, options, bounding, {},
              std::make_shared<const tiles::TileLayout>(std::move(layout)));
}

City with_tiles(City city, tiles::TileLayout layout) {
  Change change(city);
  change.set(std::make_shared<const tiles::TileLayout>(std::move(layout)));
  std::vector<BlockId> blocks;
  city.blocks().for_each([&](BlockId id, const CityBlock&) { blocks.push_back(id); });
  for (const BlockId id : blocks) {
    CityBlock block = city.blocks().at(id);
    block.parcels.clear();
    block.records.clear();
    block.failure.reset();
    change.set(id, std::move(block));
  }
  change.keep();
  return city;
}

City with_options(City city, const CityOptions& options) {
  city.options_ = options;
  return city;
}

streets::StreetNetwork network_of(const City& city, std::vector<StreetId>* ids) {
  streets::StreetNetwork network;
  city.nodes().for_each(
      [&](NodeId, const CityNode& node) { network.nodes.push_back(node.position); });
  std::sort(network.nodes.begin(), network.nodes.end());
  const auto index_of = [&](NodeId id) {
    const Point p = city.nodes().at(id).position;
    return static_cast<std::uint32_t>(
        std::lower_bound(network.nodes.begin(), network.nodes.end(), p) - network.nodes.begin());
  };
  city.streets().for_each([&](StreetId id, const CityStreet& street) {
    streets::Street out;
    out.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
    out.from = index_of(street.from);
    out.to = index_of(street.to);
    out.line = street.line;
    out.attributes.name = street.name;
    out.attributes.street_class = street.street_class;
    out.width_m = street.width_m;
    out.width_source = street.width_source;
    out.source_id = street.source_id;
    network.streets.push_back(std::move(out));
    if (ids != nullptr) ids->push_back(id);
  });
  return network;
}

}  // namespace plat::editing
