#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sequences/search_graph.h"
#include "sequences/state_groups.h"

namespace plat::sequences {

/// The arcs of a zone, sorted by what they consume: arcs of one class lead from one group of states
/// to one other, so that a group looks each class up once.
class ZoneArcs {
 public:
  /// An arc, seen from its head.
  struct Incoming {
    std::uint32_t tail = 0;
    std::uint32_t arc = 0;
  };

  /// @param zone  has a table
  ZoneArcs(const SearchGraph& graph, const Zone& zone);

  [[nodiscard]] const TransitionTable& table() const { return *table_; }
  [[nodiscard]] std::uint32_t class_count() const { return class_count_; }
  /// By dimension: what the head and the arcs of the class consume.
  [[nodiscard]] std::span<const Amount> used(std::uint32_t arc_class) const {
    return {used_.data() + std::size_t{arc_class} * dimension_count_, dimension_count_};
  }
  [[nodiscard]] std::uint32_t class_of(std::uint32_t arc) const { return class_of_arc_[arc]; }
  /// All arcs into a head are of one class, as where no arc consumes anything itself.
  [[nodiscard]] bool is_by_head() const { return table_->arc_uses.empty(); }
  /// The class of the arcs into `head`, where `is_by_head`.
  [[nodiscard]] std::uint32_t class_of_head(std::uint32_t head) const {
    return class_of_head_[head];
  }
  [[nodiscard]] NodeBits successors(std::uint32_t tail) const {
    return {successors_.data() + std::size_t{tail} * words_, words_};
  }
  [[nodiscard]] NodeBits predecessors(std::uint32_t head) const {
    return {predecessors_.data() + std::size_t{head} * words_, words_};
  }
  /// By tail, then as in the table.
  [[nodiscard]] std::span<const Incoming> arcs_into(std::uint32_t head) const {
    return {incoming_.data() + first_incoming_[head],
            first_incoming_[head + 1] - first_incoming_[head]};
  }

 private:
  void sort_into_classes(const SearchGraph& graph, const Zone& zone);
  void turn_around();

  const TransitionTable* table_;
  std::uint32_t dimension_count_;
  std::size_t words_;
  std::uint32_t class_count_ = 0;
  std::vector<Amount> used_;  ///< classes x dimensions
  std::vector<std::uint32_t> class_of_arc_;
  std::vector<std::uint32_t> class_of_head_;
  std::vector<std::uint64_t> successors_;    ///< nodes x words
  std::vector<std::uint64_t> predecessors_;  ///< nodes x words
  std::vector<std::uint32_t> first_incoming_;
  std::vector<Incoming> incoming_;
};

/// The arcs of all zones; zones of the same table whose nodes use the same share theirs.
class AllZoneArcs {
 public:
  explicit AllZoneArcs(const SearchGraph& graph);
  /// None where the zone has no arcs of its own.
  [[nodiscard]] const ZoneArcs* of_zone(std::uint32_t zone) const {
    return index_[zone] ? &arcs_[*index_[zone]] : nullptr;
  }

 private:
  std::vector<ZoneArcs> arcs_;
  std::vector<std::optional<std::size_t>> index_;  ///< by zone
};

}  // namespace plat::sequences
