#include "core/validity.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/working_grid.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat {
namespace {

Ring square(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}
Ring hole(double low, double high) { return {{low, low}, {low, high}, {high, high}, {high, low}}; }

FailureCode code_of(const Polygon& polygon) {
  const auto defect = find_defect(polygon);
  return defect ? defect->code : FailureCode{0};
}

TEST(FindDefect, AcceptsSimplePolygonsWithHoles) {
  EXPECT_FALSE(find_defect({square(0, 30), {hole(2, 10), hole(12, 20)}}));
}

TEST(FindDefect, BowTieIsNotSimple) {
  EXPECT_EQ(code_of({{{0, 0}, {30, 0}, {10, 20}, {20, 20}}, {}}), FailureCode::kNotSimple);
}

TEST(FindDefect, RingThatTouchesItselfInAVertexIsNotSimple) {
  EXPECT_EQ(code_of({{{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}, {}}), FailureCode::kNotSimple);
  EXPECT_EQ(code_of({{{0, 0}, {5, 5}, {10, 0}, {10, 10}, {5, 5}, {0, 10}}, {}}),
            FailureCode::kNotSimple);
}

TEST(FindDefect, RepeatedPointIsNotSimple) {
  EXPECT_EQ(code_of({{{0, 0}, {10, 0}, {10, 0}, {10, 10}}, {}}), FailureCode::kNotSimple);
}

TEST(FindDefect, SpikeIsNotSimple) {
  EXPECT_EQ(code_of({{{0, 0}, {10, 0}, {10, 5}, {20, 5}, {10, 5}, {10, 10}, {0, 10}}, {}}),
            FailureCode::kNotSimple);
}

TEST(FindDefect, SpikeWithoutWidthOverTwoEdgesIsNotSimple) {
  EXPECT_EQ(code_of({{{0, 0}, {10, 0}, {20, 0}, {15, 0}, {10, 10}}, {}}), FailureCode::kNotSimple);
}

TEST(FindDefect, ClockwiseOuterRingIsNotSimple) {
  EXPECT_EQ(code_of({hole(0, 10), {}}), FailureCode::kNotSimple);
}

TEST(FindDefect, TooFewPointsAreEmpty) {
  EXPECT_EQ(code_of({{{0, 0}, {10, 0}}, {}}), FailureCode::kEmptyGeometry);
  EXPECT_EQ(code_of({}), FailureCode::kEmptyGeometry);
}

TEST(FindDefect, BadHolesHaveTheirOwnCode) {
  EXPECT_EQ(code_of({square(0, 10), {square(2, 4)}}), FailureCode::kBadHole) << "orientation";
  EXPECT_EQ(code_of({square(0, 10), {hole(12, 14)}}), FailureCode::kBadHole) << "outside";
  EXPECT_EQ(code_of({square(0, 10), {hole(8, 12)}}), FailureCode::kBadHole) << "across";
  EXPECT_EQ(code_of({square(0, 10), {hole(0, 4)}}), FailureCode::kBadHole) << "along the border";
  EXPECT_EQ(code_of({square(0, 10), {hole(2, 8), hole(4, 6)}}), FailureCode::kBadHole) << "nested";
  EXPECT_EQ(code_of({square(0, 10), {hole(2, 5), hole(4, 7)}}), FailureCode::kBadHole)
      << "crossing";
  EXPECT_EQ(code_of({square(0, 10), {hole(2, 5), hole(2, 5)}}), FailureCode::kBadHole) << "equal";
  EXPECT_EQ(code_of({square(0, 10), {hole(0, 10)}}), FailureCode::kBadHole) << "whole";
}

TEST(FindDefect, HoleTouchingTheBorderInAPointIsBadButValidForOgc) {
  const Polygon touching{square(0, 10), {{{0, 5}, {5, 7}, {5, 3}}}};
  EXPECT_EQ(code_of(touching), FailureCode::kBadHole);
  EXPECT_FALSE(find_ogc_defect(touching));
  EXPECT_TRUE(find_ogc_defect({square(0, 10), {hole(0, 4)}})) << "along an edge";
}

TEST(FindDefect, IsExactToOneGridStep) {
  const double h = kGridStep_m;
  EXPECT_FALSE(find_defect({{{0, 0}, {30000, 0}, {30000, 10}, {15000, h}, {0, 10}}, {}}));
  EXPECT_TRUE(find_defect({{{0, 0}, {30000, 0}, {30000, 10}, {15000, 0}, {0, 10}}, {}}));
}

/// By brute force, the same answer as by the sweep.
bool is_simple_by_brute_force(const Ring& ring) {
  const std::size_t n = ring.size();
  const auto sign = [](double x) { return (x > 0.0) - (x < 0.0); };
  const auto on = [](Point a, Point b, Point p) {
    return orientation(a, b, p) == 0.0 && dot(p - a, p - b) <= 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % n];
    if (a == b) return false;
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i && k != (i + 1) % n && on(a, b, ring[k])) return false;
      const Point c = ring[k];
      const Point d = ring[(k + 1) % n];
      if (sign(orientation(a, b, c)) * sign(orientation(a, b, d)) < 0 &&
          sign(orientation(c, d, a)) * sign(orientation(c, d, b)) < 0) {
        return false;
      }
    }
  }
  return signed_area_m2(ring) > 0.0;
}

TEST(FindDefect, AgreesWithBruteForceOnCrampedRings) {
  Rng rng = testing::property_rng("FindDefect.Brute");
  int simple = 0;
  int defective = 0;
  for (int i = 0; i < testing::iterations(5000); ++i) {
    Ring ring;
    const std::uint64_t n = 3 + rng.index(4);
    for (std::uint64_t k = 0; k < n; ++k)
      ring.push_back({static_cast<double>(rng.index(5)), static_cast<double>(rng.index(5))});
    const bool expected = is_simple_by_brute_force(ring);
    ASSERT_EQ(!find_defect({ring, {}}), expected) << ::testing::PrintToString(ring.size());
    (expected ? simple : defective) += 1;
  }
  EXPECT_GT(simple, testing::iterations(5000) / 20);
  EXPECT_GT(defective, testing::iterations(5000) / 20);
}

TEST(AdmitPolygon, NotANumberAndFarAwayAreNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e12}) {
    const auto admitted = admit_polygon({{{0, 0}, {10, 0}, {10, bad}}, {}}, 100);
    ASSERT_FALSE(admitted);
    EXPECT_EQ(admitted.error().code, FailureCode::kNotFinite);
  }
}

TEST(AdmitPolygon, NotANumberInAHoleIsSeen) {
  const auto admitted = admit_polygon({square(0, 10), {{{2, 2}, {2, std::nan("")}, {4, 4}}}}, 100);
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().code, FailureCode::kNotFinite);
}

TEST(AdmitPolygon, WhatVanishesOnTheGridIsEmpty) {
  const auto admitted = admit_polygon({{{0, 0}, {1e-4, 0}, {0, 1e-4}}, {}}, 100);
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().code, FailureCode::kEmptyGeometry);
}

TEST(AdmitPolygon, TooManyVerticesAreCountedOverAllRings) {
  EXPECT_TRUE(admit_polygon({square(0, 10), {hole(2, 4)}}, 8));
  const auto admitted = admit_polygon({square(0, 10), {hole(2, 4)}}, 7);
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().code, FailureCode::kTooManyVertices);
}

TEST(AdmitPolygon, TooWideForExactProductsIsRefused) {
  const auto admitted = admit_polygon({{{0, 0}, {40000, 0}, {40000, 10}}, {}}, 100);
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().code, FailureCode::kNotFinite);
}

TEST(AdmitPolygon, ClockwiseInputIsTurned) {
  const auto admitted = admit_polygon({hole(0, 10), {}}, 100);
  ASSERT_TRUE(admitted);
  EXPECT_GT(signed_area_m2(admitted->outer), 0.0);
}

TEST(AdmitPolygon, AdmittedIsAdmittedUnchangedAgain) {
  Rng rng = testing::property_rng("AdmitPolygon.Again");
  for (const Polygon& polygon : testing::synthetic_blocks(rng, testing::iterations(100)))
    EXPECT_EQ(*admit_polygon(polygon, 1000), polygon);
}

TEST(AdmitPolygon, TenThousandVerticesTakeLessThanASecond) {
  Ring circle;
  for (int i = 0; i < 10'000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 10'000;
    circle.push_back({4000.0 * std::cos(angle), 4000.0 * std::sin(angle)});
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(admit_polygon({circle, {}}, 20'000));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

}  // namespace
}  // namespace plat
