#include "imagery/scanline_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "imagery/made_parcels.h"
#include "imagery/warp_map.h"
#include "support/property.h"

namespace plat::imagery {
namespace {

using plat::testing::any_parcel;
using plat::testing::iterations;
using plat::testing::property_rng;
using plat::testing::rectangle;
using plat::testing::shape;
using plat::testing::strip_parcel;

double quad_area(const Quad& quad) { return signed_area_m2(quad); }

double sum_of_areas(const std::vector<Quad>& quads) {
  double sum = 0.0;
  for (const Quad& quad : quads) sum += quad_area(quad);
  return sum;
}

/// Least and largest corner turn of a quadrilateral, m2.
double least_turn(const Quad& q) {
  double least = 1e30;
  for (std::size_t i = 0; i < 4; ++i)
    least = std::min(least, orientation(q[(i + 3) % 4], q[i], q[(i + 1) % 4]));
  return least;
}

/// The twin: how often lines across the axis, between and through the vertices, meet the contour.
bool brute_force_is_monotone(const ParcelShape& parcel, ScanAxis axis) {
  const Point u = axis == ScanAxis::kMain ? parcel.box.axis : perpendicular(parcel.box.axis);
  const Ring& ring = parcel.polygon.outer;
  std::vector<double> at;
  for (const Point p : ring) at.push_back(dot(p - ring.front(), u));
  std::vector<double> sorted = at;
  std::sort(sorted.begin(), sorted.end());
  constexpr double kSame_m = 1e-7;
  for (std::size_t k = 0; k + 1 < sorted.size(); ++k) {
    if (sorted[k + 1] - sorted[k] < kSame_m) continue;
    const double line = 0.5 * (sorted[k] + sorted[k + 1]);
    int crossings = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
      crossings += (at[i] < line) != (at[(i + 1) % at.size()] < line) ? 1 : 0;
    if (crossings != 2) return false;
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double here = at[i];
    if (std::abs(at[(i + 1) % at.size()] - here) > kSame_m) continue;
    if (here - sorted.front() > kSame_m && sorted.back() - here > kSame_m) return false;
  }
  return true;
}

void expect_one_to_one(const WarpGrid& grid, const ParcelShape& source, const ParcelShape& target) {
  ASSERT_EQ(grid.target.size() + 1, grid.lines.size());
  ASSERT_EQ(grid.source.size(), grid.target.size());
  const double sign = is_mirrored(grid.symmetry) ? -1.0 : 1.0;
  for (std::size_t k = 0; k < grid.target.size(); ++k) {
    EXPECT_LT(grid.lines[k], grid.lines[k + 1]);
    EXPECT_GT(quad_area(grid.target[k]), 0.0);
    EXPECT_GT(sign * quad_area(grid.source[k]), 0.0);
    EXPECT_GT(least_turn(grid.target[k]), -1e-6);
    if (sign > 0) {
      EXPECT_GT(least_turn(grid.source[k]), -1e-6);
    }
    if (k == 0) continue;
    for (const auto* quads : {&grid.target, &grid.source}) {  // guarantee 2
      EXPECT_EQ((*quads)[k - 1][1], (*quads)[k][0]);
      EXPECT_EQ((*quads)[k - 1][2], (*quads)[k][3]);
    }
  }
  if (grid.kind == WarpKind::kBox || grid.kind == WarpKind::kSimplified) return;
  const double area = signed_area_m2(target.polygon.outer);
  EXPECT_NEAR(sum_of_areas(grid.target), area, 1e-6 * area);
  const double source_area = signed_area_m2(source.polygon.outer);
  EXPECT_NEAR(sign * sum_of_areas(grid.source), source_area, 1e-6 * source_area);
}

TEST(ScanlineGrid, MonotoneIsWhatLinesAcrossSay) {
  Rng rng = property_rng("ScanlineGrid.MonotoneIsWhatLinesAcrossSay");
  int monotone = 0;
  const int n = iterations(2000);
  for (int i = 0; i < n; ++i) {
    const ParcelShape parcel = shape(any_parcel(rng));
    for (const ScanAxis axis : {ScanAxis::kMain, ScanAxis::kOther}) {
      EXPECT_EQ(is_monotone(parcel, axis), brute_force_is_monotone(parcel, axis));
      monotone += is_monotone(parcel, axis) ? 1 : 0;
    }
  }
  EXPECT_GT(monotone, n / 4);
  EXPECT_LT(monotone, 2 * n - n / 4);
}

TEST(ScanlineGrid, AStepIsNotMonotoneAndAPerpendicularEndIs) {
  const Polygon step{{{0, 0}, {40, 0}, {40, 10}, {20, 10}, {20, 20}, {0, 20}}, {}};
  EXPECT_FALSE(is_monotone(shape(step), ScanAxis::kMain));
  EXPECT_TRUE(is_monotone(shape(rectangle(0, 0, 40, 20)), ScanAxis::kMain));
  EXPECT_TRUE(is_monotone(shape(rectangle(0, 0, 40, 20)), ScanAxis::kOther));
}

TEST(ScanlineGrid, MonotonePairsAreAlwaysWarpedByScanLines) {
  Rng rng = property_rng("ScanlineGrid.MonotonePairsAreAlwaysWarpedByScanLines");
  int pairs = 0;
  for (int i = 0; i < iterations(2000); ++i) {
    const ParcelShape source = shape(strip_parcel(rng));
    const ParcelShape target = shape(strip_parcel(rng));
    if (!is_monotone(source, ScanAxis::kMain) || !is_monotone(target, ScanAxis::kMain)) continue;
    ++pairs;
    EXPECT_EQ(warp_grid(source, target, Symmetry::kKept).kind, WarpKind::kScanLines);
  }
  EXPECT_GT(pairs, iterations(500));
}

TEST(ScanlineGrid, IsOneToOneForEveryPairAndSymmetry) {
  Rng rng = property_rng("ScanlineGrid.IsOneToOneForEveryPairAndSymmetry");
  std::array<int, kWarpKinds.size()> kinds{};
  for (int i = 0; i < iterations(1500); ++i) {
    const ParcelShape source = shape(any_parcel(rng));
    const ParcelShape target = shape(any_parcel(rng));
    const auto symmetry = static_cast<Symmetry>(rng.index(4));
    const WarpGrid grid = warp_grid(source, target, symmetry);
    EXPECT_EQ(grid.symmetry, symmetry);
    ++kinds[static_cast<std::size_t>(grid.kind)];
    expect_one_to_one(grid, source, target);
    if (HasFailure()) return;
  }
  for (const int count : kinds) EXPECT_GT(count, 0);
}

TEST(ScanlineGrid, CornersGoToCornersOfLeaningLots) {
  const Polygon source = rectangle(0, 0, 30, 10);
  const Polygon target{{{0, 0}, {30, 0}, {31, 10}, {1.5, 10}}, {}};
  const WarpGrid grid = warp_grid(shape(source), shape(target), Symmetry::kKept);
  EXPECT_EQ(grid.kind, WarpKind::kScanLines);
  ASSERT_EQ(grid.target.size(), 1U);
  for (const Point corner : target.outer)
    EXPECT_NE(std::find(grid.target[0].begin(), grid.target[0].end(), corner),
              grid.target[0].end());
}

TEST(ScanlineGrid, ATriangleEndsInATip) {
  const Polygon triangle{{{0, 0}, {40, 0}, {20, 8}}, {}};
  const ParcelShape target = shape(triangle);
  const ParcelShape source = shape(rectangle(0, 0, 40, 8));
  const WarpGrid grid = warp_grid(source, target, Symmetry::kKept);
  EXPECT_EQ(grid.kind, WarpKind::kScanLines);
  EXPECT_EQ(grid.target.front()[0], grid.target.front()[3]);
  expect_one_to_one(grid, source, target);
}

TEST(ScanlineGrid, AStepIsFollowedByLeaningLines) {
  const ParcelShape source = shape(rectangle(0, 0, 40, 20));
  const ParcelShape target = shape({{{0, 0}, {40, 0}, {40, 12}, {20, 12}, {20, 20}, {0, 20}}, {}});
  const WarpGrid grid = warp_grid(source, target, Symmetry::kKept);
  EXPECT_EQ(grid.kind, WarpKind::kSlanted);
  expect_one_to_one(grid, source, target);
}

TEST(ScanlineGrid, ASurveyedLotIsScannedWithoutItsNotches) {
  // A lot of Cambridge: its ends have three vertices, half a metre off the line.
  const Polygon lot{
      {{0, 0}, {-9.25, 4.5}, {-11, 0}, {-19.5, -19}, {-8.5, -23.5}, {0, -6.25}, {2.25, -0.5}}, {}};
  const WarpGrid grid = warp_grid(shape(rectangle(0, 0, 28, 12)), shape(lot), Symmetry::kKept);
  EXPECT_EQ(grid.kind, WarpKind::kSimplified);
  EXPECT_GT(grid.simplified_m, 0.0);
  EXPECT_LE(grid.simplified_m, kMostSimplified_m);
  EXPECT_NEAR(sum_of_areas(grid.target), signed_area_m2(lot.outer),
              grid.simplified_m * perimeter_m(lot));
  for (const Quad& quad : grid.target) {
    for (const Point p : quad) EXPECT_LE(boundary_distance_m(lot, p), grid.simplified_m);
  }
}

TEST(ScanlineGrid, WhatCannotBeScannedIsLaidBoxOnBox) {
  const ParcelShape source = shape(rectangle(0, 0, 40, 20));
  // A lot around a yard that is open to a hook: lines across either axis meet it three times.
  const ParcelShape target = shape({{{0, 0},
                                     {40, 0},
                                     {40, 20},
                                     {10, 20},
                                     {10, 8},
                                     {15, 8},
                                     {15, 15},
                                     {35, 15},
                                     {35, 5},
                                     {5, 5},
                                     {5, 20},
                                     {0, 20}},
                                    {}});
  const WarpGrid grid = warp_grid(source, target, Symmetry::kKept);
  EXPECT_EQ(grid.kind, WarpKind::kBox);
  EXPECT_NEAR(sum_of_areas(grid.target), target.box.area_m2(), 1e-9);
  EXPECT_NEAR(sum_of_areas(grid.source), source.box.area_m2(), 1e-9);
}

TEST(ScanlineGrid, SamplesAreThePapersGridInBothParcels) {
  Rng rng = property_rng("ScanlineGrid.SamplesAreThePapersGridInBothParcels");
  const ParcelShape source = shape(strip_parcel(rng));
  const ParcelShape target = shape(strip_parcel(rng));
  const WarpGrid grid = warp_grid(source, target, Symmetry::kKept);
  const GridSamples samples = grid_samples(grid, 9, 5);
  ASSERT_EQ(samples.target.size(), 45U);
  ASSERT_EQ(samples.source.size(), 45U);
  const WarpMap map(grid);
  for (std::size_t i = 0; i < 45; ++i)
    EXPECT_NEAR(distance(map.source_of(samples.target[i]).at, samples.source[i]), 0.0, 1e-5);
}

WarpGrid exchanged(const WarpGrid& grid) {
  WarpGrid other = grid;
  std::swap(other.source, other.target);
  return other;
}

TEST(WarpMap, GoesThereAndBack) {
  Rng rng = property_rng("WarpMap.GoesThereAndBack");
  int checked = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const ParcelShape source = shape(any_parcel(rng));
    const ParcelShape target = shape(any_parcel(rng));
    const WarpGrid grid = warp_grid(source, target, Symmetry::kTurned);
    const WarpMap map(grid);
    const WarpMap back(exchanged(grid));
    const Box box = box_of(target.polygon);
    std::size_t column = 0;
    for (int k = 0; k < 50; ++k) {
      const Point p{rng.uniform(box.min.x, box.max.x), rng.uniform(box.min.y, box.max.y)};
      if (locate(target.polygon, p) != Side::kInside) continue;
      // Near a tip all goes to a point, and notches to the contour.
      if (boundary_distance_m(target.polygon, p) < 0.05 + grid.simplified_m) continue;
      const SourcePoint there = map.source_of(p, column);
      EXPECT_NEAR(distance(back.source_of(there.at).at, p), 0.0, 1e-4);
      if (grid.kind != WarpKind::kBox && grid.kind != WarpKind::kSimplified) {
        EXPECT_NE(locate(source.polygon, lerp(there.at, interior_point(source.polygon), 1e-9)),
                  Side::kOutside);
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, iterations(4000));
}

TEST(WarpMap, JacobianIsTheDerivative) {
  Rng rng = property_rng("WarpMap.JacobianIsTheDerivative");
  const double step_m = 1e-6;
  int checked = 0;
  for (int i = 0; i < iterations(300); ++i) {
    const ParcelShape target = shape(strip_parcel(rng));
    const WarpGrid grid = warp_grid(shape(strip_parcel(rng)), target, Symmetry::kMirroredAlong);
    const WarpMap map(grid);
    const Point p = interior_point(target.polygon);
    std::size_t column = 0;
    const SourcePoint at = map.source_of(p, column);
    const std::size_t found = column;
    const Point east = map.source_of(p + Point{step_m, 0}, column).at;
    if (column != found) continue;
    const Point north = map.source_of(p + Point{0, step_m}, column).at;
    if (column != found) continue;
    const double size = length(at.per_east) + length(at.per_north);
    EXPECT_NEAR(distance((east - at.at) / step_m, at.per_east), 0.0, 1e-3 * size);
    EXPECT_NEAR(distance((north - at.at) / step_m, at.per_north), 0.0, 1e-3 * size);
    ++checked;
  }
  EXPECT_GT(checked, iterations(250));
}

TEST(WarpMap, IsContinuousAcrossColumns) {
  Rng rng = property_rng("WarpMap.IsContinuousAcrossColumns");
  for (int i = 0; i < iterations(200); ++i) {
    const ParcelShape target = shape(strip_parcel(rng));
    const WarpGrid grid = warp_grid(shape(strip_parcel(rng)), target, Symmetry::kKept);
    const WarpMap map(grid);
    for (std::size_t k = 1; k < grid.target.size(); ++k) {
      for (const double b : {0.25, 0.5, 0.75}) {
        const Point p = lerp(grid.target[k][0], grid.target[k][3], b);
        std::size_t left = k - 1;
        std::size_t right = k;
        EXPECT_NEAR(distance(map.source_of(p, left).at, map.source_of(p, right).at), 0.0, 1e-5);
      }
    }
  }
}

TEST(WarpMap, APointJustOutsideGoesToTheContour) {
  const ParcelShape target = shape(rectangle(0, 0, 40, 20));
  const ParcelShape source = shape(rectangle(100, 100, 80, 40));
  const WarpMap map(warp_grid(source, target, Symmetry::kKept));
  EXPECT_NEAR(distance(map.source_of({-0.1, 10}).at, {100, 120}), 0.0, 1e-9);
  EXPECT_NEAR(distance(map.source_of({20, 20.1}).at, {140, 140}), 0.0, 1e-9);
}

TEST(Stretch, OfASquareToARectangle) {
  const SourcePoint at{{0, 0}, {0.5, 0}, {0, 0.25}};
  EXPECT_NEAR(stretch_at(at).singular_ratio, 2.0, 1e-12);
  EXPECT_NEAR(stretch_at(at).area_ratio, 8.0, 1e-12);
}

}  // namespace
}  // namespace plat::imagery
