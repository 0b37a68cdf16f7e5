#include "layout_blending/blending_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/progress.h"
#include "core/rng.h"
#include "core/working_grid.h"
#include "geodata/dataset_catalogue.h"
#include "harness/observed_streets.h"
#include "streets/exemplar.h"
#include "streets/network_measures.h"
#include "streets/street_grower.h"
#include "synthesis/point_blend.h"

namespace plat::blending {
namespace {

using streets::IntersectionPoint;
using streets::PassingStreet;
using streets::StreetNetwork;
using synthesis::PointQuadtree;
using synthesis::PointSet;
using Values = std::vector<std::optional<double>>;

/// A mean over the streets of all points.
struct PointMeasure {
  std::string_view name;
  std::string_view unit;
  double (*value)(const PassingStreet&);
};
constexpr std::array<PointMeasure, 8> kPointMeasures{{
    {"distance_mean", "m", [](const PassingStreet& s) { return s.distance_mean_m; }},
    {"distance_variance", "m2", [](const PassingStreet& s) { return s.distance_variance_m2; }},
    {"angle_mean", "rad", [](const PassingStreet& s) { return s.angle_mean_rad; }},
    {"angle_variance", "rad2", [](const PassingStreet& s) { return s.angle_variance_rad2; }},
    {"tortuosity", "", [](const PassingStreet& s) { return s.tortuosity; }},
    {"width", "m", [](const PassingStreet& s) { return s.width_m; }},
    {"hierarchy", "", [](const PassingStreet& s) { return static_cast<double>(s.hierarchy); }},
    {"connections", "", [](const PassingStreet& s) { return static_cast<double>(s.connections); }},
}};

/// Of the network: what figure 10 speaks of, and how the network is connected. Sizes and what
/// depends on them alone are left out.
constexpr std::array<std::string_view, 9> kNetworkScalars{"mean_degree",
                                                          "dead_end_share_01",
                                                          "mean_edge_length_m",
                                                          "intersections_per_km2",
                                                          "length_km_per_km2",
                                                          "circuity",
                                                          "orientation_entropy_length_nats",
                                                          "mean_transport_ratio",
                                                          "unreachable_01"};

std::vector<Point> distinct_places(std::span<const IntersectionPoint> points) {
  std::vector<Point> out;
  for (const IntersectionPoint& point : points) out.push_back(point.place);
  std::ranges::sort(out);
  const auto repeated = std::ranges::unique(out);
  out.erase(repeated.begin(), repeated.end());
  return out;
}

/// Standard deviation over mean of the distances to the nearest other place: 0 for a square grid,
/// 0.52 where places are independent.
std::optional<double> nearest_variation(std::span<const Point> places) {
  if (places.size() < 3) return std::nullopt;
  double sum = 0.0;
  double squares = 0.0;
  for (const Point p : places) {
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (const Point q : places) {
      if (p != q) nearest_m2 = std::min(nearest_m2, squared_length(q - p));
    }
    sum += std::sqrt(nearest_m2);
    squares += nearest_m2;
  }
  const auto n = static_cast<double>(places.size());
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean)) / mean;
}

std::optional<double> deviation_over_mean(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double variance = 0.0;
  for (const double v : values) variance += (v - mean) * (v - mean);
  return std::sqrt(variance / static_cast<double>(values.size() - 1)) / mean;
}

Values measured(std::span<const IntersectionPoint> points, double area_km2,
                const StreetNetwork& network, Rng& rng) {
  Values out;
  double streets = 0.0;
  std::array<double, kPointMeasures.size()> sums{};
  for (const IntersectionPoint& point : points) {
    for (const PassingStreet& street : streets::streets_of(point)) {
      streets += 1.0;
      for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += kPointMeasures[m].value(street);
    }
  }
  for (const double sum : sums) {
    out.push_back(streets > 0.0 ? std::optional(sum / streets) : std::nullopt);
  }
  const std::vector<Point> places = distinct_places(points);
  out.emplace_back(static_cast<double>(places.size()) / area_km2);
  out.push_back(nearest_variation(places));

  streets::NetworkMeasureOptions options;
  options.land_area_m2 = 1e6 * area_km2;
  const streets::NetworkMeasures of = streets::measure_network(network, options, rng);
  for (const std::string_view name : kNetworkScalars) {
    const auto scalars = streets::network_scalars();
    const auto found = std::ranges::find(scalars, name, &streets::NetworkScalar::name);
    expects(found != scalars.end(), "the scalar exists");
    out.push_back(found->value(of));
  }
  out.push_back(deviation_over_mean(of.edge_length_m));
  return out;
}

/// Two examples, moved so that their windows lie one over the other.
struct Example {
  PointSet points;
  StreetNetwork network;  ///< streets of the window, whole ones
};
struct Pair {
  Example grid;
  Example irregular;
  std::array<PointQuadtree, 2> trees;

  [[nodiscard]] bool is_shared(Point place) const {
    return trees[0].contains(place) && trees[1].contains(place);
  }
};

bool is_in_window(Point p, double half_m) {
  return std::abs(p.x) <= half_m && std::abs(p.y) <= half_m;
}

StreetNetwork window_of(const StreetNetwork& network, Point centre, double half_m) {
  StreetNetwork out;
  for (streets::Street street : network.streets) {
    for (Point& p : street.line) p = p - centre;
    if (!std::ranges::all_of(street.line, [&](Point p) { return is_in_window(p, half_m); }))
      continue;
    out.nodes.push_back(street.line.front());
    out.nodes.push_back(street.line.back());
    out.streets.push_back(std::move(street));
  }
  std::ranges::sort(out.nodes);
  const auto repeated = std::ranges::unique(out.nodes);
  out.nodes.erase(repeated.begin(), repeated.end());
  for (std::size_t s = 0; s < out.streets.size(); ++s) {
    streets::Street& street = out.streets[s];
    street.id = StreetId{static_cast<std::uint32_t>(s)};
    street.from = static_cast<std::uint32_t>(
        std::ranges::lower_bound(out.nodes, street.line.front()) - out.nodes.begin());
    street.to = static_cast<std::uint32_t>(std::ranges::lower_bound(out.nodes, street.line.back()) -
                                           out.nodes.begin());
  }
  return out;
}

Example read_example(const ExampleChoice& choice, double window_m, Jobs jobs) {
  const harness::ObservedStreets city =
      harness::load_streets(geodata::dataset(choice.dataset), jobs);
  const Point centre = snap(choice.centre_m - city.frame.origin);
  const double half_m = 0.5 * window_m;
  Example out;
  for (IntersectionPoint& point : streets::exemplar_of(city.network, city.parcels).points) {
    point.place = point.place - centre;
    if (is_in_window(point.place, half_m)) out.points.push_back(std::move(point));
  }
  if (out.points.empty()) {
    throw InputError(fmt::format("{}: no intersection point within {} m of {}, {}", choice.dataset,
                                 half_m, choice.centre_m.x, choice.centre_m.y));
  }
  out.network = window_of(city.network, centre, half_m);
  return out;
}

double shared_area_km2(const Pair& pair, double window_m) {
  // Both boxes lie about the window: counted on a grid of places.
  constexpr int kSide = 400;
  const double step_m = 1.5 * window_m / kSide;
  int inside = 0;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      const Point p{(x + 0.5) * step_m - 0.75 * window_m, (y + 0.5) * step_m - 0.75 * window_m};
      inside += pair.is_shared(p) ? 1 : 0;
    }
  }
  return inside * step_m * step_m * 1e-6;
}

struct Cell {
  std::size_t pair = 0;
  std::size_t way = 0;
  std::size_t weight = 0;
  int seed = 0;
};

PointSet shared_points(const PointSet& points, const Pair& pair) {
  PointSet out;
  for (const IntersectionPoint& point : points) {
    if (pair.is_shared(point.place)) out.push_back(point);
  }
  return out;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> kMeasures = [] {
    std::vector<Measure> out;
    for (const PointMeasure& m : kPointMeasures)
      out.push_back({std::string(m.name), std::string(m.unit), true});
    out.push_back({"places_per_km2", "1/km2", true});
    out.push_back({"nearest_variation", "", true});
    for (const std::string_view name : kNetworkScalars) {
      const auto scalars = streets::network_scalars();
      const auto found = std::ranges::find(scalars, name, &streets::NetworkScalar::name);
      expects(found != scalars.end(), "the scalar exists");
      out.push_back({std::string(name), std::string(found->unit), false});
    }
    out.push_back({"edge_length_variation", "", false});
    return out;
  }();
  return kMeasures;
}

BlendingResult run_blending(const BlendingConfig& config, Jobs jobs) {
  BlendingResult out;
  std::vector<Pair> pairs;
  std::vector<double> areas_km2;
  for (std::size_t p = 0; p < config.pairs.size(); ++p) {
    Pair pair{read_example(config.pairs[p].grid, config.window_m, jobs),
              read_example(config.pairs[p].irregular, config.window_m, jobs),
              {PointQuadtree({}), PointQuadtree({})}};
    pair.trees = {PointQuadtree(pair.grid.points), PointQuadtree(pair.irregular.points)};
    areas_km2.push_back(shared_area_km2(pair, config.window_m));
    const auto add = [&](std::string_view side, const Example& example) {
      Rng rng(derive_seed(config.seed, {seed_key("routes"), p}));
      out.examples.push_back(
          {p, side,
           measured(shared_points(example.points, pair), areas_km2.back(), example.network, rng)});
    };
    add("grid", pair.grid);
    add("irregular", pair.irregular);
    pairs.push_back(std::move(pair));
  }

  std::vector<Cell> cells;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (std::size_t way = 0; way < config.ways.size(); ++way) {
      for (std::size_t w = 0; w < config.weights_01.size(); ++w) {
        for (int seed = 0; seed < config.seeds; ++seed) cells.push_back({p, way, w, seed});
      }
    }
  }
  const streets::AnyStreetGrower grower =
      streets::street_growers().make(config.grower, config.grower_options);
  std::vector<StreetNetwork> networks(cells.size());
  out.rows.resize(cells.size());
  Progress progress("layout_blending", cells.size());
  parallel_for(cells.size(), jobs, [&](std::size_t c) {
    const Cell& cell = cells[c];
    const Pair& pair = pairs[cell.pair];
    BlendRow& row = out.rows[c];
    row = {cell.pair, cell.way, config.weights_01[cell.weight], cell.seed, "ok", {}};
    const auto seed_of = [&](std::string_view what) {
      // Without weight and way: the same draws are looked at under all of them.
      return derive_seed(config.seed, {seed_key(what), static_cast<std::uint64_t>(cell.seed)});
    };
    Rng blend_rng(seed_of("blend"));
    const PointSet blended = synthesis::blend(pair.grid.points, pair.irregular.points,
                                              synthesis::ConstantWeight{row.weight_01},
                                              {.positions = config.ways[cell.way].positions,
                                               .patch_places = config.ways[cell.way].patch_places},
                                              blend_rng);
    streets::GrowthSite site;
    site.points = shared_points(blended, pair);
    Rng growth_rng(seed_of("growth"));
    Expected<streets::Growth> growth = grower.grow(site, growth_rng);
    if (growth) {
      Rng measure_rng(seed_of("routes"));
      row.values = measured(site.points, areas_km2[cell.pair], growth->network, measure_rng);
      if (cell.seed == 0) networks[c] = std::move(growth->network);
    } else {
      row.status = failure_name(growth.error().code);
      row.values.resize(measures().size());
    }
    progress.step();
  });
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].seed != 0 || out.rows[c].status != "ok") continue;
    out.networks.push_back(
        {cells[c].pair, cells[c].way, out.rows[c].weight_01, std::move(networks[c])});
  }
  return out;
}

}  // namespace plat::blending
