#include "editing/change.h"

#include <algorithm>
#include <type_traits>

namespace plat::editing {

template <class Key, class Record>
void Change::put(City& city, Table<Key, Record>& table, Key key,
                 std::shared_ptr<const Record> record) {
  if constexpr (std::is_same_v<Record, CityStreet>) {
    const auto box_of_line = [](const Polyline& line) {
      Box box;
      for (const Point p : line) box.add(p);
      return box;
    };
    const CityStreet* old = table.find(key);
    const bool is_moved = !old || !record || old->line != record->line;
    if (old && is_moved) city.grid_.erase(key, box_of_line(old->line));
    if (record && is_moved) city.grid_.insert(key, box_of_line(record->line));
  }
  table.exchange(key, std::move(record));
}

template <class Key, class Record>
void Change::log(std::vector<Delta::Entry<Key, Record>>& entries, Table<Key, Record>& table,
                 Key key, std::shared_ptr<const Record> record) {
  // What is there stays alive in the log: the table's pointer is taken out and put back.
  std::shared_ptr<const Record> before = table.exchange(key, nullptr);
  table.exchange(key, before);
  entries.push_back({key, std::move(before), record});
  put(city_, table, key, std::move(record));
}

void Change::set(NodeId id, CityNode record) {
  log(delta_.nodes, city_.nodes_, id, std::make_shared<const CityNode>(std::move(record)));
}
void Change::set(StreetId id, CityStreet record) {
  log(delta_.streets, city_.streets_, id, std::make_shared<const CityStreet>(std::move(record)));
}
void Change::set(StreetId id, StreetSides record) {
  log(delta_.sides, city_.sides_, id, std::make_shared<const StreetSides>(record));
}
void Change::set(WalkId id, Walk record) {
  log(delta_.walks, city_.walks_, id, std::make_shared<const Walk>(std::move(record)));
}
void Change::set(BlockId id, CityBlock record) {
  log(delta_.blocks, city_.blocks_, id, std::make_shared<const CityBlock>(std::move(record)));
}
void Change::set(std::shared_ptr<const tiles::TileLayout> layout) {
  delta_.tiles_after = layout;
  city_.tiles_ = std::move(layout);
}
void Change::erase(NodeId id) { log(delta_.nodes, city_.nodes_, id, {}); }
void Change::erase(StreetId id) {
  log(delta_.streets, city_.streets_, id, {});
  if (city_.sides_.contains(id)) log(delta_.sides, city_.sides_, id, {});
}
void Change::erase(WalkId id) { log(delta_.walks, city_.walks_, id, {}); }
void Change::erase(BlockId id) { log(delta_.blocks, city_.blocks_, id, {}); }

void Change::reserve(const IdCounters& counters) {
  IdCounters& own = city_.counters_;
  own = {std::max(own.node, counters.node), std::max(own.street, counters.street),
         std::max(own.walk, counters.walk), std::max(own.block, counters.block),
         std::max(own.parcel, counters.parcel)};
}

Delta Change::keep() {
  is_kept_ = true;
  delta_.counters_after = city_.counters_;
  return std::move(delta_);
}

void Change::revert(City& city, const Delta& delta) {
  const auto back = [&](const auto& entries, auto& table) {
    for (auto it = entries.rbegin(); it != entries.rend(); ++it)
      put(city, table, it->key, it->before);
  };
  back(delta.nodes, city.nodes_);
  back(delta.streets, city.streets_);
  back(delta.sides, city.sides_);
  back(delta.walks, city.walks_);
  back(delta.blocks, city.blocks_);
  city.tiles_ = delta.tiles_before;
  city.counters_ = delta.counters_before;
}

void Change::replay(City& city, const Delta& delta) {
  const auto forth = [&](const auto& entries, auto& table) {
    for (const auto& entry : entries) put(city, table, entry.key, entry.after);
  };
  forth(delta.nodes, city.nodes_);
  forth(delta.streets, city.streets_);
  forth(delta.sides, city.sides_);
  forth(delta.walks, city.walks_);
  forth(delta.blocks, city.blocks_);
  city.tiles_ = delta.tiles_after;
  city.counters_ = delta.counters_after;
}

}  // namespace plat::editing
