#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/csv.h"
#include "harness/subdivision.h"
#include "statistics/comparison.h"

namespace plat::harness {

/// The parcels of one layer, block by block in the blocks' order, with their measures.
struct MeasuredLayer {
  std::string label;  ///< "observed" or the label of a strategy
  std::vector<std::vector<parcels::ParcelMeasures>> per_block;  ///< all repetitions together
};

/// Every measure that has a distribution, observed against each layer.
/// Pre: all layers have as many blocks as `observed`.
std::vector<statistics::MeasureSamples> measure_samples(const MeasuredLayer& observed,
                                                        std::span<const MeasuredLayer> layers);

/// distances.csv, differences.csv, histograms.csv and summary.json for any number of data sets
/// (docs/run_directory.md).
class ComparisonTables {
 public:
  ComparisonTables();

  void add(const std::string& dataset, std::span<const MeasuredLayer> layers,
           const statistics::Comparison& comparison);

  /// Writes distances.csv, differences.csv, histograms.csv and summary.json.
  void write(const std::filesystem::path& folder) const;

 private:
  CsvTable distances_;
  CsvTable differences_;
  CsvTable histograms_;
  std::vector<std::pair<std::string, std::string>> summaries_;  ///< data set, JSON text
};

}  // namespace plat::harness
