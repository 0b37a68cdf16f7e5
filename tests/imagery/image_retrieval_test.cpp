#include "imagery/image_retrieval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "imagery/made_parcels.h"
#include "support/property.h"

namespace plat::imagery {
namespace {

using plat::testing::iterations;
using plat::testing::property_rng;
using plat::testing::rectangle;

ParcelShape lot(double length, double width, std::optional<BoxSides> sides,
                const std::string& zone = "") {
  ParcelShape shape = plat::testing::shape(rectangle(0, 0, length, width));
  shape.street_sides = sides;
  shape.zone = zone;
  return shape;
}

std::vector<ParcelShape> random_lots(Rng& rng, int count) {
  std::vector<ParcelShape> lots;
  for (int i = 0; i < count; ++i) {
    // Whole metres: equal distances occur.
    const double width = std::floor(rng.uniform(4, 12));
    const double length = width + std::floor(rng.uniform(1, 12));
    const std::optional<BoxSides> sides =
        rng.index(6) == 0 ? std::nullopt : std::optional(static_cast<BoxSides>(rng.index(16)));
    lots.push_back(lot(length, width, sides, rng.index(2) == 0 ? "residential" : "mixed"));
  }
  return lots;
}

/// The twin: a full scan.
Match brute_force(const std::vector<ParcelShape>& examples, const RetrievalOptions& options,
                  const ParcelShape& target, std::size_t excluded) {
  const auto front = [&](const ParcelShape& s) {
    return s.street_sides ? front_class(*s.street_sides, options.mirroring) : 99;
  };
  for (const MatchLevel level : {MatchLevel::kFrontAndZone, MatchLevel::kFront, MatchLevel::kAny}) {
    Match best{0, 1e30, level, Symmetry::kKept};
    for (std::size_t i = 0; i < examples.size(); ++i) {
      if (i == excluded) continue;
      if (level != MatchLevel::kAny && front(examples[i]) != front(target)) continue;
      if (level == MatchLevel::kFrontAndZone && options.zones == ZonePolicy::kSame &&
          examples[i].zone != target.zone)
        continue;
      const double d_area = options.area_weight * std::log(examples[i].box.area_m2()) -
                            options.area_weight * std::log(target.box.area_m2());
      const double d_aspect = options.aspect_weight * std::log(examples[i].box.aspect_ratio()) -
                              options.aspect_weight * std::log(target.box.aspect_ratio());
      const double squared = d_area * d_area + d_aspect * d_aspect;
      if (squared < best.distance) {
        best.example = i;
        best.distance = squared;
      }
    }
    if (best.distance < 1e30) {
      best.distance = std::sqrt(best.distance);
      return best;
    }
  }
  return {};
}

TEST(ImageRetrieval, FindsWhatAFullScanFinds) {
  Rng rng = property_rng("ImageRetrieval.FindsWhatAFullScanFinds");
  std::set<MatchLevel> levels;
  for (int i = 0; i < iterations(60); ++i) {
    RetrievalOptions options;
    options.area_weight = rng.uniform(0, 2);
    options.aspect_weight = rng.uniform(0, 2);
    options.mirroring = rng.index(2) == 0 ? Mirroring::kAllowed : Mirroring::kForbidden;
    options.zones = rng.index(2) == 0 ? ZonePolicy::kSame : ZonePolicy::kAny;
    const auto examples = random_lots(rng, 2 + static_cast<int>(rng.index(200)));
    const ImageRetrieval retrieval(examples, options);
    for (const ParcelShape& target : random_lots(rng, 20)) {
      const std::size_t excluded = rng.index(examples.size());
      const auto match = retrieval.nearest(target, rng, excluded);
      const Match expected = brute_force(examples, options, target, excluded);
      ASSERT_TRUE(match.has_value());
      EXPECT_EQ(match->example, expected.example);
      EXPECT_EQ(match->level, expected.level);
      EXPECT_EQ(match->distance, expected.distance);
      levels.insert(match->level);
    }
  }
  EXPECT_EQ(levels.size(), 3U);
}

TEST(ImageRetrieval, PutsTheSameSidesOnTheStreet) {
  Rng rng = property_rng("ImageRetrieval.PutsTheSameSidesOnTheStreet");
  const auto examples = random_lots(rng, 400);
  const ImageRetrieval retrieval(examples, {});
  for (const ParcelShape& target : random_lots(rng, 200)) {
    const Match match = *retrieval.nearest(target, rng);
    if (match.level == MatchLevel::kAny || !target.street_sides) continue;
    EXPECT_EQ(moved_sides(*examples[match.example].street_sides, match.symmetry),
              *target.street_sides);
  }
}

TEST(ImageRetrieval, WithoutMirrorsNoImageIsMirrored) {
  const std::vector<ParcelShape> examples{lot(30, 10, kBelow | kEnd), lot(60, 20, kBelow | kStart)};
  Rng rng(1);
  const ParcelShape target = lot(30, 10, kBelow | kStart);
  EXPECT_EQ(ImageRetrieval(examples, {}).nearest(target, rng)->symmetry, Symmetry::kMirroredAlong);
  RetrievalOptions options;
  options.mirroring = Mirroring::kForbidden;
  EXPECT_EQ(ImageRetrieval(examples, options).nearest(target, rng)->example, 1U);
}

TEST(ImageRetrieval, VarietyDrawsFromTheNearestOnly) {
  std::vector<ParcelShape> examples;
  for (int i = 0; i < 50; ++i) examples.push_back(lot(20 + i, 10, kEnd));
  RetrievalOptions options;
  options.variety = 5;
  const ImageRetrieval retrieval(examples, options);
  Rng rng(7);
  std::set<std::size_t> drawn;
  for (int i = 0; i < 300; ++i) drawn.insert(retrieval.nearest(lot(20, 10, kEnd), rng)->example);
  EXPECT_EQ(drawn, (std::set<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(ImageRetrieval, AnExcludedOnlyExampleIsNone) {
  const std::vector<ParcelShape> examples{lot(30, 10, kEnd)};
  Rng rng(1);
  const ImageRetrieval retrieval(examples, {});
  EXPECT_FALSE(retrieval.nearest(examples[0], rng, 0).has_value());
  EXPECT_TRUE(retrieval.nearest(examples[0], rng).has_value());
}

TEST(ImageRetrieval, NoExampleIsBadInput) {
  EXPECT_THROW(ImageRetrieval(std::vector<ParcelShape>{}, {}), InputError);
}

TEST(ImageRetrieval, SourcesAreDrawnWithTheirWeight) {
  Rng rng = property_rng("ImageRetrieval.SourcesAreDrawnWithTheirWeight");
  for (const double weight : {0.0, 0.3, 1.0}) {
    int second = 0;
    for (int i = 0; i < 20000; ++i) second += static_cast<int>(drawn_source(weight, rng));
    EXPECT_NEAR(second / 20000.0, weight, 0.02);
  }
}

}  // namespace
}  // namespace plat::imagery
