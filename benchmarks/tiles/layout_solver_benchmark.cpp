// The layout solver on a made grid city: from scratch, and after dragging one of the held tiles.
#include <benchmark/benchmark.h>

#include "support/made_tile_city.h"
#include "tiles/layout_solver.h"

namespace plat::tiles {
namespace {

MadeCity city_of(int blocks) { return {.blocks_x = blocks, .blocks_y = blocks}; }

/// A tile in the middle is dragged; the first and the last block's stay.
std::vector<std::uint32_t> held_of(const MadeCity& city) {
  const auto tiles = static_cast<std::uint32_t>(city.tiles());
  return {0, tiles / 2, tiles - 1};
}

void report(benchmark::State& state, const TileGraph& graph) {
  state.counters["tiles"] = static_cast<double>(graph.tiles.size());
  state.counters["joints"] = static_cast<double>(graph.joints.size());
}

void factorise(benchmark::State& state) {
  const MadeCity city = city_of(static_cast<int>(state.range(0)));
  const TileGraph graph = graph_of(city);
  for (auto _ : state) {
    const auto solver = LayoutSolver::make(graph, held_of(city), {});
    const auto solution = solver->solve({{Affine{}, Affine::translation({20, 5}), Affine{}}});
    benchmark::DoNotOptimize(solution->objective);
  }
  report(state, graph);
}

void drag(benchmark::State& state) {
  const MadeCity city = city_of(static_cast<int>(state.range(0)));
  const TileGraph graph = graph_of(city);
  const auto solver = LayoutSolver::make(graph, held_of(city), {});
  double along_m = 0.0;
  for (auto _ : state) {
    along_m += 0.5;
    const auto solution = solver->solve({{Affine{}, Affine::translation({along_m, 0}), Affine{}}});
    benchmark::DoNotOptimize(solution->objective);
  }
  report(state, graph);
}

// 2,250 and 13,690 tiles.
BENCHMARK(factorise)->Arg(15)->Arg(37)->Unit(benchmark::kMillisecond);
BENCHMARK(drag)->Arg(15)->Arg(37)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plat::tiles
