// The contract of ShapeSimilarity on observed parcels and blocks, every registered strategy.
#include <gtest/gtest.h>

#include <map>

#include "similarity/similarity_contract.h"
#include "support/property.h"
#include "support/real_shapes.h"

namespace plat::similarity {
namespace {

using plat::testing::RealShapes;

struct Case {
  std::string dataset;
  std::string strategy;
};

/// Loaded once per city: reading takes longer than comparing.
const RealShapes& city(const std::string& name) {
  static std::map<std::string, RealShapes> cities;
  constexpr std::size_t kShapes = 150;
  const auto it = cities.find(name);
  if (it != cities.end()) return it->second;
  return cities.emplace(name, plat::testing::real_shapes(name, kShapes)).first->second;
}

class RealShapesContract : public ::testing::TestWithParam<Case> {};

TEST_P(RealShapesContract, HoldsOnNeighboursAndStrangersAndNearlyAllArePrepared) {
  PLAT_REAL_DATA_OR_SKIP(file, GetParam().dataset + "/" + GetParam().dataset + ".gpkg");
  const AnyShapeSimilarity measure = shape_similarities().make(GetParam().strategy);
  const RealShapes& shapes = city(GetParam().dataset);
  Rng rng = plat::testing::property_rng("RealShapesContract");
  std::size_t prepared = 0;
  for (const auto* kind : {&shapes.parcels, &shapes.blocks}) {
    ASSERT_GT(kind->size(), 20U);
    for (std::size_t i = 0; i < kind->size(); ++i) {
      const LabelledShape& shape = (*kind)[i];
      const LabelledShape& next = (*kind)[(i + 1) % kind->size()];
      prepared += measure.prepare(shape) ? 1 : 0;
      ASSERT_EQ(plat::testing::why_not_in_contract(measure, shape, next, rng), "") << i;
      const LabelledShape& stranger = shapes.parcels[rng.index(shapes.parcels.size())];
      if (i % 3 == 0) {
        ASSERT_EQ(plat::testing::why_not_in_contract(measure, shape, stranger, rng), "") << i;
      }
    }
  }
  EXPECT_GE(prepared * 100, (shapes.parcels.size() + shapes.blocks.size()) * 99);
}

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const char* dataset : {"cambridge_ma", "san_roman_es", "prague_bubenec_cz"})
    for (const std::string& strategy : shape_similarities().names())
      out.push_back({dataset, strategy});
  return out;
}

INSTANTIATE_TEST_SUITE_P(Cities, RealShapesContract, ::testing::ValuesIn(cases()),
                         [](const auto& each) {
                           return each.param.dataset + "_" + each.param.strategy;
                         });

}  // namespace
}  // namespace plat::similarity
