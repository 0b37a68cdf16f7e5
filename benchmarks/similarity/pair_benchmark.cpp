// Time to prepare a shape and time per pair, each registered strategy on the same real parcels and
// blocks, one thread. Counters: seconds per shape or pair.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "similarity/shape_similarity.h"
#include "support/real_shapes.h"

namespace plat {
namespace {

using Shapes = std::vector<similarity::LabelledShape>;

constexpr std::size_t kShapes = 100;

const testing::RealShapes& cambridge() {
  static const testing::RealShapes kAll = testing::real_shapes("cambridge_ma", kShapes);
  return kAll;
}

void count(benchmark::State& state, std::size_t each, const char* name) {
  state.counters[name] =
      benchmark::Counter(static_cast<double>(each), benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}

void prepare(benchmark::State& state, const std::string& strategy, const Shapes& shapes) {
  if (shapes.empty())
    return state.SkipWithError("needs PLAT_DATA_DIR/cambridge_ma/cambridge_ma.gpkg");
  const similarity::AnyShapeSimilarity measure = similarity::shape_similarities().make(strategy);
  std::size_t failures = 0;
  for (auto _ : state) {
    failures = 0;
    for (const similarity::LabelledShape& shape : shapes)
      failures += measure.prepare(shape) ? 0 : 1;
  }
  state.counters["failures"] = static_cast<double>(failures);
  count(state, shapes.size(), "per_shape");
}

void compare(benchmark::State& state, const std::string& strategy, const Shapes& shapes) {
  if (shapes.empty())
    return state.SkipWithError("needs PLAT_DATA_DIR/cambridge_ma/cambridge_ma.gpkg");
  const similarity::AnyShapeSimilarity measure = similarity::shape_similarities().make(strategy);
  std::vector<similarity::AnyPreparedShape> prepared;
  for (const similarity::LabelledShape& shape : shapes)
    if (auto one = measure.prepare(shape)) prepared.push_back(*std::move(one));
  double sum = 0.0;
  for (auto _ : state)
    for (const auto& a : prepared)
      for (const auto& b : prepared) sum += measure.distance(a, b);
  benchmark::DoNotOptimize(sum);
  state.counters["shapes"] = static_cast<double>(prepared.size());
  count(state, prepared.size() * prepared.size(), "per_pair");
}

void add(const std::string& what, const std::string& strategy, const Shapes& (*shapes)()) {
  benchmark::RegisterBenchmark(("prepare_" + what + "/" + strategy).c_str(),
                               [=](benchmark::State& s) { prepare(s, strategy, shapes()); })
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("pair_of_" + what + "/" + strategy).c_str(),
                               [=](benchmark::State& s) { compare(s, strategy, shapes()); })
      ->Unit(benchmark::kMillisecond);
}

/// Registered before main() runs, benchmarks for each strategy on the menu.
const bool kRegistered = [] {
  for (const std::string& name : similarity::shape_similarities().names()) {
    add("parcels", name, +[]() -> const Shapes& { return cambridge().parcels; });
    add("blocks", name, +[]() -> const Shapes& { return cambridge().blocks; });
  }
  return true;
}();

}  // namespace
}  // namespace plat
