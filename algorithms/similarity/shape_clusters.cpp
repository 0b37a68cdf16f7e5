#include "similarity/shape_clusters.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/failure.h"

namespace plat::similarity {
namespace {

constexpr std::size_t kNumbers = 4;  // log area, corners, mean angle, deviation

/// A column per zone that occurs, in the order of their names.
std::map<std::string, std::size_t> zone_columns(const std::vector<ShapeDescriptor>& descriptors) {
  std::map<std::string, std::size_t> columns;
  for (const ShapeDescriptor& descriptor : descriptors) {
    if (!descriptor.zone.empty()) columns.emplace(descriptor.zone, 0);
  }
  std::size_t next = kNumbers;
  for (auto& [zone, column] : columns) column = next++;
  return columns;
}

NumberTable table_of(const std::vector<ShapeDescriptor>& descriptors) {
  const std::map<std::string, std::size_t> zones = zone_columns(descriptors);
  NumberTable table{kNumbers + zones.size(), {}};
  const DescriptorWeights none{
      .zone = 1, .area = 1, .corner_count = 1, .mean_angle = 1, .angle_deviation = 1};
  for (const ShapeDescriptor& descriptor : descriptors) {
    const auto coordinates = weighted_coordinates(descriptor, none);
    std::vector<double> row(coordinates.begin(), coordinates.end());
    row.resize(table.columns, 0.0);
    // Two different zones differ in two columns: the squares sum up to one.
    if (!descriptor.zone.empty()) row[zones.at(descriptor.zone)] = std::sqrt(0.5);
    table.values.insert(table.values.end(), row.begin(), row.end());
  }
  return table;
}

}  // namespace

Clusters cluster_shapes(std::span<const LabelledShape> shapes, const ClusterOptions& options,
                        std::uint64_t seed, Jobs jobs) {
  expects(!shapes.empty(), "at least one shape");
  const auto descriptors = parallel_map<ShapeDescriptor>(
      shapes.size(), jobs, [&](std::size_t i) { return descriptor_of(shapes[i]); });
  const NumberTable table = table_of(descriptors);
  std::vector<double> weights(table.columns, options.zone_weight * options.zone_weight);
  weights[0] = options.area_weight * options.area_weight;
  weights[1] = options.corner_count_weight * options.corner_count_weight;
  weights[2] = options.mean_angle_weight * options.mean_angle_weight;
  weights[3] = options.angle_deviation_weight * options.angle_deviation_weight;
  Rng rng(derive_seed(seed, {seed_key("shape_clusters")}));
  constexpr int kMostSteps = 100;  // ADR 0036
  return weighted_k_means(table, weights, cluster_count(shapes.size(), options.percent), rng,
                          kMostSteps, jobs)
      .clusters;
}

}  // namespace plat::similarity
