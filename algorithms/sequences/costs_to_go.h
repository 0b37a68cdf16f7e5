#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sequences/layer_plan.h"
#include "sequences/min_plus.h"
#include "sequences/path_enumeration.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// More than any best path costs, by counting its steps, or kInfinite<Cost> where that is more than
/// whole numbers of 64 bits hold.
Cost path_cost_bound(const SearchGraph& graph, const LayerPlan& plan);

/// What the best completion costs, for every node of every zone and every consumed vector there:
/// dynamic programming from the last zone to the first, from large vectors to small ones.
///
/// Guarantees: 1. exact;  2. the same for both `Value`s: 32 bits serve where `path_cost_bound` is
/// below kInfinite<std::int32_t>, else 64.
template <class Value>
class CostsToGo final : public CompletionSpace {
 public:
  CostsToGo(const SearchGraph& graph, const LayerPlan& plan);
  /// Fills the table. Call once, before all else.
  void compute();

  [[nodiscard]] std::optional<Cost> best_cost() const override;
  std::optional<Cost> continue_from(StateId state, Cost max_slack,
                                    std::vector<Continuation>& out) const override;
  [[nodiscard]] std::uint64_t arcs_relaxed() const { return arcs_relaxed_; }
  [[nodiscard]] std::uint64_t bytes_held() const { return value_count_ * sizeof(Value); }

 private:
  struct ZoneTable {
    std::size_t first = 0;   ///< index of the first row
    std::size_t stride = 0;  ///< values per row
  };
  /// Arcs by head, to follow them backwards where nothing is consumed.
  struct ReverseTable {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> arc;
    std::vector<std::uint32_t> tail;
  };
  struct Scratch;
  struct Collector;

  [[nodiscard]] Value* row_values(std::size_t zone, Row row) {
    return values_.get() + tables_[zone].first + row * tables_[zone].stride;
  }
  [[nodiscard]] Value at(std::size_t zone, Row row, std::uint32_t node) const {
    return values_[tables_[zone].first + row * tables_[zone].stride +
                   (node - graph_.zones[zone].first_node)];
  }
  void fill_zone(std::size_t zone, Scratch& scratch);
  void add_exits(std::size_t zone, std::span<const Amount> consumed, Value* values) const;
  void add_links(std::size_t zone, Scratch& scratch, Value* values);
  void find_targets(std::size_t zone, Scratch& scratch) const;
  void relax_arcs(std::size_t zone, Row own, Scratch& scratch, Value* values);
  void settle_row(std::size_t zone, Row row, Scratch& scratch, Value* values);
  const ReverseTable& reverse(std::uint32_t table);
  void begin(Collector& collector) const;
  void follow_arcs(std::size_t zone, std::uint32_t tail, std::span<const Amount> consumed, Cost own,
                   Collector& collector) const;
  void follow_links(std::size_t zone, std::uint32_t node, std::span<const Amount> consumed,
                    Cost own, Collector& collector) const;
  [[nodiscard]] StateId state_of(std::size_t zone, Row row, std::uint32_t node) const;

  const SearchGraph& graph_;
  const LayerPlan& plan_;
  std::vector<ZoneTable> tables_;
  std::vector<std::optional<ReverseTable>> reverses_;
  std::unique_ptr<Value[]> values_;
  std::size_t value_count_ = 0;
  std::uint64_t arcs_relaxed_ = 0;
};

}  // namespace plat::sequences
