#include "similarity/shape_context_similarity.h"

#include "similarity/cyclic_warping.h"
#include "similarity/hausdorff_similarity.h"
#include "similarity/made_shapes.h"
#include "similarity/rigid_alignment.h"
#include "similarity/turning_similarity.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::image_of;
using plat::testing::iterations;
using plat::testing::made_shape;
using plat::testing::property_rng;

LabelledShape shape_of(Ring ring) { return {{std::move(ring), {}}, {}, ""}; }

LabelledShape rectangle(double length, double width) {
  return shape_of({{0, 0}, {length, 0}, {length, width}, {0, width}});
}

double distance_of(const ShapeContextSimilarity& measure, const LabelledShape& a,
                   const LabelledShape& b) {
  return measure.distance(*measure.prepare(a), *measure.prepare(b));
}

// ---- contexts ----

/// Shares of the three other corners of a square of 32 m as its first corner sees them: the
/// outline's tangent there runs to the south-east, from the corner before to the corner behind.
TEST(ShapeContexts, SeeTheOthersByAngleAndDistance) {
  OutlineSamples square;
  square.places = {{0, 0}, {32, 0}, {32, 32}, {0, 32}};
  square.centroid = {16, 16};
  const ContextBins bins{.angular = 8, .distance = 2, .inner_radius_m = 8, .outer_radius_m = 128};
  const ShapeContexts contexts = shape_contexts(square, bins, ContextAlignment::kTangent);
  std::map<std::size_t, double> seen;
  for (std::size_t t = 0; t < contexts.bins; ++t)
    if (contexts.shares_01[t * contexts.stride] > 0.0F)
      seen[t] = static_cast<double>(contexts.shares_01[t * contexts.stride]);
  // Rings have their middles at 16 and 64 m: 32 m lies midway, 45.25 m three quarters of the way.
  const double third = 1.0 / 3.0;
  const std::map<std::size_t, double> expected{
      {1, 0.5 * third}, {2, 0.25 * third},  {3, 0.5 * third},   // the near ring
      {9, 0.5 * third}, {10, 0.75 * third}, {11, 0.5 * third},  // the far ring
  };
  ASSERT_EQ(seen.size(), expected.size());
  for (const auto& [bin, share] : expected) EXPECT_NEAR(seen[bin], share, 1e-6) << bin;
  // All corners of a square see the same.
  for (std::size_t t = 0; t < contexts.bins; ++t)
    for (std::size_t k = 1; k < 4; ++k)
      EXPECT_NEAR(contexts.shares_01[t * contexts.stride + k],
                  contexts.shares_01[t * contexts.stride], 1e-6F);
}

TEST(ShapeContexts, SumToOne) {
  Rng rng = property_rng("ShapeContexts.Sum");
  for (int i = 0; i < iterations(50); ++i) {
    const LabelledShape shape = made_shape(rng);
    const std::size_t samples = 3 + rng.index(60);
    const ContextBins bins{.angular = 1 + rng.index(12), .distance = 1 + rng.index(8)};
    const ShapeContexts contexts =
        shape_contexts(outline_samples(shape.polygon.outer, samples), bins,
                       static_cast<ContextAlignment>(rng.index(3)));
    for (std::size_t k = 0; k < samples; ++k) {
      double sum = 0.0;
      for (std::size_t t = 0; t < contexts.bins; ++t)
        sum += static_cast<double>(contexts.shares_01[t * contexts.stride + k]);
      EXPECT_NEAR(sum, 1.0, 1e-5);
    }
  }
}

TEST(ShapeContexts, CostIsChiSquared) {
  Rng rng = property_rng("ShapeContexts.Cost");
  const ContextBins bins{};
  const auto contexts_of = [&] {
    return shape_contexts(outline_samples(made_shape(rng).polygon.outer, 21), bins,
                          ContextAlignment::kCentroid);
  };
  for (int i = 0; i < iterations(20); ++i) {
    const ShapeContexts a = contexts_of();
    const ShapeContexts b = contexts_of();
    const std::vector<float> costs = context_costs(a, b);
    for (std::size_t p = 0; p < 21; ++p)
      for (std::size_t q = 0; q < 21; ++q) {
        double sum = 0.0;
        for (std::size_t t = 0; t < a.bins; ++t) {
          const double g = static_cast<double>(a.shares_01[t * a.stride + p]);
          const double h = static_cast<double>(b.shares_01[t * b.stride + q]);
          if (g + h > 0.0) sum += 0.5 * (g - h) * (g - h) / (g + h);
        }
        EXPECT_NEAR(static_cast<double>(costs[p * 21 + q]), sum, 1e-6);
      }
  }
}

// ---- the measure ----

TEST(ShapeContextSimilarity, DistanceToAnyOutlineTurnedIsNoneAndToOthersIsBetweenZeroAndOne) {
  Rng rng = property_rng("ShapeContextSimilarity.Range");
  const ShapeContextSimilarity measure({.samples = 40});
  int apart = 0;
  for (int i = 0; i < iterations(100); ++i) {
    const LabelledShape a = plat::testing::centred(made_shape(rng));
    const LabelledShape turned = image_of(Affine::rotation(rng.uniform(0.0, 6.3)), a);
    EXPECT_EQ(distance_of(measure, a, a), 0.0);
    EXPECT_LT(distance_of(measure, a, turned), 1e-9);
    const double other = distance_of(measure, a, made_shape(rng));
    EXPECT_LE(other, 1.0 + 1e-6);
    apart += other > 0.05 ? 1 : 0;
  }
  EXPECT_GT(apart, iterations(100) / 2);
}

TEST(ShapeContextSimilarity, TellsSizesApart) {
  const ShapeContextSimilarity measure({});
  const double larger = distance_of(measure, rectangle(60, 30), rectangle(66, 33));
  const double largest = distance_of(measure, rectangle(60, 30), rectangle(120, 60));
  EXPECT_GT(larger, 0.001);
  EXPECT_GT(largest, 3.0 * larger);
}

TEST(ShapeContextSimilarity, AlignmentDecidesWhetherTurnedOutlinesDiffer) {
  const LabelledShape a = rectangle(90, 30);
  const LabelledShape turned = image_of(Affine::rotation(1.0), a);
  for (const ContextAlignment alignment : {ContextAlignment::kTangent, ContextAlignment::kCentroid})
    EXPECT_LT(distance_of(ShapeContextSimilarity({.alignment = alignment}), a, turned), 1e-9);
  const ShapeContextSimilarity none({.alignment = ContextAlignment::kNone});
  EXPECT_GT(distance_of(none, a, turned), 0.01);
  EXPECT_FALSE(none.claims().rotation);
}

TEST(ShapeContextSimilarity, LaysATurnedCopyOnItsOriginal) {
  Rng rng = property_rng("ShapeContextSimilarity.Align");
  const ShapeContextSimilarity measure({});
  // An outline without symmetry, so that only one motion lays it on itself.
  const LabelledShape a = shape_of({{0, 0}, {80, 0}, {80, 20}, {30, 24}, {28, 60}, {0, 50}});
  for (int i = 0; i < 10; ++i) {
    const Affine motion =
        Affine::translation({rng.uniform(-500.0, 500.0), rng.uniform(-500.0, 500.0)}) *
        Affine::rotation(rng.uniform(0.0, 6.3));
    const ShapeComparison comparison =
        measure.compare(*measure.prepare(a), *measure.prepare(image_of(motion, a)));
    ASSERT_EQ(comparison.correspondence.size(), 100U);
    for (const Point p : a.polygon.outer)
      EXPECT_LT(distance((*comparison.transformation)(p), motion(p)), 1e-6);
  }
}

TEST(ShapeContextSimilarity, EverySampleOfBothOutlinesCorresponds) {
  const ShapeContextSimilarity measure({.samples = 30});
  const auto a = *measure.prepare(rectangle(80, 40));
  const auto b = *measure.prepare(shape_of({{0, 0}, {90, 0}, {70, 50}}));
  const ShapeComparison comparison = measure.compare(a, b);
  const auto are_met = [&](const OutlineSamples& outline, auto side) {
    for (const Point place : outline.places)
      EXPECT_TRUE(std::ranges::any_of(comparison.correspondence, [&](const auto& pair) {
        return side(pair) == outline.origin + place;
      }));
  };
  are_met(a.outline, [](const auto& pair) { return pair.first; });
  are_met(b.outline, [](const auto& pair) { return pair.second; });
}

TEST(AnyShapeSimilarity, SaysOfEveryOutlineMeasureWhatTheTypeItselfSays) {
  Rng rng = property_rng("AnyShapeSimilarity.Same");
  const auto check = [&](const auto& measure) {
    const AnyShapeSimilarity any(measure);
    for (int i = 0; i < 5; ++i) {
      const LabelledShape a = made_shape(rng);
      const LabelledShape b = made_shape(rng);
      const ShapeComparison direct = measure.compare(*measure.prepare(a), *measure.prepare(b));
      const ShapeComparison erased = any.compare(*any.prepare(a), *any.prepare(b));
      EXPECT_EQ(any.distance(*any.prepare(a), *any.prepare(b)), direct.distance);
      EXPECT_EQ(erased.distance, direct.distance);
      EXPECT_EQ(erased.transformation, direct.transformation);
      EXPECT_EQ(erased.correspondence, direct.correspondence);
    }
    EXPECT_EQ(any.claims().rotation, measure.claims().rotation);
  };
  check(ShapeContextSimilarity({.samples = 40}));
  check(TurningSimilarity({}));
  check(HausdorffSimilarity({}));
}

// ---- the motion of least squares ----

TEST(RigidAlignment, NoMotionNearbyIsBetter) {
  Rng rng = property_rng("RigidAlignment.Best");
  for (int i = 0; i < iterations(100); ++i) {
    std::vector<std::pair<Point, Point>> pairs;
    const Affine motion = Affine::rotation(rng.uniform(0.0, 6.3), {3, 4});
    for (int k = 0; k < 12; ++k) {
      const Point a{rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0)};
      pairs.push_back({a, motion(a) + Point{rng.normal(0.0, 5.0), rng.normal(0.0, 5.0)}});
    }
    const auto error = [&](const Affine& map) {
      double sum = 0.0;
      for (const auto& [a, b] : pairs) sum += squared_length(map(a) - b);
      return sum;
    };
    const Affine best = rigid_alignment(pairs);
    EXPECT_NEAR(best.determinant(), 1.0, 1e-12);
    for (const double off : {-1e-3, 1e-3}) {
      EXPECT_GT(error(Affine::rotation(off, best(pairs[0].first)) * best), error(best));
      EXPECT_GT(error(Affine::translation({off, 0.0}) * best), error(best));
      EXPECT_GT(error(Affine::translation({0.0, off}) * best), error(best));
    }
  }
}

TEST(RigidAlignment, IsATranslationWhereNoRotationIsBetterThanAnother) {
  const std::vector<std::pair<Point, Point>> one{{{1, 2}, {5, 7}}};
  EXPECT_EQ(rigid_alignment(one), Affine::translation({4, 5}));
  EXPECT_EQ(rigid_alignment({}), Affine{});
}

}  // namespace
}  // namespace plat::similarity
