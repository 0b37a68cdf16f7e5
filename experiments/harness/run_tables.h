#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/failure.h"
#include "core/ids.h"
#include "harness/csv.h"
#include "parcels/parcel_measures.h"
#include "parcels/parcel_style.h"

namespace plat::harness {

/// One line of blocks.csv.
struct BlockRow {
  std::string layer;
  int repetition = 0;
  BlockId block;
  std::optional<Failure> failure;  ///< absent: "ok"
  double block_area_m2 = 0.0;
  std::size_t observed_parcels = 0;
  parcels::ParcelStyle
      style;  ///< of this layer's parcels in the block; its count is the column `parcels`
  std::optional<double>
      ks_area;  ///< Kolmogorov-Smirnov statistic of area, against the observed parcels of the block
  std::string options;
  std::optional<std::uint64_t> seed;
};

/// parcels.csv and blocks.csv (docs/run_directory.md).
class RunTables {
 public:
  RunTables();

  void add_parcel(const std::string& dataset, const std::string& layer, int repetition,
                  BlockId block, const std::string& parcel_id,
                  const parcels::ParcelMeasures& measures);
  void add_block(const std::string& dataset, const BlockRow& row);
  void write(const std::filesystem::path& folder) const;

 private:
  CsvTable parcels_;
  CsvTable blocks_;
};

/// The statistic between the areas of two sets of parcels; absent where one is empty.
std::optional<double> area_ks(const std::vector<parcels::ParcelMeasures>& a,
                              const std::vector<parcels::ParcelMeasures>& b);

}  // namespace plat::harness
