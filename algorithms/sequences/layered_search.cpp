#include "sequences/layered_search.h"

#include <optional>
#include <string>
#include <utility>

#include "sequences/cost_filling.h"
#include "sequences/cost_table.h"
#include "sequences/costs_to_go.h"
#include "sequences/layer_plan.h"
#include "sequences/path_enumeration.h"

namespace plat::sequences {
namespace {

constexpr double kBytesPerMb = 1e6;

template <class Value>
class LayeredStream final : public SequenceStream {
 public:
  LayeredStream(const SearchGraph& graph, LayerPlan plan, const LayeredSearch::Options& options)
      : graph_(graph), options_(options), plan_(std::move(plan)) {}

  Expected<bool> next(SequencePath& path) override {
    if (!paths_) {
      table_.emplace(graph_, plan_);
      arcs_relaxed_ = fill_costs(graph_, plan_, options_.instructions, *table_);
      costs_.emplace(graph_, plan_, *table_);
      PathEnumeration::Limits limits;
      limits.batch_paths = static_cast<std::size_t>(options_.batch_paths);
      paths_.emplace(*costs_, limits);
    }
    return paths_->next(path);
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics statistics;
    statistics.states_created = plan_.state_count;
    if (!paths_) return statistics;
    statistics.states_expanded = plan_.state_count;
    statistics.arcs_relaxed = arcs_relaxed_ + paths_->steps_taken();
    statistics.bytes_held = table_->size() * sizeof(Value) + paths_->bytes_held();
    return statistics;
  }

 private:
  const SearchGraph& graph_;
  LayeredSearch::Options options_;
  LayerPlan plan_;
  std::optional<CostTable<Value>> table_;
  std::optional<CostsToGo<Value>> costs_;
  std::optional<PathEnumeration> paths_;
  std::uint64_t arcs_relaxed_ = 0;
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> LayeredSearch::search(const SearchGraph& graph) const {
  static_cast<void>(resolved(options_.instructions));
  const auto max_values =
      static_cast<std::uint64_t>(options_.max_memory_mb * kBytesPerMb / sizeof(std::int32_t));
  auto plan = plan_layers(graph, max_values);
  if (!plan)
    return fail(FailureCode::kTooManyStates,
                "the table of costs-to-go needs more than max_memory_mb = " +
                    std::to_string(options_.max_memory_mb) +
                    "; use coarser steps or another method");
  std::unique_ptr<SequenceStream> stream;
  if (path_cost_bound(graph, *plan) < kInfinite<std::int32_t>)
    stream = std::make_unique<LayeredStream<std::int32_t>>(graph, std::move(*plan), options_);
  else
    stream = std::make_unique<LayeredStream<std::int64_t>>(graph, std::move(*plan), options_);
  return stream;
}

}  // namespace plat::sequences
