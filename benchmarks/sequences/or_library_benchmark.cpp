// OR-Library's 24 resource constrained shortest path problems [BC89], k = 1, building included: the
// sum of the instances' medians, for every registered search and the variants of two. Instances
// that a search gives up, or takes too long over, are counted and left out.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rcksp_scaling/search_run.h"
#include "sequences/compiled_problem.h"
#include "sequences/or_library.h"
#include "sequences/sequence_search.h"
#include "statistics/quantile.h"
#include "support/data_folder.h"

namespace plat {
namespace {

constexpr int kRounds = 9;
constexpr int kFewRounds = 3;  ///< of what takes seconds
constexpr rcksp::RunLimits kLimits{.time_s = 20.0, .memory_mb = 6000.0};

struct Instance {
  sequences::SearchGraph graph;
  std::optional<sequences::Cost> optimum;
};

/// All instances, none where the data are not there.
const std::vector<Instance>& instances() {
  static const std::vector<Instance> kAll = [] {
    std::vector<Instance> out;
    const auto results = testing::data_file("rcsp_or_library/results.txt");
    if (!results) return out;
    const auto folder = std::filesystem::path(*results).parent_path();
    for (const auto& optimum : sequences::read_or_library_optima(*results)) {
      const auto file = folder / fmt::format("rcsp{}.txt", optimum.instance);
      out.push_back({compile(sequences::read_or_library(file)).graph, optimum.cost});
    }
    return out;
  }();
  return kAll;
}

/// Whether the search solves the instance within the limits.
bool solves(const sequences::AnySequenceSearch& search, const Instance& instance) {
  const auto run = rcksp::run_guarded(search, instance.graph, 1, kLimits);
  if (run.status != rcksp::RunStatus::kOk) return false;
  return instance.optimum ? run.found == 1 && run.first_cost == *instance.optimum : run.found == 0;
}

void solve_all(benchmark::State& state, const std::string& name, const OptionMap& options) {
  if (instances().empty()) return state.SkipWithError("needs PLAT_DATA_DIR/rcsp_or_library");
  const auto search = sequences::sequence_searches().make(name, options);
  std::vector<const Instance*> solved;
  for (const Instance& instance : instances())
    if (solves(search, instance)) solved.push_back(&instance);
  std::vector<std::vector<double>> wall_ms(solved.size());
  std::vector<std::vector<double>> cpu_ms(solved.size());
  std::uint64_t expanded = 0;
  for (auto _ : state) {
    expanded = 0;
    for (std::size_t i = 0; i < solved.size(); ++i) {
      const auto run = rcksp::run_search(search, solved[i]->graph, 1);
      wall_ms[i].push_back(1e3 * run.total().wall_s);
      cpu_ms[i].push_back(1e3 * run.total().cpu_s);
      expanded += run.statistics.states_expanded;
    }
  }
  const auto sum_of_medians = [](std::vector<std::vector<double>>& times) {
    double sum = 0.0;
    for (auto& of_instance : times) {
      std::sort(of_instance.begin(), of_instance.end());
      sum += statistics::sorted_quantile(of_instance, 0.5);
    }
    return sum;
  };
  state.counters["sum_of_medians_ms"] = sum_of_medians(wall_ms);
  state.counters["cpu_sum_of_medians_ms"] = sum_of_medians(cpu_ms);
  state.counters["solved"] = static_cast<double>(solved.size());
  state.counters["expanded"] = static_cast<double>(expanded);
}

void add(const std::string& title, const std::string& name, const OptionMap& options,
         int rounds = kRounds) {
  benchmark::RegisterBenchmark(
      ("or_library/" + title).c_str(),
      [name, options](benchmark::State& state) { solve_all(state, name, options); })
      ->Iterations(rounds)
      ->Unit(benchmark::kMillisecond);
}

/// Registered before main() runs.
const bool kRegistered = [] {
  for (const std::string& name : sequences::sequence_searches().names()) add(name, name, {});
  add("forward[none]", "forward", {{"dominance", "none"}});
  add("forward[bounds]", "forward", {{"dominance", "bounds"}});
  add("intermediate_graph[resources_and_cost]", "intermediate_graph",
      {{"bounding", "resources_and_cost"}});
  add("label_setting[none]", "label_setting",
      {{"pruning", "none"}, {"max_labels", 1e8}, {"max_comparisons_million", 1e6}}, kFewRounds);
  return true;
}();

}  // namespace
}  // namespace plat
