#include "sequences/table_form.h"

#include <algorithm>

namespace plat::sequences {
namespace {

/// From one in so many of all pairs on, a table is relaxed as a full matrix.
constexpr std::uint64_t kDensePairs = 3;

template <class Value>
void make_matrices(const TransitionTable& table, TableForm<Value>& form) {
  const std::size_t nodes = table.node_count();
  const std::size_t stride = (nodes + kRowMultiple - 1) / kRowMultiple * kRowMultiple;
  const std::size_t panels = (nodes + kPanelTails - 1) / kPanelTails;
  form.panels.assign(panels * kPanelTails * nodes, kInfinite<Value>);
  form.columns.assign(stride * nodes, kInfinite<Value>);
  for (std::size_t tail = 0; tail < nodes; ++tail) {
    for (std::size_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
      const std::size_t head = table.arcs[a].head;
      Value& in_column = form.columns[head * stride + tail];
      in_column = std::min(in_column, static_cast<Value>(table.arcs[a].cost));
      form.panels[(tail / kPanelTails * nodes + head) * kPanelTails + tail % kPanelTails] =
          in_column;
    }
  }
}

template <class Value>
void reverse(const TransitionTable& table, TableForm<Value>& form) {
  form.first_in.assign(table.node_count() + 1, 0);
  for (const auto& arc : table.arcs) ++form.first_in[arc.head + 1];
  for (std::size_t n = 0; n < table.node_count(); ++n) form.first_in[n + 1] += form.first_in[n];
  form.arc_in.resize(table.arcs.size());
  form.tail_in.resize(table.arcs.size());
  std::vector<std::uint32_t> next = form.first_in;
  for (std::uint32_t tail = 0; tail < table.node_count(); ++tail) {
    for (std::uint32_t a = table.first[tail]; a < table.first[tail + 1]; ++a) {
      const std::uint32_t place = next[table.arcs[a].head]++;
      form.arc_in[place] = a;
      form.tail_in[place] = tail;
    }
  }
}

}  // namespace

template <class Value>
TableForm<Value>::TableForm(const TransitionTable& table) {
  const std::uint64_t nodes = table.node_count();
  is_dense = table.arc_uses.empty() && nodes >= kPanelTails &&
             table.arcs.size() * kDensePairs >= nodes * nodes;
  for (std::uint32_t a = 0; a < table.arcs.size(); ++a) {
    costs.push_back(static_cast<Value>(table.arcs[a].cost));
    source_of.push_back(table.arc_uses.empty() ? table.arcs[a].head : a);
  }
  if (is_dense) make_matrices(table, *this);
  reverse(table, *this);
}

template struct TableForm<std::int32_t>;
template struct TableForm<std::int64_t>;

}  // namespace plat::sequences
