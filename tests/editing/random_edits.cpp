#include "editing/random_edits.h"

#include <cmath>
#include <numbers>

#include "parcels/block_subdivider.h"

namespace plat::testing {

using namespace editing;  // every line below names an edit

namespace {

template <class Key, class Record>
Key any_of(const Table<Key, Record>& table, Rng& rng) {
  std::uint64_t left = rng.index(table.size());
  Key found;
  table.for_each([&](Key key, const Record&) {
    if (left-- == 0) found = key;
  });
  return found;
}

Point near(Point p, double reach_m, Rng& rng) {
  const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::exp(rng.uniform(std::log(0.01), std::log(reach_m)));
  return p + r * Point{std::cos(angle), std::sin(angle)};
}

Point place_of(const City& city, NodeId node) { return city.nodes().at(node).position; }

Edit random_bend(const City& city, Rng& rng) {
  const StreetId id = any_of(city.streets(), rng);
  if (rng.index(3) == 0) return BendStreet{id, std::nullopt};
  const CityStreet& street = city.streets().at(id);
  const Point a = place_of(city, street.from);
  const Point b = place_of(city, street.to);
  return BendStreet{id,
                    Curve{near(lerp(a, b, 0.33), 30.0, rng), near(lerp(a, b, 0.67), 30.0, rng)}};
}

Edit random_add(const City& city, Rng& rng) {
  AddStreet edit;
  const Point middle = place_of(city, any_of(city.nodes(), rng));
  edit.from = near(middle, 90.0, rng);
  edit.to = near(middle, 250.0, rng);
  edit.width_m = rng.uniform(3.0, 20.0);
  if (rng.index(3) == 0) edit.snap_m = 5.0;
  return edit;
}

Edit random_style(const City& city, Rng& rng) {
  SetBlockStyle edit;
  const std::vector<std::string> names = parcels::block_subdividers().names();
  edit.style.strategy = names[rng.index(names.size())];
  if (city.blocks().size() > 0) edit.blocks.push_back(any_of(city.blocks(), rng));
  return edit;
}

Edit random_attribute(const City& city, Rng& rng) {
  SetParcelAttribute edit;
  edit.key = "use";
  if (rng.index(3) != 0) edit.value = std::to_string(rng.index(1000));
  if (city.blocks().size() == 0) return edit;
  const CityBlock& block = city.blocks().at(any_of(city.blocks(), rng));
  if (!block.parcels.empty()) edit.parcel = block.parcels[rng.index(block.parcels.size())].id;
  return edit;
}

std::vector<NodeId> some_nodes(const City& city, Rng& rng) {
  std::vector<NodeId> out;
  if (rng.index(4) == 0) return out;  // all
  const Point middle = place_of(city, any_of(city.nodes(), rng));
  city.nodes().for_each([&](NodeId id, const CityNode& node) {
    if (distance(node.position, middle) < 120.0) out.push_back(id);
  });
  return out;
}

/// A tile, and most often some around it.
std::vector<tiles::TileId> some_tiles(const tiles::TileLayout& layout, Rng& rng) {
  const auto place = [&](const tiles::Tile& tile) { return centroid(shape_of(layout, tile)); };
  const Point middle = place(layout.tiles[rng.index(layout.tiles.size())]);
  const double reach_m = rng.uniform(1.0, 70.0);
  std::vector<tiles::TileId> out;
  for (const tiles::Tile& tile : layout.tiles) {
    if (distance(place(tile), middle) <= reach_m) out.push_back(tile.id);
  }
  return out;
}

Affine random_motion(const tiles::TileLayout& layout, Rng& rng) {
  const tiles::Tile& tile = layout.tiles[rng.index(layout.tiles.size())];
  const Affine turn = Affine::rotation(rng.uniform(-0.05, 0.05), centroid(shape_of(layout, tile)));
  return Affine::translation(near({}, 8.0, rng)) * turn;
}

tiles::ReconfigurationOptions random_options(Rng& rng) {
  tiles::ReconfigurationOptions out;
  out.solver.rigidity = std::exp(rng.uniform(-3.0, 3.0));
  if (rng.index(2) == 0) out.reach_m.reset();
  return out;
}

Edit random_tile_edit(const tiles::TileLayout& layout, Rng& rng) {
  const std::vector<tiles::TileId> tiles = some_tiles(layout, rng);
  switch (rng.index(9)) {
    case 0:
    case 1:
    case 2:
      return MoveTiles{tiles, random_motion(layout, rng), random_options(rng)};
    case 3: {
      const auto group = tiles::copy_tiles(layout, {tiles.data(), 1});
      const tiles::Tile& to = layout.tiles[rng.index(layout.tiles.size())];
      const Point by = centroid(shape_of(layout, to)) -
                       centroid(shape_of(group->tiles, group->tiles.tiles.front()));
      return PasteTiles{std::make_shared<const tiles::TileGroup>(*group), Affine::translation(by),
                        random_options(rng)};
    }
    case 4:
      return CutTiles{{tiles.front()},
                      rng.index(2) == 0 ? tiles::VacatedLand::kVacant : tiles::VacatedLand::kClosed,
                      random_options(rng)};
    case 5:
    case 6:
      return PinTiles{tiles, rng.index(3) == 0 ? Pinning::kPinned : Pinning::kFree};
    case 7:
      return ReplaceTiles{{.deformation_threshold = 0.02, .candidates = 2, .max_rounds = 2},
                          random_options(rng)};
    default:
      return RelaxTiles{random_options(rng)};
  }
}

}  // namespace

Edit random_edit(const City& city, Rng& rng) {
  if (city.tiles() && rng.index(2) == 0) return random_tile_edit(*city.tiles(), rng);
  switch (rng.index(12)) {
    case 0:
    case 1: {
      const NodeId node = any_of(city.nodes(), rng);
      return MoveNode{node, near(place_of(city, node), 60.0, rng), rng.index(3) == 0 ? 6.0 : 0.0};
    }
    case 2:
      return MoveStreet{any_of(city.streets(), rng), near({}, 40.0, rng)};
    case 3:
      return random_bend(city, rng);
    case 4:
    case 5:
      return random_add(city, rng);
    case 6:
    case 7:
      return RemoveStreet{any_of(city.streets(), rng)};
    case 8:
      return SetStreetWidth{any_of(city.streets(), rng), rng.uniform(2.0, 30.0)};
    case 9:
      return rng.index(2) == 0 ? random_style(city, rng) : random_attribute(city, rng);
    case 10:
      return ScaleNodes{some_nodes(city, rng), place_of(city, any_of(city.nodes(), rng)),
                        std::exp(rng.uniform(-0.1, 0.1))};
    default:
      return RotateNodes{some_nodes(city, rng), place_of(city, any_of(city.nodes(), rng)),
                         rng.uniform(-0.3, 0.3)};
  }
}

}  // namespace plat::testing
