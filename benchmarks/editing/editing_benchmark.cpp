// CPU time of one-node edits on Cambridge's street network, one thread: contours, division,
// matching and all else that an edit does, over the number of blocks that it changed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <optional>

#include "editing/editor.h"
#include "harness/city.h"
#include "parcels/block_subdivider.h"
#include "statistics/quantile.h"
#include "support/data_folder.h"

namespace plat {
namespace {

const std::optional<harness::City>& cambridge() {
  static const std::optional<harness::City> kCity = []() -> std::optional<harness::City> {
    if (!testing::data_file("cambridge_ma/cambridge_ma.gpkg")) return std::nullopt;
    return harness::load_city(geodata::dataset("cambridge_ma"));
  }();
  return kCity;
}

/// Of this thread, seconds: a machine that is shared does not show.
double cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Moves random junctions by up to 5 m, each edit undone after it.
void move_nodes(benchmark::State& state, const std::string& strategy) {
  if (!cambridge()) return state.SkipWithError("needs PLAT_DATA_DIR/cambridge_ma");
  editing::CityOptions options;
  options.style.strategy = strategy;
  editing::City city = editing::make_city(cambridge()->network, options);
  std::vector<editing::NodeId> junctions;
  city.nodes().for_each([&](editing::NodeId id, const editing::CityNode& node) {
    if (node.around.size() > 2) junctions.push_back(id);
  });
  options.jobs.count = 1;
  editing::Editor editor(editing::with_options(std::move(city), options));
  Rng rng(1);
  std::vector<double> per_block_ms;
  std::vector<double> per_edit_ms;
  double blocks = 0.0;
  std::size_t refused = 0;
  for (auto _ : state) {
    const editing::NodeId node = junctions[rng.index(junctions.size())];
    const Point by{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
    const editing::MoveNode edit{node, editor.city().nodes().at(node).position + by, 0.0};
    const double start_s = cpu_time_s();
    const auto report = editor.apply(edit);
    const double time_s = cpu_time_s() - start_s;
    state.SetIterationTime(time_s);
    if (!report) {
      ++refused;
      continue;
    }
    editor.undo();
    if (report->changed.empty()) continue;
    const auto changed = static_cast<double>(report->changed.size());
    blocks += changed;
    per_edit_ms.push_back(1e3 * time_s);
    per_block_ms.push_back(1e3 * time_s / changed);
  }
  if (per_block_ms.empty()) return state.SkipWithError("no edit was applied");
  std::sort(per_block_ms.begin(), per_block_ms.end());
  std::sort(per_edit_ms.begin(), per_edit_ms.end());
  state.counters["block_ms_median"] = statistics::sorted_quantile(per_block_ms, 0.5);
  state.counters["block_ms_p99"] = statistics::sorted_quantile(per_block_ms, 0.99);
  state.counters["edit_ms_median"] = statistics::sorted_quantile(per_edit_ms, 0.5);
  state.counters["edit_ms_p99"] = statistics::sorted_quantile(per_edit_ms, 0.99);
  state.counters["blocks_per_edit"] = blocks / static_cast<double>(per_edit_ms.size());
  state.counters["refused"] = static_cast<double>(refused);
}

/// Registered before main() runs, a benchmark for each strategy on the menu.
const bool kRegistered = [] {
  for (const std::string& name : parcels::block_subdividers().names()) {
    benchmark::RegisterBenchmark(("move_node_cambridge/" + name).c_str(),
                                 [name](benchmark::State& s) { move_nodes(s, name); })
        ->UseManualTime()
        ->Iterations(3000)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace plat
