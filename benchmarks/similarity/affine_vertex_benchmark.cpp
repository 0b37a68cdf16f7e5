// Time of one affine_vertex distance by numbers of corners, one thread, shapes prepared.
//
// Shapes are stars and lots (rectangles whose corners are moved, with further corners moved off
// their sides), half of them with the default bound on area, half with none, the worst case.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/rng.h"
#include "similarity/affine_vertex_similarity.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

using similarity::AffineVertexSimilarity;

/// A lot of about 20 x 30 m.
Ring lot_ring(Rng& rng, int corners) {
  const Ring box{{0, 0}, {20, 0}, {20, 30}, {0, 30}};
  std::vector<int> extra(4, 0);
  for (int i = 4; i < corners; ++i) ++extra[rng.index(4)];
  Ring ring;
  for (std::size_t side = 0; side < 4; ++side) {
    const int parts = extra[side] + 1;
    for (int i = 0; i < parts; ++i) {
      const Point p = lerp(box[side], box[(side + 1) % 4], static_cast<double>(i) / parts);
      ring.push_back(p + Point{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)});
    }
  }
  return ring;
}

enum class Family { kLots, kStars };

std::vector<AffineVertexSimilarity::Prepared> shapes(const AffineVertexSimilarity& measure,
                                                     Family family, int corners) {
  constexpr std::size_t kCount = 64;
  Rng rng(derive_seed(1, {static_cast<std::uint64_t>(corners)}));
  std::vector<AffineVertexSimilarity::Prepared> out;
  while (out.size() < kCount) {
    const Ring ring = family == Family::kLots ? lot_ring(rng, corners)
                                              : testing::star_ring(rng, corners, 8, 20, {});
    const auto polygon = admit_polygon({ring, {}}, 100);
    if (!polygon) continue;
    const auto prepared = measure.prepare({*polygon, {}, ""});
    if (prepared && prepared->outline.count == static_cast<std::size_t>(corners))
      out.push_back(*prepared);
  }
  return out;
}

void compare_pairs(benchmark::State& state, Family family, double area_loss_01) {
  const AffineVertexSimilarity measure({.area_loss_01 = area_loss_01});
  const auto first = shapes(measure, family, static_cast<int>(state.range(0)));
  const auto second = shapes(measure, family, static_cast<int>(state.range(1)));
  for (auto _ : state) {
    double sum = 0.0;
    for (const auto& a : first) {
      for (const auto& b : second) sum += measure.distance(a, b);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["per_pair"] = benchmark::Counter(
      static_cast<double>(first.size() * second.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void vertex_counts(benchmark::internal::Benchmark* benchmark) {
  for (const auto& [a, b] : std::vector<std::pair<int, int>>{
           {4, 4}, {5, 4}, {6, 4}, {6, 6}, {8, 4}, {8, 6}, {8, 8}, {12, 5}, {12, 12}})
    benchmark->Args({a, b});
}

BENCHMARK_CAPTURE(compare_pairs, lots, Family::kLots, 0.1)->Apply(vertex_counts);
BENCHMARK_CAPTURE(compare_pairs, stars, Family::kStars, 0.1)->Apply(vertex_counts);
BENCHMARK_CAPTURE(compare_pairs, lots_any_removal, Family::kLots, 1.0)->Apply(vertex_counts);
BENCHMARK_CAPTURE(compare_pairs, stars_any_removal, Family::kStars, 1.0)->Apply(vertex_counts);

}  // namespace
}  // namespace plat
