// Every strategy on thousands of random blocks and on the blocks of observed cities: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "parcels/block_subdivider.h"
#include "stress/stress_set.h"
#include "support/property.h"

namespace plat::stress {
namespace {

struct Arguments {
  std::uint32_t blocks = 400;
  std::uint64_t seed = 1;
  std::vector<std::string> strategies;
  std::vector<std::string> cities;
  double slow_ms = 2000.0;
  double hang_s = 120.0;
  double failure_bound = 0.001;
  Jobs jobs;
  std::string incidents_file;
};

std::string codes_of(const StressResult& result) {
  std::string out;
  for (const auto& [code, count] : result.failures)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, code);
  return out.empty() ? "-" : out;
}

void print_header() {
  fmt::print("{:<18} {:<15} {:>7} {:>8} {:>9} {:>10} {:>11} {:>8} {:>8}  {}\n", "set", "strategy",
             "blocks", "divided", "parcels", "> 200 m2", "failed [%]", "slowest", "total",
             "failures");
}

void print_row(const StressResult& r) {
  const double share =
      r.large == 0 ? 0.0
                   : 100.0 * static_cast<double>(r.large_failed) / static_cast<double>(r.large);
  fmt::print("{:<18} {:<15} {:>7} {:>8} {:>9} {:>10} {:>11.3f} {:>5.0f} ms {:>6.1f} s  {}\n", r.set,
             r.strategy, r.blocks, r.divided, r.parcels, r.large, share, r.slowest_ms, r.total_s,
             codes_of(r));
  std::fflush(stdout);
}

void write_incidents(std::ofstream& out, const StressSet& set, const StressResult& result) {
  for (const Incident& i : result.incidents) {
    out << fmt::format("{},{},{},{},{:.1f},{:.1f},\"{}\",\"{}\"\n", set.name, result.strategy,
                       i.block, i.code, i.area_m2, i.time_ms, i.message,
                       to_wkt(set.blocks[i.block].contour));
  }
}

/// Whether the result keeps what is promised.
bool is_sound(const StressResult& r, double failure_bound) {
  const bool is_wrong = r.failures.contains("not_covered") || r.failures.contains("exception");
  const bool is_slow = std::any_of(r.incidents.begin(), r.incidents.end(),
                                   [](const Incident& i) { return i.code == "slow"; });
  return !is_wrong && !is_slow &&
         static_cast<double>(r.large_failed) <= failure_bound * static_cast<double>(r.large);
}

int run(const Arguments& args) {
  std::vector<StressSet> sets;
  if (args.blocks > 0) sets.push_back(random_set(args.seed, args.blocks));
  for (const std::string& city : args.cities) sets.push_back(city_set(city));
  std::ofstream incidents;
  if (!args.incidents_file.empty()) {
    incidents.open(args.incidents_file);
    incidents << "set,strategy,block,code,area_m2,time_ms,message,wkt\n";
  }
  print_header();
  bool is_all_sound = true;
  for (const StressSet& set : sets) {
    for (const std::string& strategy : args.strategies) {
      const StressResult result =
          run_stress(set, strategy, args.seed, args.slow_ms, args.hang_s, args.jobs);
      print_row(result);
      if (incidents.is_open()) write_incidents(incidents, set, result);
      is_all_sound = is_sound(result, args.failure_bound) && is_all_sound;
    }
  }
  return is_all_sound ? 0 : 1;
}

}  // namespace
}  // namespace plat::stress

int main(int argc, char** argv) {
  plat::stress::Arguments args;
  args.blocks = static_cast<std::uint32_t>(
      plat::testing::number_from_environment("PLAT_STRESS_BLOCKS", args.blocks));
  CLI::App app{
      "Divides random blocks and those of observed cities by every strategy.\n"
      "Exit status: 0 sound, 1 a result is no coverage, too slow, or too many blocks above 200 m2 "
      "fail, 2 bad input, 3 a hang"};
  app.add_option("--blocks", args.blocks, "random blocks (default: PLAT_STRESS_BLOCKS, else 400)");
  app.add_option("--seed", args.seed, "of the random blocks")->capture_default_str();
  app.add_option("--strategy", args.strategies, "a strategy; may be repeated (default: all)");
  app.add_option("--city", args.cities, "an observed data set; may be repeated");
  app.add_option("--slow-ms", args.slow_ms, "bound for one block, ms")->capture_default_str();
  app.add_option("--hang-s", args.hang_s, "ends the program, s")->capture_default_str();
  app.add_option("--failure-bound", args.failure_bound, "largest share of blocks above 200 m2")
      ->capture_default_str();
  app.add_option("--jobs", args.jobs.count, "threads, 0 = all");
  app.add_option("--incidents", args.incidents_file, "CSV of failures and slow blocks, with WKT");
  CLI11_PARSE(app, argc, argv);
  if (args.strategies.empty()) args.strategies = plat::parcels::block_subdividers().names();
  try {
    return plat::stress::run(args);
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "stress_subdividers: {}\n", error.what());
    return 2;
  }
}
