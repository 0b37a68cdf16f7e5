#include "street_growth/growth_cell.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/rng.h"

namespace plat::growth {
namespace {

using streets::Growth;
using streets::LevelledNetwork;

std::vector<int> levels_in(const streets::StreetNetwork& network,
                           const streets::Exemplar& exemplar) {
  std::vector<int> levels(network.streets.size(), 0);
  for (const streets::StreetChain& chain : exemplar.chains) {
    for (const streets::StreetChain::Piece& piece : chain.pieces)
      levels[piece.street] = chain.hierarchy;
  }
  return levels;
}

streets::NetworkMeasures measured(const streets::StreetNetwork& network,
                                  std::optional<double> land_area_m2, const std::string& city,
                                  const GrowthConfig& config) {
  streets::NetworkMeasureOptions options;
  options.routes = config.routes;
  options.land_area_m2 = land_area_m2;
  Rng rng(derive_seed(config.seed, {seed_key(city), seed_key("measures")}));
  return streets::measure_network(network, options, rng);
}

Expected<Growth> regrown(const KnownCity& city, const Variant& variant, int repetition,
                         const GrowthConfig& config) {
  streets::GrowthSite site;
  site.points = city.observed.exemplar.points;
  for (const Attribute attribute : variant.flattened)
    site.points = flattened(std::move(site.points), attribute);
  // Without the variant: all meet the same randomness.
  Rng rng(derive_seed(config.seed, {seed_key(city.label), static_cast<std::uint64_t>(repetition)}));
  return streets::street_growers().make(variant.strategy, variant.options).grow(site, rng);
}

TiledShares by_tile(const streets::Recovery& recovery, double tile_m) {
  TiledShares out;
  const auto at = [&](const streets::JudgedPart& part) -> streets::RecoveryShares& {
    const Point middle = midpoint(part.chord.a, part.chord.b);
    return out[{static_cast<std::int64_t>(std::floor(middle.x / tile_m)),
                static_cast<std::int64_t>(std::floor(middle.y / tile_m)), part.level}];
  };
  for (const auto& part : recovery.known) at(part) += {part.amount, part.matched, 0.0, 0.0};
  for (const auto& part : recovery.grown) at(part) += {0.0, 0.0, part.amount, part.matched};
  return out;
}

void add_measures(const KnownCity& city, const Growth& growth, const GrowthConfig& config,
                  GrowthCell& cell) {
  const streets::NetworkMeasures grown =
      measured(growth.network, city.measures.land_area_m2, city.label, config);
  for (const streets::NetworkSample& sample : streets::network_samples()) {
    const std::vector<double>& known = sample.values(city.measures);
    const std::vector<double>& values = sample.values(grown);
    cell.distances.emplace_back();
    if (known.empty() || values.empty()) continue;
    cell.distances.back() = {statistics::ks_statistic(known, values),
                             statistics::wasserstein_1(known, values)};
  }
  for (const streets::NetworkScalar& scalar : streets::network_scalars())
    cell.scalars.push_back(scalar.value(grown));
}

bool is_same(const Growth& a, const Growth& b) {
  const auto same_street = [](const streets::Street& s, const streets::Street& t) {
    return s.line == t.line;
  };
  const auto same_level = [](const streets::GrownSegment& s, const streets::GrownSegment& t) {
    return s.hierarchy == t.hierarchy;
  };
  return std::ranges::equal(a.network.streets, b.network.streets, same_street) &&
         std::ranges::equal(a.segments, b.segments, same_level) && a.left_alone == b.left_alone;
}

GrowthCell judged(const KnownCity& city, const Growth& growth, const GrowthConfig& config) {
  GrowthCell cell;
  cell.left_alone = growth.left_alone.size();
  const std::vector<int> levels = streets::levels_of(growth);
  const LevelledNetwork known{city.observed.network, city.levels};
  const LevelledNetwork grown{growth.network, levels};
  cell.edges = by_tile(streets::recover_edges(known, grown, city.places), config.tile_m);
  cell.length = by_tile(streets::recover_length(known, grown, config.length), config.tile_m);
  add_measures(city, growth, config, cell);
  return cell;
}

}  // namespace

KnownCity know_city(const CityChoice& choice, const GrowthConfig& config, Jobs jobs) {
  harness::ExemplarSource source;
  source.city = choice.dataset;
  source.window = choice.window;
  KnownCity city{choice.dataset, harness::read_exemplar(source, jobs), {}, {}, {}};
  city.levels = levels_in(city.observed.network, city.observed.exemplar);
  for (const streets::IntersectionPoint& point : city.observed.exemplar.points)
    city.places.push_back(point.place);
  city.measures = measured(city.observed.network, std::nullopt, city.label, config);
  return city;
}

std::vector<GrowthCell> run_cells(const KnownCity& city, const Variant& variant, int repetitions,
                                  const GrowthConfig& config) {
  std::vector<GrowthCell> cells;
  std::optional<Growth> before;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    Expected<Growth> growth = regrown(city, variant, repetition, config);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    if (!growth) {
      cells.emplace_back();
      cells.back().status = failure_name(growth.error().code);
      cells.back().message = growth.error().message;
      before.reset();
    } else {
      const bool is_known = before && is_same(*before, *growth);
      cells.push_back(is_known ? cells.back() : judged(city, *growth, config));
      before = *std::move(growth);
    }
    cells.back().growth_s = time.count();
  }
  return cells;
}

Expected<streets::Recovery> judged_edges(const KnownCity& city, const Variant& variant,
                                         int repetition, const GrowthConfig& config) {
  const Expected<Growth> growth = regrown(city, variant, repetition, config);
  if (!growth) return tl::unexpected(growth.error());
  const std::vector<int> levels = streets::levels_of(*growth);
  return streets::recover_edges({city.observed.network, city.levels}, {growth->network, levels},
                                city.places);
}

}  // namespace plat::growth
