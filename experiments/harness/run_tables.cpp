#include "harness/run_tables.h"

#include "core/atomic_file.h"
#include "statistics/distances.h"

namespace plat::harness {
namespace {

std::string parcels_header() {
  std::string header = "dataset,layer,repetition,block_id,parcel_id";
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    header += ',';
    header += column.name;
  }
  return header;
}

std::vector<double> areas(const std::vector<parcels::ParcelMeasures>& measures) {
  std::vector<double> out;
  out.reserve(measures.size());
  for (const auto& m : measures) out.push_back(m.area_m2);
  return out;
}

}  // namespace

RunTables::RunTables()
    : parcels_(parcels_header()),
      blocks_(
          "dataset,layer,repetition,block_id,status,message,block_area_m2,parcels,observed_parcels,"
          "area_mean_m2,"
          "area_deviation_m2,width_mean_m,width_deviation_m,aspect_ratio_mean,access_share_01,"
          "access_area_01,rows_mean,ks_area,options,seed") {}

void RunTables::add_parcel(const std::string& dataset, const std::string& layer, int repetition,
                           BlockId block, const std::string& parcel_id,
                           const parcels::ParcelMeasures& measures) {
  std::string row = fmt::format("{},{},{},{},{}", dataset, layer, repetition, block.value,
                                CsvTable::quoted(parcel_id));
  for (const parcels::MeasureColumn& column : parcels::measure_columns()) {
    fmt::format_to(std::back_inserter(row), ",{}", column.value(measures));
  }
  parcels_.add_raw_row(row);
}

void RunTables::add_block(const std::string& dataset, const BlockRow& row) {
  blocks_.add_row(dataset, row.layer, row.repetition, row.block.value,
                  row.failure ? failure_name(row.failure->code) : "ok",
                  row.failure ? row.failure->message : std::string(), row.block_area_m2,
                  row.style.count, row.observed_parcels, row.style.area_mean_m2,
                  row.style.area_deviation_m2, row.style.width_mean_m, row.style.width_deviation_m,
                  row.style.aspect_ratio_mean, row.style.access_share_01, row.style.access_area_01,
                  row.style.rows_mean, row.ks_area, row.options, row.seed);
}

void RunTables::write(const std::filesystem::path& folder) const {
  write_file(folder / "parcels.csv", parcels_.text());
  write_file(folder / "blocks.csv", blocks_.text());
}

std::optional<double> area_ks(const std::vector<parcels::ParcelMeasures>& a,
                              const std::vector<parcels::ParcelMeasures>& b) {
  if (a.empty() || b.empty()) return std::nullopt;
  return statistics::ks_statistic(areas(a), areas(b));
}

}  // namespace plat::harness
