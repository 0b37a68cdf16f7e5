#include "harness/comparison_tables.h"

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"

namespace plat::harness {
namespace {

using nlohmann::json;
using statistics::distance_name;

template <class Value>
json json_or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json interval_json(const std::optional<statistics::Interval>& interval) {
  return interval ? json::array({interval->low, interval->high}) : json(nullptr);
}

std::optional<double> low(const std::optional<statistics::Interval>& i) {
  return i ? std::optional(i->low) : std::nullopt;
}
std::optional<double> high(const std::optional<statistics::Interval>& i) {
  return i ? std::optional(i->high) : std::nullopt;
}

}  // namespace

std::vector<statistics::MeasureSamples> measure_samples(const MeasuredLayer& observed,
                                                        std::span<const MeasuredLayer> layers) {
  std::vector<statistics::MeasureSamples> out;
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    if (column.kind == parcels::MeasureKind::kFlag) continue;
    const auto sample = [&](const MeasuredLayer& layer) {
      expects(layer.per_block.size() == observed.per_block.size(), "layers have the same blocks");
      statistics::GroupedSample grouped;
      std::vector<double> values;
      for (const auto& block : layer.per_block) {
        values.clear();
        for (const parcels::ParcelMeasures& m : block) values.push_back(column.value(m));
        grouped.add_group(values);
      }
      return grouped;
    };
    statistics::MeasureSamples samples;
    samples.measure = column.name;
    samples.kind = column.kind == parcels::MeasureKind::kInteger
                       ? statistics::ValueKind::kInteger
                       : statistics::ValueKind::kContinuous;
    samples.observed = sample(observed);
    for (const MeasuredLayer& layer : layers) samples.layers.push_back(sample(layer));
    out.push_back(std::move(samples));
  }
  return out;
}

ComparisonTables::ComparisonTables()
    : distances_(
          "dataset,layer,measure,distance,value,ci_low,ci_high,noise_mean,noise_low,noise_high,n_"
          "observed,n_generated,n_blocks"),
      differences_(
          "dataset,measure,distance,layer_a,layer_b,difference,ci_low,ci_high,p_value,p_holm,"
          "effect_size,n_blocks"),
      histograms_("dataset,measure,layer,bin_low,bin_high,count") {}

void ComparisonTables::add(const std::string& dataset, std::span<const MeasuredLayer> layers,
                           const statistics::Comparison& comparison) {
  json summary = json::object();
  for (const statistics::DistanceRow& row : comparison.distances) {
    const std::string& layer = layers[row.layer].label;
    const std::string distance(distance_name(row.distance));
    distances_.add_row(dataset, layer, row.measure, distance, row.value, low(row.interval),
                       high(row.interval), row.noise_mean, low(row.noise), high(row.noise),
                       row.n_observed, row.n_generated, row.n_blocks);
    json& node = summary[row.measure][distance];
    node["layers"][layer] = {
        {"value", json_or_null(row.value)}, {"ci", interval_json(row.interval)},
        {"n_observed", row.n_observed},     {"n_generated", row.n_generated},
        {"n_blocks", row.n_blocks},         {"noise_mean", json_or_null(row.noise_mean)},
        {"noise", interval_json(row.noise)}};
  }
  for (const statistics::DifferenceRow& row : comparison.differences) {
    const std::string distance(distance_name(row.distance));
    differences_.add_row(dataset, row.measure, distance, layers[row.layer_a].label,
                         layers[row.layer_b].label, row.difference, row.interval.low,
                         row.interval.high, row.p_value, row.p_holm, row.effect_size, row.n_blocks);
    summary[row.measure][distance]["differences"].push_back(
        {{"layer_a", layers[row.layer_a].label},
         {"layer_b", layers[row.layer_b].label},
         {"difference", row.difference},
         {"ci", json::array({row.interval.low, row.interval.high})},
         {"p_value", row.p_value},
         {"p_holm", row.p_holm},
         {"effect_size", row.effect_size},
         {"n_blocks", row.n_blocks}});
  }
  for (const statistics::HistogramRow& row : comparison.histograms) {
    histograms_.add_row(dataset, row.measure,
                        row.layer ? layers[*row.layer].label : std::string("observed"), row.bin_low,
                        row.bin_high, row.count);
  }
  summaries_.emplace_back(dataset, summary.dump());
}

void ComparisonTables::write(const std::filesystem::path& folder) const {
  write_file(folder / "distances.csv", distances_.text());
  write_file(folder / "differences.csv", differences_.text());
  write_file(folder / "histograms.csv", histograms_.text());
  json summary = json::object();
  for (const auto& [dataset, text] : summaries_) summary[dataset] = json::parse(text);
  write_file(folder / "summary.json", summary.dump(1) + "\n");
}

}  // namespace plat::harness
