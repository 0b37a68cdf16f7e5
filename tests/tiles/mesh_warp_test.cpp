#include "tiles/mesh_warp.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/property.h"

namespace plat::tiles {
namespace {

using plat::testing::property_rng;

constexpr double kRounding_m = 1e-7;

std::vector<ControlPoint> random_controls(Rng& rng, std::size_t count) {
  std::vector<ControlPoint> out;
  for (std::size_t i = 0; i < count; ++i) {
    const Point from{rng.uniform(1000, 2000), rng.uniform(-500, 500)};
    out.push_back({from, from + Point{rng.uniform(-40, 40), rng.uniform(-40, 40)}});
  }
  return out;
}

MeshWarp warp_of(const std::vector<ControlPoint>& controls) {
  const auto warp = MeshWarp::make(controls);
  if (!warp) throw LogicError(warp.error().message);
  return *warp;
}

TEST(MeshWarp, ControlsArriveWhereTheyAreToBe) {
  Rng rng = property_rng("ControlsArrive");
  for (const std::size_t count : {3U, 4U, 50U, 300U}) {
    const auto controls = random_controls(rng, count);
    const MeshWarp warp = warp_of(controls);
    for (const auto& [from, to] : controls) EXPECT_LT(distance(warp(from), to), kRounding_m);
  }
}

TEST(MeshWarp, AnAffineMotionOfTheControlsIsAppliedEverywhere) {
  Rng rng = property_rng("AnAffineMotion");
  const Affine motion{1.1, 0.3, -0.2, 0.9, {50, -70}};
  auto controls = random_controls(rng, 40);
  for (auto& [from, to] : controls) to = motion(from);
  const MeshWarp warp = warp_of(controls);
  for (int i = 0; i < 50; ++i) {
    const Point p{rng.uniform(0, 3000), rng.uniform(-1500, 1500)};
    EXPECT_LT(distance(warp(p), motion(p)), 1e-6);
  }
}

TEST(MeshWarp, BendsAsThinPlateSplinesDo) {
  // Four corners stay, the middle is lifted by one: U of the corners' distances gives the weights.
  std::vector<ControlPoint> controls;
  for (const Point p : {Point{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) controls.push_back({p, p});
  controls.push_back({{0, 0}, {1, 0}});
  const MeshWarp warp = warp_of(controls);
  const auto u = [](double r) { return r * r * std::log(r); };
  // By symmetry f(p) = c + w (sum of U to the corners) - 4 w U(p).
  const double side = 2.0 * u(2.0) + u(std::sqrt(8.0)) - 4.0 * u(std::sqrt(2.0));
  const double w = 1.0 / (4.0 * u(std::sqrt(2.0)) - side);
  const double c = 1.0 - 4.0 * w * u(std::sqrt(2.0));
  const Point p{0.5, 0.0};
  const double expected =
      c + w * (2.0 * u(std::hypot(0.5, 1.0)) + 2.0 * u(std::hypot(1.5, 1.0))) - 4.0 * w * u(0.5);
  EXPECT_NEAR(warp(p).x - p.x, expected, kRounding_m);
  EXPECT_NEAR(warp(p).y, 0.0, kRounding_m);
}

TEST(MeshWarp, ControlsThatDecideNothingAreAFailure) {
  const auto code = [](const std::vector<ControlPoint>& controls) {
    const auto warp = MeshWarp::make(controls);
    return warp ? FailureCode{} : warp.error().code;
  };
  EXPECT_EQ(code({{{0, 0}, {1, 1}}, {{5, 0}, {5, 0}}}), FailureCode::kOutOfRange);
  EXPECT_EQ(code({{{0, 0}, {1, 1}}, {{5, 5}, {5, 0}}, {{9, 9}, {5, 0}}}), FailureCode::kOutOfRange);
  EXPECT_EQ(code({{{0, 0}, {1, 1}}, {{5, 5}, {5, 0}}, {{9, 0}, {5, 0}}, {{9, 0}, {5, 1}}}),
            FailureCode::kOutOfRange);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code({{{0, 0}, {1, 1}}, {{5, 5}, {kNaN, 0}}, {{9, 0}, {5, 0}}}),
            FailureCode::kOutOfRange);
  const auto said = [](const std::vector<ControlPoint>& controls) {
    return MeshWarp::make(controls).error().message;
  };
  EXPECT_EQ(said({{{0, 0}, {1, 1}}, {{5, 5}, {5, 0}}, {{9, 9}, {5, 0}}}),
            "the control points lie on one line");
  EXPECT_EQ(said({{{0, 0}, {1, 1}}, {{5, 5}, {kNaN, 0}}, {{9, 0}, {5, 0}}}),
            "a control point is not finite");
  EXPECT_EQ(code(std::vector<ControlPoint>(MeshWarp::kMostControls + 1)),
            FailureCode::kTooManyVertices);
}

TEST(FittedAffine, FindsTheMapThatPointsWentThrough) {
  Rng rng = property_rng("FindsTheMap");
  const Affine map{1.2, -0.3, 0.5, 0.7, {900, -40}};
  std::vector<Point> from;
  std::vector<Point> to;
  for (int i = 0; i < 6; ++i) {
    from.push_back({rng.uniform(500, 540), rng.uniform(0, 30)});
    to.push_back(map(from.back()));
  }
  const AffineFit fit = fitted_affine(from, to);
  EXPECT_NEAR(fit.map.xx, map.xx, 1e-9);
  EXPECT_NEAR(fit.map.xy, map.xy, 1e-9);
  EXPECT_NEAR(fit.map.yx, map.yx, 1e-9);
  EXPECT_NEAR(fit.map.yy, map.yy, 1e-9);
  EXPECT_LT(distance(fit.map(from[0]), to[0]), kRounding_m);
  EXPECT_LT(fit.residual_m, kRounding_m);
}

TEST(FittedAffine, SaysHowFarThePointsAreFromAnyAffineMap) {
  // A square whose corners alternate by 1: an affine map can do nothing about it.
  const std::vector<Point> from{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const std::vector<Point> to{{0, 1}, {10, -1}, {10, 11}, {0, 9}};
  const AffineFit fit = fitted_affine(from, to);
  EXPECT_NEAR(fit.residual_m, 1.0, kRounding_m);
  EXPECT_NEAR(fit.map.xx, 1.0, 1e-12);
  EXPECT_NEAR(fit.map.yy, 1.0, 1e-12);
}

TEST(FittedAffine, OfALineIsASimilarityAndOfAPointATranslation) {
  const std::vector<Point> line{{0, 0}, {1, 1}, {2, 2}};
  const std::vector<Point> turned{{5, 0}, {4, 1}, {3, 2}};
  const AffineFit fit = fitted_affine(line, turned);
  EXPECT_NEAR(fit.map.xx, 0.0, 1e-12);
  EXPECT_NEAR(fit.map.yx, 1.0, 1e-12);
  EXPECT_NEAR(fit.map.xy, -1.0, 1e-12);
  EXPECT_NEAR(fit.residual_m, 0.0, kRounding_m);
  const AffineFit point =
      fitted_affine(std::vector<Point>(2, {7, 7}), std::vector<Point>(2, {1, 2}));
  EXPECT_EQ(point.map, Affine::translation({-6, -5}));
}

}  // namespace
}  // namespace plat::tiles
