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

}  // namespace

Edit random_edit(const City& city, Rng& rng) {
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
