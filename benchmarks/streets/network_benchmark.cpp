#include <benchmark/benchmark.h>

#include <cmath>

#include "blocks/block_extraction.h"
#include "blocks/blocks_from_parcels.h"
#include "core/planar_faces.h"
#include "geodata/layer_io.h"
#include "streets/network_cleaning.h"
#include "streets/street_import.h"
#include "streets/street_width.h"
#include "support/data_folder.h"

namespace plat {
namespace {

using streets::RawStreet;

/// A grid town of about `segment_count` raw segments: long streets, bent at every second crossing,
/// turned so that no crossing lies on the grid.
std::vector<RawStreet> grid_town(std::size_t segment_count) {
  const auto lines = static_cast<int>(std::sqrt(static_cast<double>(segment_count) / 2.0));
  constexpr double kBlock_m = 90.0;
  std::vector<RawStreet> raw;
  const auto place = [&](double x, double y) {
    const double dx = 3.0 * std::sin(0.7 * x) + 2.0 * std::sin(0.3 * y);
    return Point{0.8 * kBlock_m * x - 0.6 * kBlock_m * y + dx,
                 0.6 * kBlock_m * x + 0.8 * kBlock_m * y};
  };
  for (int i = 0; i < lines; ++i) {
    RawStreet along;
    RawStreet across;
    along.source_id = "a" + std::to_string(i);
    across.source_id = "c" + std::to_string(i);
    along.attributes.street_class = i % 5 == 0 ? "secondary" : "residential";
    across.attributes.street_class = "residential";
    for (int k = 0; k <= lines; ++k) {
      along.line.push_back(place(k, i + 0.5));
      across.line.push_back(place(i + 0.5, k));
    }
    raw.push_back(std::move(along));
    raw.push_back(std::move(across));
  }
  return raw;
}

std::vector<RawStreet> montevideo() {
  const auto file = plat::testing::data_file("montevideo_uy/montevideo_osm.gpkg");
  if (!file) return {};
  return streets::import_streets(geodata::read_layer({*file, "roads"})).streets;
}

std::vector<Segment> segments_of(const std::vector<RawStreet>& raw) {
  std::vector<Segment> out;
  for (const RawStreet& street : raw) {
    for (std::size_t i = 1; i < street.line.size(); ++i)
      out.push_back({street.line[i - 1], street.line[i]});
  }
  return out;
}

enum Town { kGrid, kMontevideo };
std::vector<RawStreet> town(std::int64_t which) {
  return which == kGrid ? grid_town(100000) : montevideo();
}

void node_and_find_faces(benchmark::State& state) {
  const std::vector<Segment> segments = segments_of(town(state.range(0)));
  if (segments.empty()) return state.SkipWithError("needs PLAT_DATA_DIR");
  std::size_t faces = 0;
  for (auto _ : state) {
    const PlanarGraph graph = node_segments(segments);
    faces = find_faces(graph).faces.size();
    benchmark::DoNotOptimize(faces);
  }
  state.counters["segments"] = static_cast<double>(segments.size());
  state.counters["faces"] = static_cast<double>(faces);
}
BENCHMARK(node_and_find_faces)->Arg(kGrid)->Arg(kMontevideo)->Unit(benchmark::kMillisecond);

void clean_network(benchmark::State& state) {
  const std::vector<RawStreet> raw = town(state.range(0));
  if (raw.empty()) return state.SkipWithError("needs PLAT_DATA_DIR");
  for (auto _ : state) benchmark::DoNotOptimize(streets::build_network(raw));
  state.counters["segments"] = static_cast<double>(segments_of(raw).size());
}
BENCHMARK(clean_network)->Arg(kGrid)->Arg(kMontevideo)->Unit(benchmark::kMillisecond);

void extract_blocks(benchmark::State& state) {
  const std::vector<RawStreet> raw = town(state.range(0));
  if (raw.empty()) return state.SkipWithError("needs PLAT_DATA_DIR");
  streets::StreetNetwork network = streets::build_network(raw).network;
  streets::assign_widths(network, {});
  std::size_t blocks = 0;
  for (auto _ : state) {
    blocks =
        blocks::extract_blocks(network, {}, Jobs{static_cast<int>(state.range(1))}).blocks.size();
  }
  state.counters["blocks"] = static_cast<double>(blocks);
}
BENCHMARK(extract_blocks)
    ->Args({kGrid, 1})
    ->Args({kGrid, 2})
    ->Args({kMontevideo, 1})
    ->Args({kMontevideo, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void cambridge_blocks_from_parcels(benchmark::State& state) {
  const auto file = plat::testing::data_file("cambridge_ma/cambridge_ma.gpkg");
  if (!file) return state.SkipWithError("needs PLAT_DATA_DIR");
  std::vector<blocks::ObservedParcel> parcels;
  for (const geodata::Feature& feature : geodata::read_layer({*file, "parcels"}).features) {
    for (const Polygon& part : feature.polygons) parcels.push_back({feature.id, part});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        blocks::blocks_from_parcels(parcels, {}, Jobs{static_cast<int>(state.range(0))}));
  }
}
BENCHMARK(cambridge_blocks_from_parcels)
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plat
