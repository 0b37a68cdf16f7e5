#include "similarity/hausdorff_similarity.h"

#include "similarity/made_shapes.h"
#include "similarity/outline_hausdorff.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::centred;
using plat::testing::image_of;
using plat::testing::iterations;
using plat::testing::made_shape;
using plat::testing::property_rng;

LabelledShape shape_of(Ring ring) { return {{std::move(ring), {}}, {}, ""}; }

LabelledShape rectangle(double length, double width) {
  return shape_of({{0, 0}, {length, 0}, {length, width}, {0, width}});
}

double distance_of(const LabelledShape& a, const LabelledShape& b,
                   HausdorffSimilarity::Options options = {}) {
  const HausdorffSimilarity measure(options);
  return measure.distance(*measure.prepare(a), *measure.prepare(b));
}

// ---- between outlines as they lie ----

/// Into the top of a rectangle a notch is cut. All corners of the rectangle lie on the notched
/// outline, but the middle of its top does not.
TEST(OutlineHausdorff, FindsTheFarthestPointInTheMiddleOfAnEdge) {
  const Ring whole{{0, 0}, {20, 0}, {20, 2}, {0, 2}};
  const Ring notched{{0, 0}, {20, 0}, {20, 2}, {15, 2}, {10, 0.5}, {5, 2}, {0, 2}};
  const double from_the_middle = 5.0 * 1.5 / std::hypot(5.0, 1.5);
  EXPECT_NEAR(outline_hausdorff_m(whole, notched), from_the_middle, kHausdorffResolution_m);
  EXPECT_NEAR(outline_hausdorff_m(notched, whole), from_the_middle, kHausdorffResolution_m);
}

TEST(OutlineHausdorff, CountsTheFartherDirection) {
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring spiked{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {5, 17}, {4, 10}, {0, 10}};
  EXPECT_NEAR(outline_hausdorff_m(square, spiked), 7.0, kHausdorffResolution_m);
  EXPECT_NEAR(outline_hausdorff_m(spiked, square), 7.0, kHausdorffResolution_m);
  EXPECT_EQ(outline_hausdorff_m(spiked, spiked), 0.0);
}

/// How far from `b` the samples of a's edges lie at most.
double sampled(const Ring& a, const Ring& b, int per_edge) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < per_edge; ++k) {
      const Point p = lerp(a[i], a[(i + 1) % a.size()], static_cast<double>(k) / per_edge);
      farthest = std::max(farthest, boundary_distance_m({b, {}}, p));
    }
  return farthest;
}

TEST(OutlineHausdorff, IsWhatDenseSamplesSay) {
  Rng rng = property_rng("OutlineHausdorff.Oracle");
  constexpr int kPerEdge = 100;
  for (int i = 0; i < iterations(100); ++i) {
    const Ring a = centred(made_shape(rng)).polygon.outer;
    const Ring b = centred(made_shape(rng)).polygon.outer;
    if (a.size() > 30 || b.size() > 30) continue;
    double longest = 0.0;
    for (const Ring* ring : {&a, &b})
      for (std::size_t k = 0; k < ring->size(); ++k)
        longest = std::max(longest, distance((*ring)[k], (*ring)[(k + 1) % ring->size()]));
    const double samples = std::max(sampled(a, b, kPerEdge), sampled(b, a, kPerEdge));
    const double found = outline_hausdorff_m(a, b);
    EXPECT_GE(found, samples - 2.0 * kHausdorffResolution_m);
    EXPECT_LE(found, samples + 0.5 * longest / kPerEdge + kHausdorffResolution_m);
  }
}

TEST(OutlineHausdorff, GivesUpWithALowerBound) {
  Rng rng = property_rng("OutlineHausdorff.GiveUp");
  for (int i = 0; i < iterations(100); ++i) {
    const Ring a = centred(made_shape(rng)).polygon.outer;
    const Ring b = centred(made_shape(rng)).polygon.outer;
    const double whole = outline_hausdorff_m(a, b);
    const double given_up = outline_hausdorff_m(a, b, 0.5 * whole);
    EXPECT_GE(given_up, 0.5 * whole);
    EXPECT_LE(given_up, whole);
    EXPECT_EQ(outline_hausdorff_m(a, b, 2.0 * whole + 1.0), whole);
  }
}

// ---- the measure ----

TEST(HausdorffSimilarity, SquaresDifferByTheDistanceOfTheirCorners) {
  EXPECT_NEAR(distance_of(rectangle(10, 10), rectangle(20, 20)), 5.0 * std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(distance_of(rectangle(30, 10), rectangle(30, 16)), 3.0, 1e-8);
}

TEST(HausdorffSimilarity, TurnedCopiesAreAsOneUnlessTheyAreNotTurnedBack) {
  Rng rng = property_rng("HausdorffSimilarity.Turned");
  for (int i = 0; i < iterations(40); ++i) {
    const LabelledShape a = centred(made_shape(rng));
    const LabelledShape turned = image_of(Affine::rotation(rng.uniform(0.0, 6.3)), a);
    EXPECT_EQ(distance_of(a, a), 0.0);
    EXPECT_LT(distance_of(a, turned), 1e-7);
  }
  const LabelledShape upright = image_of(Affine::rotation(1.5707963267948966), rectangle(30, 10));
  EXPECT_NEAR(distance_of(rectangle(30, 10), upright, {.turn = OutlineTurn::kNone}), 10.0, 1e-8);
}

/// An acute triangle has a box of the same area on each of its sides: only one of them lays the
/// turned copy on it.
TEST(HausdorffSimilarity, TriesAllBoxesOfTheLeastArea) {
  const LabelledShape triangle = shape_of({{0, 0}, {60, 0}, {22, 48}});
  EXPECT_EQ(HausdorffSimilarity({}).prepare(triangle)->axes.size(), 3U);
  for (const double angle : {0.4, 1.3, 2.9, 4.0}) {
    EXPECT_LT(distance_of(triangle, image_of(Affine::rotation(angle), triangle)), 1e-7);
  }
  EXPECT_EQ(HausdorffSimilarity({}).prepare(rectangle(30, 10))->axes.size(), 1U);
}

TEST(HausdorffSimilarity, TransformationLaysTheOutlinesThatFarFromEachOther) {
  Rng rng = property_rng("HausdorffSimilarity.Lays");
  const HausdorffSimilarity measure({});
  for (int i = 0; i < iterations(40); ++i) {
    const LabelledShape a = centred(made_shape(rng));
    const LabelledShape b = centred(made_shape(rng));
    const ShapeComparison comparison = measure.compare(*measure.prepare(a), *measure.prepare(b));
    const Affine& map = *comparison.transformation;
    EXPECT_NEAR(map.determinant(), 1.0, 1e-12);
    EXPECT_NEAR(outline_hausdorff_m(image_of(map, a).polygon.outer, b.polygon.outer),
                comparison.distance, 1e-7);
  }
}

}  // namespace
}  // namespace plat::similarity
