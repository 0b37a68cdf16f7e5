#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sequences/cost_table.h"
#include "sequences/layer_plan.h"
#include "sequences/path_enumeration.h"
#include "sequences/search_graph.h"

namespace plat::sequences {

/// Reads the ways to go on off a filled table of costs-to-go.
template <class Value>
class CostsToGo final : public CompletionSpace {
 public:
  CostsToGo(const SearchGraph& graph, const LayerPlan& plan, const CostTable<Value>& table);
  [[nodiscard]] std::optional<Cost> best_cost() const override;
  std::optional<Cost> continue_from(StateId state, Cost max_slack,
                                    std::vector<Continuation>& out) const override;

 private:
  struct Collector;
  void begin(Collector& collector) const;
  void follow_arcs(std::size_t zone, std::uint32_t tail, std::span<const Amount> consumed, Cost own,
                   Collector& collector) const;
  void follow_links(std::size_t zone, std::uint32_t node, std::span<const Amount> consumed,
                    Cost own, Collector& collector) const;
  void add(Collector& collector, std::size_t zone, Row row, Cost slack, const Step& step) const;

  const SearchGraph& graph_;
  const LayerPlan& plan_;
  const CostTable<Value>& table_;
};

}  // namespace plat::sequences
