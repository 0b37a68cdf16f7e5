// Compiling structures, and finding the best arrangement: the most complex structure of
// [Har, Fig. 6.6] is a closed loop with a T on it and a T on the T's branch.
#include <benchmark/benchmark.h>

#include "core/rng.h"
#include "sequences/compiled_problem.h"
#include "sequences/sequence_search.h"

namespace plat::sequences {
namespace {

constexpr ElementIndex kFilling = 60;
constexpr ElementIndex kPerClass = 6;
constexpr Amount kSegmentLength = 150;  // 30 m in quanta of 0.2 m

/// Filling elements of 1 to 5 m; corners, ends and T with arms of 1 m; whoever may touch does so at
/// a random cost.
SequenceDatabase database() {
  Rng rng(20);
  SequenceDatabase out;
  out.resources = {{"length_m", 0.2}, {"balconies", 1.0}};
  for (ElementIndex e = 0; e < kFilling; ++e)
    out.elements.push_back(
        {.name = "middle",
         .uses = {static_cast<Amount>(5 + rng.index(21)), static_cast<Amount>(rng.index(2))}});
  for (ElementIndex e = 0; e < 3 * kPerClass; ++e)
    out.elements.push_back(
        {.name = "key", .uses = {10, 0}, .arms = {{5, 0}, {5, 0}, {5, 0}}, .is_filling = false});
  const auto touch = [&](ElementIndex a, Port at_a, ElementIndex b, Port at_b) {
    if (rng.uniform_01() < 0.5)
      out.transitions.push_back({a, b, at_a, at_b, static_cast<Cost>(rng.index(10'000)), {}});
  };
  for (ElementIndex a = 0; a < out.elements.size(); ++a) {
    for (ElementIndex b = 0; b < kFilling; ++b) {
      touch(a, Port::kRight, b, Port::kLeft);
      if (a >= kFilling) touch(a, Port::kLeft, b, Port::kRight);
      if (a >= kFilling) touch(a, Port::kStem, b, Port::kLeft);
      if (a >= kFilling) touch(a, Port::kStem, b, Port::kRight);
    }
  }
  return out;
}

std::vector<ElementIndex> element_class(ElementIndex index) {
  std::vector<ElementIndex> elements;
  for (ElementIndex e = 0; e < kPerClass; ++e) elements.push_back(kFilling + index * kPerClass + e);
  return elements;
}

/// A loop of four corners and a T, from whose stem a binary tree of T hangs.
struct LoopWithTree {
  SequenceProblem problem{database(), {}, {}};
  bool has_balconies;

  std::uint32_t add_key_point(std::uint32_t class_index) {
    problem.structure.key_points.push_back({"", element_class(class_index)});
    return static_cast<std::uint32_t>(problem.structure.key_points.size()) - 1;
  }
  void join(std::uint32_t from, Port at_from, std::uint32_t to) {
    Segment segment;
    segment.from = from;
    segment.from_port = at_from;
    segment.to = to;
    segment.bounds = {{kSegmentLength, kSegmentLength}};
    if (has_balconies) segment.bounds.push_back({3, 3});
    problem.structure.segments.push_back(segment);
  }
  /// `depth` T one behind the other, and ends.
  void hang_tree(std::uint32_t from, Port at_from, std::int64_t depth) {
    const std::uint32_t to = add_key_point(depth > 0 ? 1 : 2);
    join(from, at_from, to);
    if (depth == 0) return;
    hang_tree(to, Port::kRight, depth - 1);
    hang_tree(to, Port::kStem, depth - 1);
  }
};

SequenceProblem loop_with_nested_ts(std::int64_t depth, bool has_balconies) {
  LoopWithTree made{.has_balconies = has_balconies};
  for (const std::uint32_t class_index : {0U, 0U, 0U, 0U, 1U}) made.add_key_point(class_index);
  for (std::uint32_t k = 0; k < 5; ++k) made.join(k, Port::kRight, (k + 1) % 5);
  made.hang_tree(4, Port::kStem, depth);
  return std::move(made.problem);
}

void compile_structure(benchmark::State& state) {
  const auto problem = loop_with_nested_ts(state.range(0), state.range(1) != 0);
  for (auto _ : state) {
    const auto compiled = compile(problem);
    const SearchGraph& graph = compiled.graph;
    state.counters["nodes"] = static_cast<double>(graph.node_count());
    state.counters["links"] = static_cast<double>(graph.links.size());
    state.counters["zones"] = static_cast<double>(graph.zones.size());
    std::size_t bytes = graph.links.size() * (sizeof(Link) + sizeof(std::uint32_t)) +
                        graph.node_uses.size() * sizeof(Amount) +
                        compiled.placements.size() * sizeof(compiled.placements.front());
    for (const auto& table : graph.tables)
      bytes += table.arcs.size() * sizeof(TransitionTable::Arc);
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
  }
}
BENCHMARK(compile_structure)->ArgsProduct({{1, 2}, {0, 1}})->Unit(benchmark::kMillisecond);

void find_best_arrangement(benchmark::State& state) {
  const auto problem = loop_with_nested_ts(state.range(0), state.range(1) != 0);
  const auto strategy = sequence_searches().make("layered");
  for (auto _ : state) {
    const auto compiled = compile(problem);
    const auto stream = strategy.search(compiled.graph);
    if (!stream) return state.SkipWithError(stream.error().message.c_str());
    const auto paths = find_paths(**stream, 1);
    if (!paths || paths->empty()) return state.SkipWithError("no arrangement");
    benchmark::DoNotOptimize(paths->front().cost);
    state.counters["cost"] = static_cast<double>(paths->front().cost);
    state.counters["MB"] = static_cast<double>((*stream)->statistics().bytes_held) / 1e6;
  }
}
BENCHMARK(find_best_arrangement)->ArgsProduct({{1, 2}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plat::sequences
