// How time and memory grow with the number of parcels: README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/atomic_file.h"
#include "geodata/layer_io.h"
#include "harness/build_info.h"
#include "harness/city_layers.h"
#include "harness/csv.h"
#include "harness/resource_use.h"
#include "parcel_scaling/tiled_city.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"

namespace plat::scaling {
namespace {

using harness::Duration;
using harness::peak_memory_mb;
using harness::reset_peak_memory;
using harness::Stopwatch;

struct Arguments {
  std::string dataset = "cambridge_ma";
  std::vector<std::string> strategies{"obb", "skeleton"};
  std::vector<std::size_t> parcels{1'000, 10'000, 100'000, 500'000, 1'000'000};
  std::uint64_t seed = 1;
  Jobs jobs;
  std::filesystem::path out = "out/parcel_scaling";
  bool writes_layers = true;
};

struct Row {
  std::string strategy;
  std::size_t wanted = 0;
  std::size_t blocks = 0;
  std::size_t failures = 0;
  std::size_t parcels = 0;
  Duration divide;
  Duration check;
  Duration write;  ///< measuring the parcels included
  std::optional<double> peak_mb;
  std::optional<double> peak_with_layer_mb;
};

using Divided = Expected<std::vector<parcels::Parcel>>;

std::vector<Divided> divide(const TiledCity& city, const std::vector<blocks::Block>& blocks,
                            const std::string& strategy, const Arguments& args) {
  const parcels::AnyBlockSubdivider base = parcels::block_subdividers().make(strategy);
  const std::uint64_t dataset = seed_key(args.dataset);
  std::vector<Divided> out(blocks.size(), fail(FailureCode::kNoObservation, ""));
  parallel_for(blocks.size(), args.jobs, [&](std::size_t i) {
    Rng rng(derive_seed(args.seed, {dataset, blocks[i].id.value, 0}));
    out[i] = base.fitted(city.style(i)).subdivide(blocks[i], rng);
  });
  return out;
}

/// What is no coverage becomes a failure.
void check(const std::vector<blocks::Block>& blocks, std::vector<Divided>& divided, Jobs jobs) {
  parallel_for(blocks.size(), jobs, [&](std::size_t i) {
    if (!divided[i]) return;
    if (auto defect = parcels::find_coverage_defect(blocks[i].contour, *divided[i],
                                                    parcels::kContourTolerance_m))
      divided[i] = tl::unexpected<Failure>(*std::move(defect));
  });
}

void write(const TiledCity& city, const std::vector<blocks::Block>& blocks,
           std::vector<Divided> divided, const std::string& strategy, const Arguments& args) {
  auto rows = parallel_map<harness::DividedBlock>(blocks.size(), args.jobs, [&](std::size_t i) {
    harness::DividedBlock row;
    row.block = blocks[i].id;
    row.parcels = std::move(divided[i]);
    if (!row.parcels) return row;
    std::vector<Polygon> shapes;
    for (const parcels::Parcel& parcel : *row.parcels) shapes.push_back(parcel.shape);
    row.measures = parcels::measure_parcels(blocks[i], shapes);
    return row;
  });
  harness::ParcelLayer layer("parcels", city.frame());
  layer.add(rows, 0, strategy);
  rows.clear();
  rows.shrink_to_fit();
  geodata::write_layers((args.out / fmt::format("parcels_{}.gpkg", strategy)).string(),
                        std::span(&layer.layer(), 1));
}

Row run_cell(const TiledCity& city, const std::string& strategy, std::size_t wanted,
             std::size_t block_count, const Arguments& args) {
  reset_peak_memory();
  Row row;
  row.strategy = strategy;
  row.wanted = wanted;
  row.blocks = block_count;
  const std::vector<blocks::Block> blocks = city.blocks(block_count);
  const Stopwatch dividing;
  std::vector<Divided> divided = divide(city, blocks, strategy, args);
  row.divide = dividing.elapsed();
  const Stopwatch checking;
  check(blocks, divided, args.jobs);
  row.check = checking.elapsed();
  row.peak_mb = peak_memory_mb();
  for (const Divided& block : divided) {
    row.failures += block ? 0 : 1;
    row.parcels += block ? block->size() : 0;
  }
  if (args.writes_layers) {
    const Stopwatch writing;
    write(city, blocks, std::move(divided), strategy, args);
    row.write = writing.elapsed();
    row.peak_with_layer_mb = peak_memory_mb();
  }
  return row;
}

/// Blocks that give `wanted` parcels by this strategy, judged by one copy of the city.
std::size_t blocks_for(const std::vector<std::size_t>& parcels_up_to, std::size_t wanted) {
  const std::size_t per_copy = parcels_up_to.back();
  expects(per_copy > 0, "the city is divided");
  const auto rest = std::lower_bound(parcels_up_to.begin(), parcels_up_to.end(), wanted % per_copy);
  return wanted / per_copy * parcels_up_to.size() +
         static_cast<std::size_t>(rest - parcels_up_to.begin()) + 1;
}

/// The exponent of growth: the slope of log time over log parcels, by least squares.
double exponent(const std::vector<Row>& rows, double (*seconds)(const Row&)) {
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (const Row& row : rows) {
    const double x = std::log(static_cast<double>(row.parcels));
    const double y = std::log(seconds(row));
    n += 1.0;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void write_tables(const std::map<std::string, std::vector<Row>>& rows, int threads,
                  const Arguments& args) {
  harness::CsvTable table(
      "dataset,tiled,strategy,seed,threads,parcels_wanted,blocks,failures,parcels,divide_s,"
      "divide_cpu_s,check_s,check_cpu_s,write_s,write_cpu_s,parcels_per_s,peak_mb,"
      "peak_with_layer_mb");
  harness::CsvTable exponents("dataset,strategy,phase,exponent,sizes");
  const auto if_written = [&](double value) {
    return args.writes_layers ? std::optional(value) : std::nullopt;
  };
  for (const auto& [strategy, of_strategy] : rows) {
    for (const Row& r : of_strategy) {
      table.add_row(args.dataset, 1, r.strategy, args.seed, threads, r.wanted, r.blocks, r.failures,
                    r.parcels, r.divide.wall_s, r.divide.cpu_s, r.check.wall_s, r.check.cpu_s,
                    if_written(r.write.wall_s), if_written(r.write.cpu_s),
                    static_cast<double>(r.parcels) / r.divide.wall_s, r.peak_mb,
                    r.peak_with_layer_mb);
    }
    if (of_strategy.size() < 2) continue;
    exponents.add_row(args.dataset, strategy, "divide",
                      exponent(of_strategy, [](const Row& r) { return r.divide.cpu_s; }),
                      of_strategy.size());
    exponents.add_row(args.dataset, strategy, "check",
                      exponent(of_strategy, [](const Row& r) { return r.check.cpu_s; }),
                      of_strategy.size());
  }
  write_file(args.out / "scaling.csv", table.text());
  write_file(args.out / "exponents.csv", exponents.text());
  write_file(args.out / "build.json", harness::build_info().dump(2) + "\n");
}

void run(const Arguments& args) {
  for (const std::string& strategy : args.strategies)
    static_cast<void>(parcels::block_subdividers().at(strategy));  // before anything is read
  std::filesystem::create_directories(args.out);
  const TiledCity city(harness::load_city(geodata::dataset(args.dataset), args.jobs));
  const int threads =
      args.jobs.count > 0 ? args.jobs.count : static_cast<int>(std::thread::hardware_concurrency());
  std::map<std::string, std::vector<Row>> rows;
  for (const std::string& strategy : args.strategies) {
    std::vector<std::size_t> parcels_up_to;
    for (const Divided& block : divide(city, city.blocks(city.blocks_per_copy()), strategy, args)) {
      const std::size_t before = parcels_up_to.empty() ? 0 : parcels_up_to.back();
      parcels_up_to.push_back(before + (block ? block->size() : 0));
    }
    for (const std::size_t wanted : args.parcels) {
      const Row row = run_cell(city, strategy, wanted, blocks_for(parcels_up_to, wanted), args);
      fmt::print(
          "{:<12} {:>9} parcels in {:>6} blocks: divide {:.2f} s (cpu {:.2f}), check {:.2f} s, "
          "measure and write {:.2f} s; peak {:.0f} MB, with the layer {:.0f} MB; {} failures\n",
          strategy, row.parcels, row.blocks, row.divide.wall_s, row.divide.cpu_s, row.check.wall_s,
          row.write.wall_s, row.peak_mb.value_or(0.0), row.peak_with_layer_mb.value_or(0.0),
          row.failures);
      std::fflush(stdout);
      rows[strategy].push_back(row);
      write_tables(rows, threads, args);
    }
  }
}

}  // namespace
}  // namespace plat::scaling

int main(int argc, char** argv) {
  plat::scaling::Arguments args;
  bool has_no_layers = false;
  CLI::App app{
      "Divides a city, tiled to a number of parcels, and measures time and memory.\n"
      "Example: parcel_scaling --out out/parcel_scaling && \\\n"
      "    python3 experiments/parcel_scaling/draw_scaling.py out/parcel_scaling"};
  app.add_option("--data", args.dataset, "data set with observed parcels")->capture_default_str();
  app.add_option("--strategy", args.strategies, "strategies (default: obb skeleton)");
  app.add_option("--parcels", args.parcels, "numbers of parcels, ascending")->delimiter(',');
  app.add_option("--seed", args.seed, "random seed")->capture_default_str();
  app.add_option("--jobs", args.jobs.count, "threads, 0 = all");
  app.add_option("--out", args.out, "folder to write")->capture_default_str();
  app.add_flag("--no-layers", has_no_layers, "write no GeoPackages");
  CLI11_PARSE(app, argc, argv);
  args.writes_layers = !has_no_layers;
  try {
    plat::scaling::run(args);
  } catch (const plat::InputError& error) {
    fmt::print(stderr, "parcel_scaling: {}\n", error.what());
    return 2;
  }
  return 0;
}
