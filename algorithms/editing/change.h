#pragma once

#include <memory>
#include <vector>

#include "editing/city.h"

namespace plat::editing {

/// What one edit replaced, in order: enough to undo and to redo it without computing anything.
struct Delta {
  template <class Key, class Record>
  struct Entry {
    Key key;
    std::shared_ptr<const Record> before;
    std::shared_ptr<const Record> after;
  };
  std::vector<Entry<NodeId, CityNode>> nodes;
  std::vector<Entry<StreetId, CityStreet>> streets;
  std::vector<Entry<StreetId, StreetSides>> sides;
  std::vector<Entry<WalkId, Walk>> walks;
  std::vector<Entry<BlockId, CityBlock>> blocks;
  std::shared_ptr<const tiles::TileLayout> tiles_before;
  std::shared_ptr<const tiles::TileLayout> tiles_after;
  IdCounters counters_before;
  IdCounters counters_after;
};

/// The one way in which records of a city are replaced: all at once, or not at all.
///
/// Guarantees: 1. unless kept, everything is put back when the change goes out of scope;
/// 2. revert() after keep() gives the city before, replay() the city after, to the last bit.
class Change {
 public:
  explicit Change(City& city) : city_(city) {
    delta_.counters_before = delta_.counters_after = city.counters_;
    delta_.tiles_before = delta_.tiles_after = city.tiles_;
  }
  ~Change() {
    if (!is_kept_) revert(city_, delta_);
  }
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;

  [[nodiscard]] const City& city() const { return city_; }

  NodeId new_node() { return {city_.counters_.node++}; }
  StreetId new_street() { return {city_.counters_.street++}; }
  WalkId new_walk() { return {city_.counters_.walk++}; }
  BlockId new_block() { return {city_.counters_.block++}; }
  ParcelId new_parcel() { return {city_.counters_.parcel++}; }
  /// For ids that come from elsewhere: none below these is given any more.
  void reserve(const IdCounters& counters);

  void set(NodeId id, CityNode record);
  void set(StreetId id, CityStreet record);
  void set(StreetId id, StreetSides record);
  void set(WalkId id, Walk record);
  void set(BlockId id, CityBlock record);
  void set(std::shared_ptr<const tiles::TileLayout> layout);
  void erase(NodeId id);
  void erase(StreetId id);
  void erase(WalkId id);
  void erase(BlockId id);

  /// Makes the change stay, and hands out what it did.
  Delta keep();

  static void revert(City& city, const Delta& delta);
  static void replay(City& city, const Delta& delta);

 private:
  template <class Key, class Record>
  static void put(City& city, Table<Key, Record>& table, Key key,
                  std::shared_ptr<const Record> record);
  template <class Key, class Record>
  void log(std::vector<Delta::Entry<Key, Record>>& entries, Table<Key, Record>& table, Key key,
           std::shared_ptr<const Record> record);

  City& city_;
  Delta delta_;
  bool is_kept_ = false;
};

}  // namespace plat::editing
