// How time and memory grow with the number of points from which streets are grown: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "growth_scaling/made_town.h"
#include "harness/build_info.h"
#include "harness/csv.h"
#include "harness/observed_streets.h"
#include "harness/power_law.h"
#include "harness/resource_use.h"
#include "streets/exemplar.h"
#include "streets/street_grower.h"

namespace plat::growth_scaling {
namespace {

using harness::Duration;

struct Arguments {
  std::vector<std::string> growers = streets::street_growers().names();
  std::vector<std::size_t> points{1'000, 3'000, 10'000, 30'000, 100'000};
  std::vector<std::string> cities{"cambridge_ma", "montevideo_uy"};
  int repetitions = 3;
  std::uint64_t seed = 1;
  std::filesystem::path out = "out/growth_scaling";
};

struct Row {
  std::string town;
  std::string grower;
  std::size_t points = 0;
  std::size_t streets = 0;
  std::size_t left_alone = 0;
  Duration time;  ///< of the repetition with the median processor time
  std::optional<double> peak_mb;
  std::string failure;
};

Row run_cell(const std::string& town, const streets::GrowthSite& site, const std::string& grower,
             const Arguments& args) {
  Row row;
  row.town = town;
  row.grower = grower;
  row.points = site.points.size();
  const auto strategy = streets::street_growers().make(grower);
  std::vector<Duration> times;
  for (int repetition = 0; repetition < args.repetitions; ++repetition) {
    harness::reset_peak_memory();
    Rng rng(derive_seed(args.seed, {seed_key(town), static_cast<std::uint64_t>(repetition)}));
    const harness::Stopwatch watch;
    const auto growth = strategy.grow(site, rng);
    times.push_back(watch.elapsed());
    row.peak_mb = harness::peak_memory_mb();
    if (!growth) {
      row.failure = growth.error().message;
      break;
    }
    row.streets = growth->segments.size();
    row.left_alone = growth->left_alone.size();
  }
  std::ranges::sort(times, {}, &Duration::cpu_s);
  row.time = times[times.size() / 2];
  fmt::print(
      "{:<16} {:<24} {:>7} points: {:>7} streets, {:>6} left alone, {:.3f} s (cpu {:.3f}), "
      "peak {:.0f} MB{}\n",
      row.town, row.grower, row.points, row.streets, row.left_alone, row.time.wall_s,
      row.time.cpu_s, row.peak_mb.value_or(0.0), row.failure);
  std::fflush(stdout);
  return row;
}

/// The exponents of processor time, and of it over n log n: at most 0 where growth is no worse.
void write_exponents(const std::vector<Row>& rows, const Arguments& args) {
  harness::CsvTable table(
      "town,strategy,sizes,exponent,exponent_low,exponent_high,over_n_log_n,over_n_log_n_low,"
      "over_n_log_n_high");
  const auto end_of = [](const auto& law, double statistics::Interval::* end) {
    return law->interval ? std::optional((*law->interval).*end) : std::nullopt;
  };
  for (const TownKind kind : {TownKind::kRegular, TownKind::kRandom}) {
    for (const std::string& grower : args.growers) {
      std::vector<harness::GrowthPoint> times;
      std::vector<harness::GrowthPoint> ratios;
      for (const Row& row : rows) {
        if (row.town != town_name(kind) || row.grower != grower || !row.failure.empty()) continue;
        const auto n = static_cast<double>(row.points);
        times.push_back({n, row.time.cpu_s});
        ratios.push_back({n, row.time.cpu_s / (n * std::log(n))});
      }
      const auto law = harness::fit_power_law(times);
      const auto over = harness::fit_power_law(ratios);
      if (!law || !over) continue;
      table.add_row(town_name(kind), grower, times.size(), law->exponent,
                    end_of(law, &statistics::Interval::low),
                    end_of(law, &statistics::Interval::high), over->exponent,
                    end_of(over, &statistics::Interval::low),
                    end_of(over, &statistics::Interval::high));
      fmt::print("{:<16} {:<24} processor time grows as n^{:.3f}, over n log n as n^{:.3f}\n",
                 town_name(kind), grower, law->exponent, over->exponent);
    }
  }
  write_file(args.out / "exponents.csv", table.text());
}

void run(const Arguments& args) {
  for (const std::string& grower : args.growers)
    static_cast<void>(streets::street_growers().at(grower));  // before anything is read
  std::filesystem::create_directories(args.out);
  std::vector<Row> rows;
  const auto grow_all = [&](const std::string& town, const streets::GrowthSite& site) {
    for (const std::string& grower : args.growers)
      rows.push_back(run_cell(town, site, grower, args));
  };
  for (const std::string& city : args.cities) {
    const auto observed = harness::load_streets(geodata::dataset(city));
    streets::GrowthSite site;
    site.points = streets::exemplar_of(observed.network, observed.parcels).points;
    grow_all(city, site);
  }
  for (const std::size_t points : args.points) {
    for (const TownKind kind : {TownKind::kRegular, TownKind::kRandom}) {
      streets::GrowthSite site;
      site.points = made_town(kind, points, args.seed);
      grow_all(std::string(town_name(kind)), site);
    }
  }
  harness::CsvTable table(
      "town,strategy,seed,points,streets,left_alone,grow_s,grow_cpu_s,peak_mb,failure");
  for (const Row& row : rows)
    table.add_row(row.town, row.grower, args.seed, row.points, row.streets, row.left_alone,
                  row.time.wall_s, row.time.cpu_s, row.peak_mb, row.failure);
  write_file(args.out / "scaling.csv", table.text());
  write_file(args.out / "build.json", harness::build_info().dump(2) + "\n");
  write_exponents(rows, args);
}

}  // namespace
}  // namespace plat::growth_scaling

int main(int argc, char** argv) {
  plat::growth_scaling::Arguments args;
  CLI::App app{
      "Grows streets from the points of real cities and of made towns, and measures time and "
      "memory.\n"
      "Example: growth_scaling --out out/growth_scaling"};
  app.add_option("--strategy", args.growers, "growers (default: all)");
  app.add_option("--points", args.points, "numbers of points of the made towns")->delimiter(',');
  app.add_option("--data", args.cities, "data sets with streets, or none: --data ''")
      ->delimiter(',');
  app.add_option("--repetitions", args.repetitions, "of each, with other streams")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--seed", args.seed, "random seed")->capture_default_str();
  app.add_option("--out", args.out, "folder to write")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::erase(args.cities, "");
  try {
    plat::growth_scaling::run(args);
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "growth_scaling: {}\n", error.what());
    return 2;
  }
  return 0;
}
