#include "harness/tiled_city.h"

#include <fmt/format.h>

namespace plat::harness {
namespace {

constexpr std::string_view kZoneAttribute = "zone";

std::vector<tiles::TilePiece> pieces_of(const editing::City& city) {
  std::vector<tiles::TilePiece> out;
  city.blocks().for_each([&](BlockId id, const editing::CityBlock& block) {
    if (block.parcels.empty())
      out.push_back({fmt::format("block {}", id.value), {}, id.value, block.block.contour});
    for (std::size_t i = 0; i < block.parcels.size(); ++i) {
      const parcels::Parcel& parcel = block.parcels[i];
      const auto& attributes = block.records[i].attributes;
      const auto zone = attributes.find(kZoneAttribute);
      out.push_back({fmt::format("{}", parcel.id.value),
                     zone == attributes.end() ? std::string() : zone->second, id.value,
                     parcel.shape});
    }
  });
  return out;
}

std::vector<tiles::StreetLine> street_lines_of(const editing::City& city) {
  std::vector<tiles::StreetLine> out;
  city.streets().for_each([&](StreetId, const editing::CityStreet& street) {
    out.push_back({street.line, street.width_m});
  });
  return out;
}

streets::StreetNetwork streets_around(const tiles::TileLayout& layout,
                                      streets::StreetNetwork network) {
  Box box;
  for (const tiles::LayoutVertex& vertex : layout.vertices) box.add(vertex.at);
  const Box around = box.expanded(kStreetsAround_m);
  std::erase_if(network.streets, [&](const streets::Street& street) {
    return street.line.empty() || !(street.width_m > 0.0) ||
           !around.intersects(box_of(street.line));
  });
  return network;
}

}  // namespace

TiledCity with_tiles_of_parcels(PlacedCity placed, Jobs jobs) {
  if (placed.city.tiles()) return {std::move(placed), {}};
  tiles::LayoutConstruction made = tiles::construct_layout(
      pieces_of(placed.city), street_lines_of(placed.city), tiles::ConstructionOptions{}, jobs);
  placed.city = editing::with_tiles(std::move(placed.city), std::move(made.layout));
  return {std::move(placed), std::move(made.failures)};
}

TiledCity city_of_observed_tiles(ObservedTiles observed, const editing::CityOptions& options) {
  tiles::TileLayout& layout = observed.tiles.layout;
  const streets::StreetNetwork network = streets_around(layout, std::move(observed.network));
  return {{editing::make_city_of_tiles(network, std::move(layout), options), observed.frame},
          std::move(observed.tiles.failures)};
}

}  // namespace plat::harness
