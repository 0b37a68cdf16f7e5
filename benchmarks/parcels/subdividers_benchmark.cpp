// Time per parcel of the result, each registered strategy over a whole city, one thread.
#include <benchmark/benchmark.h>

#include <optional>

#include "core/parallel.h"
#include "harness/city.h"
#include "parcels/block_subdivider.h"
#include "support/data_folder.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

/// A block with the style that options are fitted to; none: the defaults are taken.
struct Job {
  blocks::Block block;
  std::optional<parcels::ParcelStyle> style;
};

const std::vector<Job>& cambridge() {
  static const std::vector<Job> kJobs = [] {
    std::vector<Job> out;
    if (!testing::data_file("cambridge_ma/cambridge_ma.gpkg")) return out;
    for (harness::ObservedBlock& observed :
         harness::load_city(geodata::dataset("cambridge_ma")).blocks) {
      const parcels::ParcelStyle style = parcels::style_of(observed.block, observed.parcels);
      out.push_back({std::move(observed.block), style});
    }
    return out;
  }();
  return kJobs;
}

const std::vector<Job>& synthetic() {
  static const std::vector<Job> kJobs = [] {
    std::vector<Job> out;
    Rng rng(1);
    for (Polygon& polygon : testing::synthetic_blocks(rng, 500)) {
      const BlockId id{static_cast<std::uint32_t>(out.size())};
      out.push_back({blocks::block_from_contour(id, std::move(polygon)), std::nullopt});
    }
    return out;
  }();
  return kJobs;
}

void divide(benchmark::State& state, const std::string& strategy, const std::vector<Job>& jobs) {
  if (jobs.empty())
    return state.SkipWithError("needs PLAT_DATA_DIR/cambridge_ma/cambridge_ma.gpkg");
  const parcels::AnyBlockSubdivider base = parcels::block_subdividers().make(strategy);
  std::vector<parcels::AnyBlockSubdivider> fitted;
  for (const Job& job : jobs) fitted.push_back(job.style ? base.fitted(*job.style) : base);
  std::size_t parcel_count = 0;
  std::size_t failure_count = 0;
  for (auto _ : state) {
    parcel_count = failure_count = 0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      Rng rng(derive_seed(1, {jobs[i].block.id.value}));
      const auto parcels = fitted[i].subdivide(jobs[i].block, rng);
      parcel_count += parcels ? parcels->size() : 0;
      failure_count += parcels ? 0 : 1;
    }
  }
  const auto count = static_cast<double>(parcel_count);
  state.counters["blocks"] = static_cast<double>(jobs.size());
  state.counters["parcels"] = count;
  state.counters["failures"] = static_cast<double>(failure_count);
  state.counters["per_parcel"] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Registered before main() runs, a benchmark for each strategy on the menu.
const bool kRegistered = [] {
  for (const std::string& name : parcels::block_subdividers().names()) {
    benchmark::RegisterBenchmark(("divide_cambridge/" + name).c_str(), [name](benchmark::State& s) {
      divide(s, name, cambridge());
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("divide_synthetic/" + name).c_str(), [name](benchmark::State& s) {
      divide(s, name, synthetic());
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace plat
