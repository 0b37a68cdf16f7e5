// Every registered search over a street's length, k and the number of bounded resources; each on
// its own, repeated as often as Google Benchmark likes. For pairs, ratios and limits of time and
// memory there is experiments/rcksp_scaling.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "rcksp_scaling/scaling_experiment.h"
#include "sequences/compiled_problem.h"
#include "sequences/sequence_search.h"

namespace plat {
namespace {

using rcksp::CellOptions;

constexpr std::uint64_t kSeed = 1;

/// Of a search that takes longer, or more memory, nothing is measured.
constexpr rcksp::RunLimits kLimits{.time_s = 5.0, .memory_mb = 6000.0};

void search(benchmark::State& state, const std::string& strategy, const CellOptions& options,
            rcksp::RunStatus& status) {
  const auto problem = compile(rcksp::cell_problem(options, kSeed));
  const auto search = sequences::sequence_searches().make(strategy);
  const auto k = static_cast<std::uint64_t>(options.k);
  // Google Benchmark calls this several times; who does not finish is told once.
  if (status == rcksp::RunStatus::kNotTried)
    status = rcksp::run_guarded(search, problem.graph, k, kLimits).status;
  if (status != rcksp::RunStatus::kOk)
    return state.SkipWithError(std::string(status_name(status)).c_str());
  rcksp::SearchRun run;
  for (auto _ : state) run = rcksp::run_search(search, problem.graph, k);
  state.counters["found"] = static_cast<double>(run.found);
  state.counters["states"] = static_cast<double>(run.statistics.states_created);
  state.counters["expanded"] = static_cast<double>(run.statistics.states_expanded);
  state.counters["held_mb"] = static_cast<double>(run.statistics.bytes_held) / 1e6;
  state.counters["build_s"] = run.build.wall_s;
}

std::vector<CellOptions> problems() {
  std::vector<CellOptions> out;
  for (const double length_m : {50.0, 200.0, 2000.0}) out.push_back({.length_m = length_m});
  for (const int k : {10, 1000}) out.push_back({.length_m = 50.0, .k = k});
  for (const int resources : {1, 2, 3})
    out.push_back({.elements = 20, .resources = resources, .length_m = 40.0});
  return out;
}

/// Registered before main() runs, a benchmark for each strategy on the menu.
const bool kRegistered = [] {
  for (const CellOptions& options : problems()) {
    for (const std::string& name : sequences::sequence_searches().names()) {
      const std::string title =
          fmt::format("search/{}_m/{}_elements/{}_resources/k_{}/{}", options.length_m,
                      options.elements, options.resources, options.k, name);
      benchmark::RegisterBenchmark(title.c_str(), [name, options,
                                                   status = rcksp::RunStatus::kNotTried](
                                                      benchmark::State& s) mutable {
        search(s, name, options, status);
      })->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace plat
