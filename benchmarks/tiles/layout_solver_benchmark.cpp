// The layout solver from scratch, and after dragging one of the held tiles: on made grid cities and
// on parcels of Cambridge.
#include <benchmark/benchmark.h>

#include <map>
#include <optional>

#include "harness/observed_tiles.h"
#include "support/data_folder.h"
#include "support/made_tile_city.h"
#include "tiles/layout_solver.h"

namespace plat::tiles {
namespace {

/// A layout and three tiles of it: the one in the middle is dragged.
struct Case {
  TileGraph graph;
  std::vector<std::uint32_t> held;
};

Case made(int blocks) {
  Case out{graph_of(MadeCity{.blocks_x = blocks, .blocks_y = blocks}), {}};
  const auto tiles = static_cast<std::uint32_t>(out.graph.tiles.size());
  out.held = {0, tiles / 2, tiles - 1};
  return out;
}

/// Parcels of Cambridge, as many as asked for, one in 50 of them held.
Case cambridge(std::size_t count) {
  Case out;
  if (!testing::data_file("cambridge_ma/cambridge_ma.gpkg")) return out;
  const harness::ObservedTiles observed =
      harness::load_tiles(geodata::dataset("cambridge_ma"), {count, std::nullopt});
  out.graph = graph_of(observed.tiles.layout);
  for (std::uint32_t i = 0; i < out.graph.tiles.size(); i += 50) out.held.push_back(i);
  return out;
}

/// The targets with one tile dragged.
std::vector<Affine> targets_of(const Case& layout, double along_m) {
  std::vector<Affine> out(layout.held.size());
  out[out.size() / 2] = Affine::translation({along_m, 0.4 * along_m});
  return out;
}

/// Set up once for all runs of a benchmark.
const Case& case_of(int kind) {
  static std::map<int, Case> cases;
  const auto [it, is_new] = cases.try_emplace(kind);
  if (is_new) it->second = kind < 100 ? made(kind) : cambridge(static_cast<std::size_t>(kind));
  return it->second;
}

bool prepared(benchmark::State& state, const Case& layout) {
  if (layout.held.empty()) {
    state.SkipWithError("needs PLAT_DATA_DIR/cambridge_ma");
    return false;
  }
  state.counters["tiles"] = static_cast<double>(layout.graph.tiles.size());
  state.counters["joints"] = static_cast<double>(layout.graph.joints.size());
  return true;
}

SolverOptions options_of(const benchmark::State& state) {
  return {.keep_size = static_cast<double>(state.range(1))};
}

void from_scratch(benchmark::State& state) {
  const Case& layout = case_of(static_cast<int>(state.range(0)));
  if (!prepared(state, layout)) return;
  for (auto _ : state) {
    const auto solver = LayoutSolver::make(layout.graph, layout.held, options_of(state));
    const auto solution = solver->solve(targets_of(layout, 20.0));
    benchmark::DoNotOptimize(solution->objective);
  }
}

void drag(benchmark::State& state) {
  const Case& layout = case_of(static_cast<int>(state.range(0)));
  if (!prepared(state, layout)) return;
  const auto solver = LayoutSolver::make(layout.graph, layout.held, options_of(state));
  double along_m = 0.0;
  for (auto _ : state) {
    along_m += 0.5;
    const auto solution = solver->solve(targets_of(layout, along_m));
    benchmark::DoNotOptimize(solution->objective);
  }
}

// Made grids of 15 x 15 and 37 x 37 blocks of 10 tiles, and so many parcels of Cambridge; the
// second argument is keep_size.
void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int layout : {15, 37, 2000, 13103}) {
    for (const int keep_size : {0, 1}) benchmark->Args({layout, keep_size});
  }
  benchmark->Unit(benchmark::kMillisecond)->ArgNames({"layout", "keep_size"});
}
BENCHMARK(from_scratch)->Apply(sizes);
BENCHMARK(drag)->Apply(sizes);

}  // namespace
}  // namespace plat::tiles
