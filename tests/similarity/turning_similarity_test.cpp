#include "similarity/turning_similarity.h"

#include <numbers>

#include "similarity/made_shapes.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::centred;
using plat::testing::image_of;
using plat::testing::iterations;
using plat::testing::made_shape;
using plat::testing::property_rng;

constexpr double kPi = std::numbers::pi;

LabelledShape shape_of(Ring ring) { return {{std::move(ring), {}}, {}, ""}; }

LabelledShape rectangle(double length, double width) {
  return shape_of({{0, 0}, {length, 0}, {length, width}, {0, width}});
}

double distance_of(const LabelledShape& a, const LabelledShape& b, double size_weight = 0.0) {
  const TurningSimilarity measure({.size_weight = size_weight});
  return measure.distance(*measure.prepare(a), *measure.prepare(b));
}

TEST(TurningSimilarity, SimilarOutlinesAreAsOne) {
  const LabelledShape a = shape_of({{0, 0}, {80, 0}, {80, 20}, {30, 24}, {28, 60}, {0, 50}});
  const LabelledShape b = image_of(
      Affine::rotation(2.0) * Affine{.xx = 3.0, .xy = 0.0, .yx = 0.0, .yy = 3.0, .shift = {7, 8}},
      a);
  EXPECT_EQ(distance_of(a, a), 0.0);
  EXPECT_NEAR(distance_of(a, b), 0.0, 1e-12);
  EXPECT_GT(distance_of(a, image_of({.xx = -1.0}, a)), 0.1);
}

/// Where corners of both meet, rounding leaves a sliver between them in which the directions differ
/// by a corner's turn: it must not count.
TEST(TurningSimilarity, RoundingOfMeetingCornersDoesNotCount) {
  Rng rng = property_rng("TurningSimilarity.Rounding");
  for (int i = 0; i < iterations(100); ++i) {
    const LabelledShape a = centred(made_shape(rng));
    const LabelledShape b =
        plat::testing::begun_elsewhere(rng, image_of(Affine::rotation(rng.uniform(0.0, 6.3)), a));
    EXPECT_LT(distance_of(a, b), 1e-9);
  }
}

/// Corners of the square lie at 0, 3, 6 and 9 twelfths of its length, those of the rectangle at 0,
/// 4, 6 and 10: the directions differ by a right angle over two twelfths, and by a quarter over
/// less for no start.
TEST(TurningSimilarity, SquareAndRectangleOfTwoSquaresDifferAsByHand) {
  const double by_hand = 0.5 * kPi * std::sqrt(1.0 / 6.0 * 5.0 / 6.0);
  EXPECT_NEAR(distance_of(rectangle(1, 1), rectangle(2, 1)), by_hand, 1e-12);
  EXPECT_NEAR(distance_of(rectangle(70, 35), rectangle(20, 20)), by_hand, 1e-12);
}

/// Corners of the triangle lie at 0, 4 and 8 twelfths, with a third of a turn each. Begun at a
/// corner of both, the triangle is ahead by pi / 6 over 0..3, behind by pi / 3 over 3..4, ahead by
/// pi / 3 over 4..6, behind by pi / 6 over 6..8, and so on.
TEST(TurningSimilarity, SquareAndTriangleDifferAsByHand) {
  const LabelledShape triangle = shape_of({{0, 0}, {2, 0}, {1, std::sqrt(3.0)}});
  const std::array<double, 6> twelfths{3, 1, 2, 2, 1, 3};
  const std::array<double, 6> sixths_of_pi{1, -2, 2, -1, 3, 0};
  double mean = 0.0;
  for (std::size_t i = 0; i < 6; ++i) mean += twelfths[i] / 12.0 * sixths_of_pi[i];
  double variance = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
    variance += twelfths[i] / 12.0 * std::pow(sixths_of_pi[i] - mean, 2);
  // All meetings of their corners are alike but for a mirror.
  EXPECT_NEAR(distance_of(rectangle(1, 1), triangle), kPi / 6.0 * std::sqrt(variance), 1e-12);
}

/// The mean squared difference of the turning functions for one start and the best rotation, by
/// the rule of the rectangle.
double sampled_variance(const TurningSimilarity::Prepared& a, const TurningSimilarity::Prepared& b,
                        double start) {
  constexpr int kSamples = 4000;
  const auto direction = [](const TurningSimilarity::Prepared& outline, double share) {
    double sum = 2.0 * kPi * std::floor(share);
    const double within = share - std::floor(share);
    for (std::size_t i = 0; i < outline.starts_01.size(); ++i)
      if (outline.starts_01[i] <= within) sum += outline.turns_rad[i];
    return sum;
  };
  double mean = 0.0;
  double square = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    const double share = (k + 0.5) / kSamples;
    const double difference = direction(a, share + start) - direction(b, share);
    mean += difference / kSamples;
    square += difference * difference / kSamples;
  }
  return square - mean * mean;
}

TEST(TurningSimilarity, NoOtherStartIsBetter) {
  Rng rng = property_rng("TurningSimilarity.Oracle");
  const TurningSimilarity measure({});
  int small = 0;
  for (int i = 0; i < iterations(60); ++i) {
    const auto a = *measure.prepare(centred(made_shape(rng)));
    const auto b = *measure.prepare(centred(made_shape(rng)));
    if (a.starts_01.size() > 12 || b.starts_01.size() > 12) continue;
    ++small;
    const double found = measure.distance(a, b);
    double least = std::numeric_limits<double>::infinity();
    // Any start, and those at which corners meet.
    std::vector<double> starts;
    for (int k = 0; k < 50; ++k) starts.push_back(rng.uniform_01());
    for (const double of_a : a.starts_01)
      for (const double of_b : b.starts_01) starts.push_back(of_a - of_b + 1.0);
    for (const double start : starts) least = std::min(least, sampled_variance(a, b, start));
    // The rule of the rectangle errs by a sample per corner.
    constexpr double kRule = 0.05;
    EXPECT_NEAR(found * found, least, kRule + 0.02 * least);
  }
  EXPECT_GT(small, iterations(60) / 4);
}

TEST(TurningSimilarity, TriangleInequalityHolds) {
  Rng rng = property_rng("TurningSimilarity.Triangle");
  for (int i = 0; i < iterations(300); ++i) {
    const LabelledShape a = made_shape(rng, plat::testing::ShapeFamily::kStar);
    const LabelledShape b = made_shape(rng, plat::testing::ShapeFamily::kLShape);
    const LabelledShape c = made_shape(rng, plat::testing::ShapeFamily::kTriangle);
    EXPECT_LE(distance_of(a, c), distance_of(a, b) + distance_of(b, c) + 1e-9);
    EXPECT_LE(distance_of(a, b), distance_of(a, c) + distance_of(c, b) + 1e-9);
  }
}

TEST(TurningSimilarity, SizeCountsAsMuchAsItsWeight) {
  EXPECT_NEAR(distance_of(rectangle(10, 10), rectangle(20, 20), 3.0), 3.0 * std::log(2.0), 1e-12);
  EXPECT_FALSE(TurningSimilarity({.size_weight = 3.0}).claims().scale);
}

TEST(TurningSimilarity, EveryCornerOfBothCorrespondsToItsLike) {
  const TurningSimilarity measure({});
  const LabelledShape a = shape_of({{0, 0}, {80, 0}, {80, 20}, {30, 24}, {28, 60}, {0, 50}});
  const Affine motion = Affine::translation({1000, 2000}) * Affine::rotation(2.0);
  const ShapeComparison comparison =
      measure.compare(*measure.prepare(a), *measure.prepare(image_of(motion, a)));
  EXPECT_EQ(comparison.correspondence.size(), 12U);
  for (const auto& [of_a, of_b] : comparison.correspondence)
    EXPECT_LT(distance(motion(of_a), of_b), 1e-6);
  for (const Point p : a.polygon.outer)
    EXPECT_LT(distance((*comparison.transformation)(p), motion(p)), 1e-6);
}

TEST(TurningSimilarity, OutlinesOfTooManyVerticesAreFailures) {
  Rng rng = property_rng("TurningSimilarity.Many");
  const TurningSimilarity measure({});
  for (const int n : {2000, 2001}) {
    const auto prepared = measure.prepare(shape_of(plat::testing::star_ring(rng, n, 90, 91, {})));
    EXPECT_EQ(prepared.has_value(), n == 2000);
    if (!prepared) {
      EXPECT_EQ(prepared.error().code, FailureCode::kTooManyVertices);
    }
  }
}

}  // namespace
}  // namespace plat::similarity
