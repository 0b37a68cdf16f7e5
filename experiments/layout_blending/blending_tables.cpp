#include "layout_blending/blending_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/rng.h"
#include "harness/csv.h"
#include "statistics/quantile.h"
#include "statistics/rank_correlation.h"

namespace plat::blending {
namespace {

using harness::CsvTable;

constexpr double kLevel_01 = 0.95;

std::string header_of_measures() {
  std::string out;
  for (const Measure& measure : measures()) out += "," + measure.name;
  return out;
}

std::string values_text(const std::vector<std::optional<double>>& values) {
  std::string out;
  for (const auto& value : values) out += value ? fmt::format(",{}", *value) : ",";
  return out;
}

/// The values of a measure: by weight, then by seed; none where the row has none.
struct Series {
  std::size_t pair = 0;
  std::size_t way = 0;
  std::size_t measure = 0;
  std::vector<std::vector<std::optional<double>>> by_weight;
};

template <class Visit>
void for_each_series(const BlendingConfig& config, const BlendingResult& result, Visit visit) {
  const std::size_t weights = config.weights_01.size();
  const auto seeds = static_cast<std::size_t>(config.seeds);
  std::size_t first = 0;
  for (std::size_t p = 0; p < config.pairs.size(); ++p) {
    for (std::size_t way = 0; way < config.ways.size(); ++way) {
      for (std::size_t m = 0; m < measures().size(); ++m) {
        Series series{p, way, m, {}};
        for (std::size_t w = 0; w < weights; ++w) {
          std::vector<std::optional<double>> values;
          for (std::size_t s = 0; s < seeds; ++s)
            values.push_back(result.rows[first + w * seeds + s].values[m]);
          series.by_weight.push_back(std::move(values));
        }
        visit(series);
      }
      first += weights * seeds;
    }
  }
}

std::vector<double> known_of(const std::vector<std::optional<double>>& values) {
  std::vector<double> out;
  for (const auto& value : values) {
    if (value) out.push_back(*value);
  }
  return out;
}

std::optional<double> mean_of(const std::vector<std::optional<double>>& values) {
  const std::vector<double> known = known_of(values);
  if (known.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double v : known) sum += v;
  return sum / static_cast<double>(known.size());
}

/// Spearman's correlation of weight and value over the seeds drawn.
std::optional<double> trend_of(const Series& series, const std::vector<double>& weights_01,
                               std::span<const std::size_t> seeds) {
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t w = 0; w < weights_01.size(); ++w) {
    for (const std::size_t seed : seeds) {
      if (!series.by_weight[w][seed]) continue;
      x.push_back(weights_01[w]);
      y.push_back(*series.by_weight[w][seed]);
    }
  }
  return statistics::spearman(x, y);
}

struct Trend {
  std::optional<double> first;  ///< mean at the first weight, and the last
  std::optional<double> last;
  std::optional<double> spearman;
  std::optional<statistics::Interval> interval;
  std::optional<double> between_share_01;
  std::optional<double> farthest_out;
};

Trend analysed(const Series& series, const BlendingConfig& config) {
  Trend out;
  out.first = mean_of(series.by_weight.front());
  out.last = mean_of(series.by_weight.back());
  if (!out.first || !out.last || *out.first == *out.last) return out;
  const double direction = *out.last > *out.first ? 1.0 : -1.0;
  std::vector<std::size_t> seeds(static_cast<std::size_t>(config.seeds));
  for (std::size_t s = 0; s < seeds.size(); ++s) seeds[s] = s;
  out.spearman = trend_of(series, config.weights_01, seeds);
  if (out.spearman) *out.spearman *= direction;
  // The same draws for every measure, so that trends can be compared.
  Rng rng(derive_seed(config.seed, {seed_key("bootstrap")}));
  std::vector<double> replicates;
  for (int r = 0; r < config.resamples; ++r) {
    for (std::size_t& seed : seeds) seed = rng.index(seeds.size());
    if (const auto replicate = trend_of(series, config.weights_01, seeds))
      replicates.push_back(direction * *replicate);
  }
  if (!replicates.empty()) out.interval = statistics::percentile_interval(replicates, kLevel_01);

  double inner = 0.0;
  double between = 0.0;
  double farthest = 0.0;
  for (std::size_t w = 1; w + 1 < series.by_weight.size(); ++w) {
    const auto mean = mean_of(series.by_weight[w]);
    if (!mean) continue;
    const double share = (*mean - *out.first) / (*out.last - *out.first);
    inner += 1.0;
    between += share >= 0.0 && share <= 1.0 ? 1.0 : 0.0;
    farthest = std::max({farthest, -share, share - 1.0});
  }
  if (inner > 0.0) {
    out.between_share_01 = between / inner;
    out.farthest_out = farthest;
  }
  return out;
}

/// Standard deviation over the seeds, the mean of its square over the weights.
std::optional<double> deviation_of(const Series& series) {
  double squares = 0.0;
  double count = 0.0;
  for (const auto& values : series.by_weight) {
    const auto mean = mean_of(values);
    const std::vector<double> known = known_of(values);
    if (known.size() < 2) continue;
    for (const double v : known) squares += (v - *mean) * (v - *mean);
    count += static_cast<double>(known.size() - 1);
  }
  if (count <= 0.0) return std::nullopt;
  return std::sqrt(squares / count);
}

}  // namespace

std::string blends_csv(const BlendingConfig& config, const BlendingResult& result) {
  CsvTable table("pair,way,weight_01,seed,status" + header_of_measures());
  for (const BlendRow& row : result.rows) {
    table.add_raw_row(fmt::format("{},{},{},{},{}{}", CsvTable::quoted(config.pairs[row.pair].name),
                                  config.ways[row.way].name, row.weight_01, row.seed, row.status,
                                  values_text(row.values)));
  }
  return table.text();
}

std::string examples_csv(const BlendingConfig& config, const BlendingResult& result) {
  CsvTable table("pair,side,dataset" + header_of_measures());
  for (const ExampleRow& row : result.examples) {
    const PairChoice& pair = config.pairs[row.pair];
    const ExampleChoice& choice = row.side == "grid" ? pair.grid : pair.irregular;
    table.add_raw_row(fmt::format("{},{},{}{}", CsvTable::quoted(pair.name), row.side,
                                  choice.dataset, values_text(row.values)));
  }
  return table.text();
}

std::string weights_csv(const BlendingConfig& config, const BlendingResult& result) {
  CsvTable table("pair,way,measure,unit,weight_01,mean,low,high,seeds");
  for_each_series(config, result, [&](const Series& series) {
    for (std::size_t w = 0; w < config.weights_01.size(); ++w) {
      const std::vector<double> known = known_of(series.by_weight[w]);
      std::optional<statistics::Interval> interval;
      if (!known.empty()) interval = statistics::percentile_interval(known, kLevel_01);
      table.add_row(config.pairs[series.pair].name, config.ways[series.way].name,
                    measures()[series.measure].name, measures()[series.measure].unit,
                    config.weights_01[w], mean_of(series.by_weight[w]),
                    interval ? std::optional(interval->low) : std::nullopt,
                    interval ? std::optional(interval->high) : std::nullopt, known.size());
    }
  });
  return table.text();
}

std::string trends_csv(const BlendingConfig& config, const BlendingResult& result) {
  CsvTable table(
      "pair,way,of,measure,unit,grid_observed,irregular_observed,first,last,deviation,"
      "spearman,ci_low,ci_high,between_share_01,farthest_out");
  for_each_series(config, result, [&](const Series& series) {
    const Measure& measure = measures()[series.measure];
    const Trend trend = analysed(series, config);
    std::array<std::optional<double>, 2> observed;
    for (const ExampleRow& row : result.examples) {
      if (row.pair == series.pair)
        observed[row.side == "grid" ? 0 : 1] = row.values[series.measure];
    }
    table.add_row(config.pairs[series.pair].name, config.ways[series.way].name,
                  measure.is_of_points ? "points" : "network", measure.name, measure.unit,
                  observed[0], observed[1], trend.first, trend.last, deviation_of(series),
                  trend.spearman,
                  trend.interval ? std::optional(trend.interval->low) : std::nullopt,
                  trend.interval ? std::optional(trend.interval->high) : std::nullopt,
                  trend.between_share_01, trend.farthest_out);
  });
  return table.text();
}

std::string networks_csv(const BlendingConfig& config, const BlendingResult& result) {
  CsvTable table("pair,way,weight_01,width_m,line");
  for (const KeptNetwork& kept : result.networks) {
    for (const streets::Street& street : kept.network.streets) {
      std::string line;
      for (const Point p : street.line)
        line += fmt::format("{}{:.2f} {:.2f}", line.empty() ? "" : ", ", p.x, p.y);
      table.add_row(config.pairs[kept.pair].name, config.ways[kept.way].name, kept.weight_01,
                    street.width_m, "LINESTRING (" + line + ")");
    }
  }
  return table.text();
}

}  // namespace plat::blending
