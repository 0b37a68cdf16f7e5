#include "sequences/cost_filling.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sequences/table_form.h"

namespace plat::sequences {
namespace {

template <class Value>
class Filler {
 public:
  Filler(const SearchGraph& graph, const LayerPlan& plan, InstructionSet set,
         CostTable<Value>& table)
      : graph_(graph),
        plan_(plan),
        set_(resolved(set)),
        table_(table),
        forms_(graph.tables.size()) {
    consumed_.resize(graph.dimension_count);
    nothing_.assign(kMaxWidth, kInfinite<Value>);
  }

  std::uint64_t fill() {
    for (std::size_t z = graph_.zones.size(); z-- > 0;) {
      const ZoneLayers& layers = plan_.zones[z];
      if (layers.row_count == 0) continue;
      const std::size_t end =
          z + 1 < graph_.zones.size() ? table_.place(z + 1).first : table_.size();
      Value* values = table_.at(z, 0, 0);
      std::fill(values, values + (end - table_.place(z).first), kInfinite<Value>);
      layers.run_dimension ? fill_runs(z) : fill_rows(z);
    }
    return arcs_relaxed_;
  }

 private:
  // ---- what all zones share ----

  [[nodiscard]] const TransitionTable& transitions(std::size_t zone) const {
    return graph_.tables[*graph_.zones[zone].table];
  }

  /// Calls `visit(local node, cost)`.
  template <class Visit>
  void for_exits(std::size_t zone, Visit visit) {
    const Zone& here = graph_.zones[zone];
    auto exit = std::ranges::lower_bound(graph_.exits, here.first_node, {}, &Terminal::node);
    for (; exit != graph_.exits.end() && exit->node < here.first_node + here.size; ++exit)
      visit(exit->node - here.first_node, static_cast<Value>(exit->cost));
  }

  void add_links(std::size_t zone, Row row) {
    const ZoneLayers& layers = plan_.zones[zone];
    if (!find_passages(zone)) return;
    const std::uint32_t first_node = graph_.zones[zone].first_node;
    for (std::uint32_t l = layers.first_link; l < layers.last_link; ++l) {
      const Value onwards = passages_[layers.target_of[l - layers.first_link]];
      if (onwards == kInfinite<Value>) continue;
      Value& value = *table_.at(zone, row, graph_.links[l].from - first_node);
      value =
          std::min(value, static_cast<Value>(static_cast<Value>(graph_.links[l].cost) + onwards));
    }
    arcs_relaxed_ += layers.last_link - layers.first_link;
  }

  /// What is beyond each target of the zone's links; false where there is nothing.
  bool find_passages(std::size_t zone) {
    const ZoneLayers& layers = plan_.zones[zone];
    passages_.assign(layers.targets.size(), kInfinite<Value>);
    bool is_open = false;
    bool is_carried = false;
    for (std::size_t t = 0; t < layers.targets.size(); ++t) {
      const std::uint32_t next = layers.target_zones[t];
      if (t == 0 || next != layers.target_zones[t - 1]) {
        carried_ = consumed_;
        is_carried = carry_over(graph_.zones[zone], graph_.zones[next], carried_);
      }
      if (!is_carried) continue;
      const Row row = plan_.zones[next].row_after(carried_, graph_.uses(layers.targets[t]));
      if (row == kNoRow) continue;
      passages_[t] = table_.value(next, row, layers.targets[t] - graph_.zones[next].first_node);
      is_open = is_open || passages_[t] < kInfinite<Value>;
    }
    return is_open;
  }

  const TableForm<Value>& form(std::uint32_t index) {
    if (!forms_[index]) forms_[index].emplace(graph_.tables[index]);
    return *forms_[index];
  }

  // ---- zones of runs: a block of layers at a time ----

  void fill_runs(std::size_t zone) {
    const ZoneLayers& layers = plan_.zones[zone];
    next_runs_.resize(layers.class_count);
    for (std::size_t r = layers.runs.size(); r-- > 0;) {
      const ZoneLayers::Run& run = layers.runs[r];
      if (run.is_empty()) continue;
      layers.amounts_of(r, consumed_);
      for (std::uint32_t c = 0; c < layers.class_count; ++c)
        next_runs_[c] = layers.run_after(consumed_, c);
      consumed_[*layers.run_dimension] += static_cast<Amount>(run.first);
      add_exits(zone, run);
      for (std::uint32_t k = 0; k <= run.last - run.first && !layers.targets.empty(); ++k) {
        add_links(zone, run.start + k);
        ++consumed_[*layers.run_dimension];
      }
      relax_run(zone, run);
    }
  }

  /// `consumed_`: at the first layer of the run. From the minimum on, a path may end in all others.
  void add_exits(std::size_t zone, const ZoneLayers::Run& run) {
    const std::uint32_t d = *plan_.zones[zone].run_dimension;
    const Amount first = consumed_[d];
    const Amount missing = std::max(graph_.zones[zone].bounds[d].min - first, 0);
    const auto layers = static_cast<std::int64_t>(run.last - run.first) + 1 - missing;
    consumed_[d] += missing;
    if (layers > 0 && may_end(graph_.zones[zone], consumed_))
      for_exits(zone, [&](std::size_t local, Value cost) {
        std::fill_n(table_.at(zone, run.start, local) + missing, layers, cost);
      });
    consumed_[d] = first;
  }

  void relax_run(std::size_t zone, const ZoneLayers::Run& run) {
    const ZoneLayers& layers = plan_.zones[zone];
    const TableForm<Value>& form = this->form(*graph_.zones[zone].table);
    const auto& kernels = min_plus_kernels<Value>(set_, static_cast<std::size_t>(layers.least_use));
    // Of a block wider than the least use, only the upper layers are complete: the next block
    // computes the others again, from what they have so far.
    const auto block = static_cast<std::ptrdiff_t>(
        std::min(kernels.width, static_cast<std::size_t>(layers.least_use)));
    const auto first = static_cast<std::ptrdiff_t>(run.first);
    const auto width = static_cast<std::ptrdiff_t>(kernels.width);
    const std::size_t tails = graph_.zones[zone].size;
    const std::size_t stride = table_.place(zone).node_stride;
    const auto& table = transitions(zone);
    for (std::ptrdiff_t top = run.last; top >= first; top -= block) {
      const std::ptrdiff_t offset = top + 1 - width;
      find_sources(zone, offset, width);
      Value* out = table_.at(zone, run.start, 0) + (offset - first);
      if (form.is_dense) {
        kernels.product(form.panels.data(), sources_.data(), tails, out, stride, tails);
        continue;
      }
      for (std::size_t tail = 0; tail < tails; ++tail)
        kernels.gather(form.costs.data() + table.first[tail],
                       form.source_of.data() + table.first[tail], sources_.data(),
                       table.first[tail + 1] - table.first[tail], out + tail * stride);
    }
    arcs_relaxed_ += (run.last - run.first + 1) * table.arcs.size();
  }

  /// Where the layers behind the block at `offset` begin, by head, or by arc.
  void find_sources(std::size_t zone, std::ptrdiff_t offset, std::ptrdiff_t width) {
    const ZoneLayers& layers = plan_.zones[zone];
    const TransitionTable& table = transitions(zone);
    const std::uint32_t d = *layers.run_dimension;
    const std::size_t stride = table_.place(zone).node_stride;
    const Value* values = table_.at(zone, 0, 0);
    behind_.assign(layers.class_count, kNowhere);
    for (std::uint32_t c = 0; c < layers.class_count; ++c) {
      if (!next_runs_[c]) continue;
      const ZoneLayers::Run& next = layers.runs[*next_runs_[c]];
      const std::ptrdiff_t behind = offset + layers.uses_of(c)[d];
      if (next.is_empty() || behind > next.last || behind + width <= next.first) continue;
      behind_[c] = static_cast<std::ptrdiff_t>(next.start) + behind - next.first;
    }
    const bool is_by_arc = !table.arc_uses.empty();
    sources_.resize(layers.class_of.size());
    for (std::size_t s = 0; s < layers.class_of.size(); ++s) {
      const std::ptrdiff_t behind = behind_[layers.class_of[s]];
      const std::size_t head = is_by_arc ? table.arcs[s].head : s;
      sources_[s] = behind == kNowhere ? nothing_.data() : values + head * stride + behind;
    }
  }

  // ---- other zones: one row at a time ----

  void fill_rows(std::size_t zone) {
    const ZoneLayers& layers = plan_.zones[zone];
    next_rows_.resize(layers.class_count);
    for (Row row = layers.row_count; row-- > 0;) {
      layers.consumed(row, consumed_);
      if (may_end(graph_.zones[zone], consumed_))
        for_exits(zone,
                  [&](std::size_t local, Value cost) { *table_.at(zone, row, local) = cost; });
      add_links(zone, row);
      if (!graph_.zones[zone].table) continue;
      for (std::uint32_t c = 0; c < layers.class_count; ++c)
        next_rows_[c] = layers.row_after(consumed_, layers.uses_of(c));
      relax_row(zone, row);
      settle_row(zone, row);
    }
  }

  void relax_row(std::size_t zone, Row row) {
    const ZoneLayers& layers = plan_.zones[zone];
    const TransitionTable& table = transitions(zone);
    const TableForm<Value>& form = this->form(*graph_.zones[zone].table);
    const bool is_by_arc = !table.arc_uses.empty();
    arcs_relaxed_ += table.arcs.size();
    heads_.clear();
    addends_.assign(form.is_dense ? 0 : layers.class_of.size(), kInfinite<Value>);
    for (std::uint32_t s = 0; s < layers.class_of.size(); ++s) {
      const Row next = next_rows_[layers.class_of[s]];
      if (next == kNoRow || next == row) continue;
      const Value onwards = table_.value(zone, next, is_by_arc ? table.arcs[s].head : s);
      if (onwards == kInfinite<Value>) continue;
      heads_.push_back(s);
      form.is_dense ? addends_.push_back(onwards) : static_cast<void>(addends_[s] = onwards);
    }
    if (heads_.empty()) return;
    Value* values = table_.at(zone, row, 0);
    if (form.is_dense) {
      min_plus_kernels<Value>(set_, kMaxWidth)
          .row(form.columns.data(), table_.place(zone).row_stride, heads_.data(), addends_.data(),
               heads_.size(), values);
      return;
    }
    for (std::uint32_t tail = 0; tail < table.node_count(); ++tail) {
      Value least = values[tail];
      for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a)
        least = std::min<Value>(least, form.costs[a] + addends_[form.source_of[a]]);
      values[tail] = least;
    }
  }

  /// Arcs that consume nothing that is told apart stay in their row, where they may form circles:
  /// Dijkstra's algorithm over the nodes of the row, from what the other rows gave them.
  void settle_row(std::size_t zone, Row row) {
    if (std::ranges::find(next_rows_, row) == next_rows_.end()) return;
    const ZoneLayers& layers = plan_.zones[zone];
    const bool is_by_arc = !transitions(zone).arc_uses.empty();
    const TableForm<Value>& form = this->form(*graph_.zones[zone].table);
    const auto stays = [&](std::uint32_t arc, std::uint32_t head) {
      return next_rows_[layers.class_of[is_by_arc ? arc : head]] == row;
    };
    Value* values = table_.at(zone, row, 0);
    const auto order = std::greater<std::pair<Value, std::uint32_t>>{};
    heap_.clear();
    for (std::uint32_t node = 0; node < graph_.zones[zone].size; ++node)
      if (values[node] < kInfinite<Value> && (is_by_arc || stays(0, node)))
        heap_.emplace_back(values[node], node);
    std::ranges::make_heap(heap_, order);
    while (!heap_.empty()) {
      std::ranges::pop_heap(heap_, order);
      const auto [value, head] = heap_.back();
      heap_.pop_back();
      if (value > values[head]) continue;
      for (std::uint32_t k = form.first_in[head]; k < form.first_in[head + 1]; ++k) {
        const std::uint32_t tail = form.tail_in[k];
        if (!stays(form.arc_in[k], head)) continue;
        const auto sum = static_cast<Value>(form.costs[form.arc_in[k]] + value);
        if (sum >= values[tail]) continue;
        values[tail] = sum;
        if (!is_by_arc && !stays(0, tail)) continue;
        heap_.emplace_back(sum, tail);
        std::ranges::push_heap(heap_, order);
      }
    }
  }

  static constexpr std::ptrdiff_t kNowhere = std::numeric_limits<std::ptrdiff_t>::max();
  const SearchGraph& graph_;
  const LayerPlan& plan_;
  InstructionSet set_;
  CostTable<Value>& table_;
  std::vector<std::optional<TableForm<Value>>> forms_;
  std::uint64_t arcs_relaxed_ = 0;
  // Scratch, used again from row to row:
  std::vector<Amount> consumed_;
  std::vector<Amount> carried_;
  std::vector<Value> passages_;                        ///< by link target: its cost-to-go
  std::vector<Row> next_rows_;                         ///< by class
  std::vector<std::optional<std::size_t>> next_runs_;  ///< by class
  std::vector<std::ptrdiff_t> behind_;                 ///< by class: row, or kNowhere
  std::vector<const Value*> sources_;                  ///< by head, or by arc
  std::vector<Value> nothing_;                         ///< a block without a path
  std::vector<std::uint32_t> heads_;
  std::vector<Value> addends_;
  std::vector<std::pair<Value, std::uint32_t>> heap_;
};

}  // namespace

template <class Value>
std::uint64_t fill_costs(const SearchGraph& graph, const LayerPlan& plan, InstructionSet set,
                         CostTable<Value>& table) {
  return Filler<Value>(graph, plan, set, table).fill();
}

template std::uint64_t fill_costs(const SearchGraph&, const LayerPlan&, InstructionSet,
                                  CostTable<std::int32_t>&);
template std::uint64_t fill_costs(const SearchGraph&, const LayerPlan&, InstructionSet,
                                  CostTable<std::int64_t>&);

}  // namespace plat::sequences
