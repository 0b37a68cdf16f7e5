#include "sequences/layered_search.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <utility>

#include "sequences/cost_filling.h"
#include "sequences/cost_table.h"
#include "sequences/costs_to_go.h"
#include "sequences/layer_plan.h"
#include "sequences/path_enumeration.h"
#include "sequences/sparse_layers.h"

namespace plat::sequences {
namespace {

constexpr double kBytesPerMb = 1e6;
/// So many arcs of a run are relaxed in the time of one arc that is followed alone.
constexpr std::uint64_t kRunSpeedup = 16;
/// A table with less work than this, in arcs, is filled at once.
constexpr std::uint64_t kLittleWork = 50'000;
/// Growing states may take one in so many of the table's arcs before the table is filled instead.
constexpr std::uint64_t kShareForGrowing = 16;
/// For more paths, states are grown until there are so many times as many.
constexpr std::uint64_t kStateGrowth = 4;

/// A table of costs-to-go of either width, with its plan.
class Table {
 public:
  virtual ~Table() = default;
  virtual void fill(InstructionSet set) = 0;
  [[nodiscard]] virtual const CompletionSpace& space() const = 0;
  [[nodiscard]] virtual std::uint64_t bytes_held() const = 0;
  [[nodiscard]] virtual std::uint64_t arcs_relaxed() const = 0;
};

template <class Value>
class TableOf final : public Table {
 public:
  TableOf(const SearchGraph& graph, const LayerPlan& plan)
      : graph_(graph), plan_(plan), values_(graph, plan), costs_(graph, plan, values_) {}
  void fill(InstructionSet set) override { arcs_ = fill_costs(graph_, plan_, set, values_); }
  [[nodiscard]] const CompletionSpace& space() const override { return costs_; }
  [[nodiscard]] std::uint64_t bytes_held() const override { return values_.size() * sizeof(Value); }
  [[nodiscard]] std::uint64_t arcs_relaxed() const override { return arcs_; }

 private:
  const SearchGraph& graph_;
  const LayerPlan& plan_;
  CostTable<Value> values_;
  CostsToGo<Value> costs_;
  std::uint64_t arcs_ = 0;
};

std::unique_ptr<Table> make_table(const SearchGraph& graph, const LayerPlan& plan) {
  if (path_cost_bound(graph, plan) < kInfinite<std::int32_t>)
    return std::make_unique<TableOf<std::int32_t>>(graph, plan);
  return std::make_unique<TableOf<std::int64_t>>(graph, plan);
}

/// How many arcs filling the table follows, those of runs at their speed.
std::uint64_t work(const SearchGraph& graph, const LayerPlan& plan) {
  std::uint64_t arcs = 0;
  for (std::size_t z = 0; z < graph.zones.size(); ++z) {
    if (!graph.zones[z].table) continue;
    const std::uint64_t own =
        plan.zones[z].reached_rows() * graph.tables[*graph.zones[z].table].arcs.size();
    arcs += plan.zones[z].run_dimension ? own / kRunSpeedup : own;
  }
  return arcs;
}

bool has_runs(const LayerPlan& plan) {
  return std::ranges::any_of(plan.zones, [](const ZoneLayers& z) { return !!z.run_dimension; });
}

class LayeredStream final : public SequenceStream {
 public:
  LayeredStream(const SearchGraph& graph, std::optional<LayerPlan> plan,
                const LayeredSearch::Options& options)
      : graph_(graph),
        options_(options),
        max_bytes_(static_cast<std::uint64_t>(options.max_memory_mb * kBytesPerMb)),
        plan_(std::move(plan)) {
    using Layers = LayeredSearch::Layers;
    const std::uint64_t arcs = plan_ ? work(graph, *plan_) : 0;
    if (plan_) max_arcs_ = arcs / kShareForGrowing;
    const bool is_worth_it = plan_ && !has_runs(*plan_) && arcs > kLittleWork;
    if (options.layers == Layers::kSparse || !plan_ ||
        (options.layers == Layers::kAuto && is_worth_it))
      sparse_ = std::make_unique<SparseLayers>(graph);
  }

  Expected<bool> next(SequencePath& path) override {
    while (true) {
      if (paths_) {
        const bool is_more = paths_->next(path);
        if (is_more && (!sparse_ || path.cost <= sparse_->limit())) return true;
        if (!sparse_ || sparse_->is_complete()) return false;
        given_ = sparse_->limit();
      }
      if (!prepare())
        return fail(FailureCode::kTooManyStates,
                    fmt::format("layered search holds {} states in {:.0f} MB; max_memory_mb is {}",
                                sparse_->states_created(),
                                static_cast<double>(sparse_->bytes_held()) / kBytesPerMb,
                                options_.max_memory_mb));
    }
  }

  [[nodiscard]] SearchStatistics statistics() const override {
    SearchStatistics statistics;
    if (sparse_) {
      statistics.states_created = sparse_->states_created();
      statistics.states_expanded = sparse_->states_expanded();
      statistics.arcs_relaxed = sparse_->arcs_followed();
      statistics.bytes_held = sparse_->bytes_held();
    } else if (plan_) {
      statistics.states_created = plan_->state_count;
      if (table_) {
        statistics.states_expanded = plan_->state_count;
        statistics.arcs_relaxed = table_->arcs_relaxed();
        statistics.bytes_held = table_->bytes_held();
      }
    }
    if (!paths_) return statistics;
    statistics.arcs_relaxed += paths_->steps_taken();
    statistics.bytes_held += paths_->bytes_held();
    return statistics;
  }

 private:
  /// Makes ready for the paths dearer than those given. False where that takes too much memory.
  bool prepare() {
    paths_.reset();
    PathEnumeration::Limits limits;
    limits.batch_paths = static_cast<std::size_t>(options_.batch_paths);
    if (sparse_) {
      const bool has_table = plan_ && options_.layers == LayeredSearch::Layers::kAuto;
      const bool is_grown =
          sparse_->grow(kStateGrowth * sparse_->states_expanded(), max_bytes_,
                        has_table ? max_arcs_ : std::numeric_limits<std::uint64_t>::max());
      if (is_grown) {
        sparse_->settle();
        paths_.emplace(*sparse_, limits, given_);
        return true;
      }
      if (!has_table) return false;
      sparse_.reset();
    }
    table_ = make_table(graph_, *plan_);
    table_->fill(options_.instructions);
    paths_.emplace(table_->space(), limits, given_);
    return true;
  }

  const SearchGraph& graph_;
  LayeredSearch::Options options_;
  std::uint64_t max_bytes_;
  std::uint64_t max_arcs_ = 0;  ///< that growing states may follow where a table is possible
  std::optional<LayerPlan> plan_;
  std::unique_ptr<SparseLayers> sparse_;
  std::unique_ptr<Table> table_;
  std::optional<PathEnumeration> paths_;
  std::optional<Cost> given_;  ///< all paths that cost no more have been given
};

}  // namespace

Expected<std::unique_ptr<SequenceStream>> LayeredSearch::search(const SearchGraph& graph) const {
  static_cast<void>(resolved(options_.instructions));
  std::optional<LayerPlan> plan;
  if (options_.layers != Layers::kSparse)
    plan = plan_layers(graph, static_cast<std::uint64_t>(options_.max_memory_mb * kBytesPerMb /
                                                         sizeof(std::int32_t)));
  if (!plan && options_.layers == Layers::kDense)
    return fail(FailureCode::kTooManyStates,
                fmt::format("the table of costs-to-go needs more than max_memory_mb = {}; use "
                            "layers=auto or coarser steps",
                            options_.max_memory_mb));
  return std::make_unique<LayeredStream>(graph, std::move(plan), options_);
}

}  // namespace plat::sequences
