// The contract of BlockSubdivider on observed cities, options fitted to each block as an experiment
// does.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "harness/city.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "parcels/exact_coverage.h"
#include "support/data_folder.h"
#include "support/property.h"

namespace plat::parcels {
namespace {

/// Blocks below this need not be divided.
constexpr double kSmallBlock_m2 = 200.0;

struct Case {
  std::string dataset;
  std::string strategy;
};

/// Loaded once per city: reading takes longer than dividing.
const harness::City& city(const std::string& name) {
  static std::map<std::string, harness::City> cities;
  const auto it = cities.find(name);
  if (it != cities.end()) return it->second;
  return cities.emplace(name, harness::load_city(geodata::dataset(name))).first->second;
}

class RealBlocksContract : public ::testing::TestWithParam<Case> {};

TEST_P(RealBlocksContract, NearlyAllAreDividedAndEveryResultIsACoverage) {
  PLAT_REAL_DATA_OR_SKIP(file, GetParam().dataset + "/" + GetParam().dataset + ".gpkg");
  const std::vector<harness::ObservedBlock>& observed = city(GetParam().dataset).blocks;
  const AnyBlockSubdivider strategy = block_subdividers().make(GetParam().strategy);
  constexpr std::size_t kExactSample = 100;
  const std::size_t stride = std::max<std::size_t>(1, observed.size() / kExactSample);
  int large = 0;
  int large_divided = 0;
  int exact = 0;
  std::size_t parcel_count = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const blocks::Block& block = observed[i].block;
    Rng rng(derive_seed(testing::number_from_environment("PLAT_TEST_SEED", 1), {block.id.value}));
    const auto parcels =
        strategy.fitted(style_of(observed[i].block, observed[i].parcels)).subdivide(block, rng);
    const bool is_large = area_m2(block.contour) > kSmallBlock_m2;
    large += is_large ? 1 : 0;
    large_divided += is_large && parcels ? 1 : 0;
    if (!parcels) continue;
    parcel_count += parcels->size();
    const auto defect = find_coverage_defect(block.contour, *parcels, kContourTolerance_m);
    ASSERT_FALSE(defect) << "block " << block.id.value << ": " << defect->message;
    if (i % stride != 0) continue;
    ++exact;
    const auto exact_defect =
        testing::find_exact_coverage_defect(block.contour, *parcels, kContourTolerance_m);
    ASSERT_FALSE(exact_defect) << "block " << block.id.value << ": " << *exact_defect;
  }
  EXPECT_GE(large_divided, 0.99 * large);
  EXPECT_GE(exact, std::min<int>(80, static_cast<int>(observed.size())));
  EXPECT_GT(parcel_count, 2 * observed.size()) << "most blocks must really be divided";
  RecordProperty("parcels", static_cast<int>(parcel_count));
}

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const char* dataset : {"cambridge_ma", "san_roman_es", "prague_bubenec_cz"}) {
    for (const std::string& strategy : block_subdividers().names())
      out.push_back({dataset, strategy});
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Cities, RealBlocksContract, ::testing::ValuesIn(cases()),
                         [](const auto& each) {
                           return each.param.dataset + "_" + each.param.strategy;
                         });

}  // namespace
}  // namespace plat::parcels
