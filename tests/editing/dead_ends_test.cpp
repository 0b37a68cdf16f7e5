#include <gtest/gtest.h>

#include "blocks/block_extraction.h"
#include "editing/city_support.h"
#include "parcels/overlap.h"

namespace plat::blocks {
namespace {

std::vector<parcels::Parcel> contours(const streets::StreetNetwork& network, DeadEndCut cut) {
  ExtractionOptions options;
  options.face.dead_ends = cut;
  std::vector<parcels::Parcel> out;
  for (Block& block : extract_blocks(network, options).blocks)
    out.push_back({ParcelId{}, std::move(block.contour)});
  return out;
}

TEST(DeadEndCut, CuttingDeadEndsAloneGivesTheSameBlocks) {
  const streets::StreetNetwork town = testing::town_network();
  const auto all = contours(town, DeadEndCut::kAllStreets);
  const auto alone = contours(town, DeadEndCut::kDeadEnds);
  ASSERT_EQ(all.size(), alone.size());
  std::size_t pairs = 0;
  for (const parcels::Overlap& overlap : parcels::find_overlaps(all, alone)) {
    if (overlap.area_m2 < 1.0) continue;
    ++pairs;
    const double all_m2 = area_m2(all[overlap.first].shape);
    const double alone_m2 = area_m2(alone[overlap.second].shape);
    EXPECT_NEAR(overlap.area_m2, all_m2, 0.5);
    EXPECT_NEAR(overlap.area_m2, alone_m2, 0.5);
  }
  EXPECT_EQ(pairs, all.size());
}

}  // namespace
}  // namespace plat::blocks
