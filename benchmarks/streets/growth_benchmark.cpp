// Every registered grower on made towns and on the points of real cities. For exponents and memory
// there is experiments/growth_scaling.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "growth_scaling/made_town.h"
#include "harness/observed_streets.h"
#include "streets/exemplar.h"
#include "streets/street_grower.h"
#include "support/data_folder.h"

namespace plat {
namespace {

using growth_scaling::TownKind;

void grow(benchmark::State& state, const std::string& grower, const streets::GrowthSite& site) {
  if (site.points.empty()) return state.SkipWithError("needs PLAT_DATA_DIR");
  const auto strategy = streets::street_growers().make(grower);
  std::size_t streets = 0;
  for (auto _ : state) {
    Rng rng(1);
    const auto growth = strategy.grow(site, rng);
    streets = growth ? growth->segments.size() : 0;
  }
  const auto points = static_cast<double>(site.points.size());
  state.counters["points"] = points;
  state.counters["streets"] = static_cast<double>(streets);
  state.counters["per_point"] = benchmark::Counter(
      points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The intersection points of an observed city, without its streets; none where it is not here.
streets::GrowthSite points_of(const std::string& dataset, const std::string& file) {
  streets::GrowthSite site;
  if (!plat::testing::data_file(file)) return site;
  const auto observed = harness::load_streets(geodata::dataset(dataset));
  site.points = streets::exemplar_of(observed.network, observed.parcels).points;
  return site;
}

void grow_town(benchmark::State& state, const std::string& grower, TownKind kind) {
  streets::GrowthSite site;
  site.points = growth_scaling::made_town(kind, static_cast<std::size_t>(state.range(0)), 1);
  grow(state, grower, site);
}

/// Registered before main() runs, benchmarks for each strategy on the menu.
const bool kRegistered = [] {
  for (const std::string& name : streets::street_growers().names()) {
    for (const TownKind kind : {TownKind::kRegular, TownKind::kRandom}) {
      benchmark::RegisterBenchmark(
          fmt::format("grow_{}_town/{}", growth_scaling::town_name(kind), name).c_str(),
          [name, kind](benchmark::State& state) { grow_town(state, name, kind); })
          ->RangeMultiplier(10)
          ->Range(1'000, 100'000)
          ->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark(("grow_cambridge/" + name).c_str(), [name](benchmark::State& s) {
      static const auto kSite = points_of("cambridge_ma", "cambridge_ma/cambridge_ma.gpkg");
      grow(s, name, kSite);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("grow_montevideo/" + name).c_str(), [name](benchmark::State& s) {
      static const auto kSite = points_of("montevideo_uy", "montevideo_uy/montevideo_osm.gpkg");
      grow(s, name, kSite);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace plat
