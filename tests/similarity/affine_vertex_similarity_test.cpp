#include "similarity/affine_vertex_similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "similarity/affine_distortion.h"
#include "similarity/outline_corners.h"
#include "similarity/plain_vertex_mapping.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::similarity {
namespace {

using testing::iterations;
using testing::property_rng;
using Options = AffineVertexSimilarity::Options;

LabelledShape shape_of(Ring ring, std::vector<EdgeLabel> edges = {}) {
  return {{std::move(ring), {}}, std::move(edges), ""};
}

LabelledShape rectangle(double length, double width) {
  return shape_of({{0, 0}, {length, 0}, {length, width}, {0, width}});
}

ShapeComparison compare(const Options& options, const LabelledShape& a, const LabelledShape& b) {
  const AffineVertexSimilarity measure(options);
  const auto pa = measure.prepare(a).value();
  const auto pb = measure.prepare(b).value();
  const ShapeComparison out = measure.compare(pa, pb);
  EXPECT_EQ(measure.distance(pa, pb), out.distance);
  return out;
}

double distance(const Options& options, const LabelledShape& a, const LabelledShape& b) {
  return compare(options, a, b).distance;
}

/// A star-shaped lot, all its vertices corners, on the working grid; every other one has labels.
LabelledShape random_lot(Rng& rng, int min_corners = 3, int max_corners = 8) {
  for (;;) {
    const int n =
        min_corners +
        static_cast<int>(rng.index(static_cast<std::uint64_t>(max_corners - min_corners + 1)));
    const Polygon raw{testing::star_ring(rng, n, 8, 20, {rng.uniform(-99, 99), 50}), {}};
    const auto polygon = admit_polygon(raw, 100);
    if (!polygon) continue;
    if (outline_corners(polygon->outer, 100).size() != polygon->outer.size()) continue;
    LabelledShape out{*polygon, {}, ""};
    for (std::size_t i = 0; i < polygon->outer.size() && rng.index(2) == 0; ++i)
      out.edges.push_back(static_cast<EdgeLabel>(rng.index(3)));
    if (out.edges.size() != polygon->outer.size()) out.edges.clear();
    return out;
  }
}

TEST(AffineVertexSimilarity, AnOutlineOnItselfIsZeroToTheLastBit) {
  Rng rng = property_rng("affine_vertex_self");
  for (int i = 0; i < iterations(200); ++i) {
    const LabelledShape lot = random_lot(rng, 3, 20);
    const ShapeComparison self = compare({}, lot, lot);
    EXPECT_EQ(self.distance, 0.0);
    for (const auto& [p, q] : self.correspondence) EXPECT_EQ(p, q);
  }
  const LabelledShape sliver = shape_of({{0, 0}, {2000, 0}, {2000, 0.001}, {0, 0.001}});
  EXPECT_EQ(distance({}, sliver, sliver), 0.0);
}

TEST(AffineVertexSimilarity, WeighsTheTermsOfEquation4) {
  const LabelledShape square = rectangle(10, 10);
  const auto only = [](double scale, double aspect, double shear) {
    return Options{
        .scale_weight = scale, .aspect_weight = aspect, .shear_weight = shear, .alpha = 0.0};
  };
  const double stretched = std::sqrt(2.5) - 1.0;  // |(2, 1)| over sqrt 2
  EXPECT_NEAR(distance(only(1, 1, 1), square, rectangle(20, 20)), 1.0, 1e-12);
  EXPECT_NEAR(distance(only(1, 1, 1), square, rectangle(20, 10)), stretched + 1.0, 1e-12);
  EXPECT_NEAR(distance(only(3, 0, 0), square, rectangle(20, 10)), 3.0 * stretched, 1e-12);
  EXPECT_NEAR(distance(only(0, 3, 0), square, rectangle(20, 10)), 3.0, 1e-12);
  const LabelledShape sheared = shape_of({{0, 0}, {10, 0}, {20, 10}, {10, 10}});
  // Two shifts shear by 45 degrees, the other two by 135.
  EXPECT_NEAR(distance(only(0, 0, 1), square, sheared), 0.5, 1e-12);
  EXPECT_NEAR(distance(only(0, 0, 0), square, sheared), 0.0, 1e-12);
}

TEST(AffineVertexSimilarity, MismatchIsTheSummedDistanceOfCorners) {
  // A kite whose two middle corners lie 1 m to the left of the square's: the best affine map moves
  // all corners by half a metre on, or against, each other.
  const LabelledShape square = shape_of({{10, 0}, {0, 10}, {-10, 0}, {0, -10}});
  const LabelledShape kite = shape_of({{11, 0}, {1, 10}, {-9, 0}, {-1, -10}});
  Options metres{.alpha = 1.0, .perimeter = PerimeterUnit::kMetres};
  // Residuals of corners 1 to 4 about the affine map: +r, -r, +r, -r with r the alternating mean of
  // the offsets (1, 0), (1, 0), (1, 0), (-1, 0): (1 - 1 + 1 + 1) / 4 = 0.5.
  EXPECT_NEAR(distance(metres, square, kite), 4.0 * 0.5, 1e-12);
  const double perimeter = perimeter_m(kite.polygon);
  EXPECT_NEAR(distance({.alpha = 1.0}, square, kite), 2.0 / perimeter, 1e-12);
  const double half = distance({.alpha = 0.5}, square, kite);
  const double distortion = distance({.alpha = 0.0}, square, kite);
  EXPECT_GE(half, 0.5 * distortion + 0.5 * 2.0 / perimeter - 1e-12);
}

TEST(AffineVertexSimilarity, IsThatOfPlainRecursionOverAllMappings) {
  Rng rng = property_rng("affine_vertex_oracle");
  int removed = 0;
  int relaxed = 0;
  const int count = iterations(1500);
  for (int i = 0; i < count; ++i) {
    Options options{.scale_weight = rng.uniform(0, 2),
                    .aspect_weight = rng.uniform(0, 2),
                    .shear_weight = rng.uniform(0, 2),
                    .alpha = rng.uniform_01(),
                    .area_loss_01 = rng.index(4) == 0 ? 1.0 : rng.uniform(0.02, 0.4)};
    if (rng.index(2) == 0) options.labels = LabelRule::kIgnored;
    if (rng.index(2) == 0) options.perimeter = PerimeterUnit::kMetres;
    const LabelledShape a = random_lot(rng);
    const LabelledShape b = random_lot(rng);
    const ShapeComparison got = compare(options, a, b);
    const testing::PlainVertexMapping plain = testing::plain_vertex_mapping(options, a, b);
    removed += a.polygon.outer.size() != b.polygon.outer.size() ? 1 : 0;
    if (!std::isfinite(plain.error)) {
      ++relaxed;
      EXPECT_GE(got.distance, AffineVertexSimilarity::kRelaxationPenalty);
      continue;
    }
    ASSERT_NEAR(got.distance, plain.error, 1e-9 * (1.0 + plain.error)) << "case " << i;
  }
  EXPECT_GT(removed, count / 2);
  EXPECT_GT(relaxed, count / 50);
  EXPECT_LT(relaxed, count / 2);
}

/// What is left is orthogonal to the points and sums up to nothing: the normal equations.
void expect_least_squares(const Affine& map, const std::vector<std::pair<Point, Point>>& pairs) {
  Point sum;
  Point along_x;
  Point along_y;
  for (const auto& [p, q] : pairs) {
    const Point left = q - map(p);
    sum = sum + left;
    along_x = along_x + p.x * left;
    along_y = along_y + p.y * left;
  }
  for (const Point each : {sum, along_x, along_y}) EXPECT_NEAR(length(each), 0.0, 1e-6);
}

TEST(AffineVertexSimilarity, TheTransformationIsWhatTheDistanceWasMeasuredOn) {
  Rng rng = property_rng("affine_vertex_transformation");
  int inverted = 0;
  for (int i = 0; i < iterations(300); ++i) {
    Options options;
    if (rng.index(2) == 0) options.frame = DistortionFrame::kTileAxes;
    options.labels = LabelRule::kIgnored;
    options.area_loss_01 = 1.0;
    const LabelledShape a = random_lot(rng);
    const LabelledShape b = random_lot(rng);
    const ShapeComparison got = compare(options, a, b);
    if (got.distance > AffineVertexSimilarity::kRelaxationPenalty) continue;
    const bool is_inverted = a.polygon.outer.size() < b.polygon.outer.size();
    inverted += is_inverted ? 1 : 0;
    ASSERT_TRUE(got.transformation);
    EXPECT_GT(got.transformation->determinant(), 0.0);
    expect_least_squares(*got.transformation, got.correspondence);
    EXPECT_EQ(got.correspondence.size(), std::min(a.polygon.outer.size(), b.polygon.outer.size()));
    if (is_inverted) continue;
    const Affine map = *got.transformation;
    double mismatch_m = 0.0;
    for (const auto& [p, q] : got.correspondence) mismatch_m += plat::distance(map(p), q);
    double error = 0.5 * mismatch_m / perimeter_m(b.polygon);
    if (options.frame == DistortionFrame::kCityAxes) {
      const AffineDistortion d = affine_distortion(map);
      error += 0.5 * (d.scale + d.aspect + d.shear);
      EXPECT_NEAR(got.distance, error, 1e-9 * (1.0 + error));
    } else {
      EXPECT_GE(got.distance, error - 1e-9);
    }
  }
  EXPECT_GT(inverted, 50);
}

TEST(AffineVertexSimilarity, CorrespondenceRunsAlongTheFirstOutline) {
  Rng rng = property_rng("affine_vertex_correspondence");
  for (int i = 0; i < iterations(200); ++i) {
    const LabelledShape a = random_lot(rng);
    const LabelledShape b = random_lot(rng);
    const auto pairs = compare({.labels = LabelRule::kIgnored}, a, b).correspondence;
    // Both sides run counter-clockwise: descents of the place in the ring, at most one.
    const auto descents = [&](const Ring& ring, bool is_first) {
      std::vector<std::ptrdiff_t> places;
      for (const auto& [p, q] : pairs) {
        const Point at = is_first ? p : q;
        places.push_back(
            std::ranges::min_element(ring, {}, [&](Point v) { return plat::distance(v, at); }) -
            ring.begin());
        EXPECT_NEAR(plat::distance(ring[static_cast<std::size_t>(places.back())], at), 0.0, 1e-9);
      }
      int count = 0;
      for (std::size_t k = 0; k < places.size(); ++k)
        count += places[k] > places[(k + 1) % places.size()] ? 1 : 0;
      return count;
    };
    EXPECT_EQ(descents(a.polygon.outer, true), 1);
    EXPECT_EQ(descents(b.polygon.outer, false), 1);
  }
}

TEST(AffineVertexSimilarity, StreetsLieOnStreets) {
  const EdgeLabel s = EdgeLabel::kStreet;
  const EdgeLabel p = EdgeLabel::kProperty;
  const EdgeLabel u = EdgeLabel::kUnknown;
  // Fronts on the short and on the long side: only a quarter turn lays street on street.
  const LabelledShape narrow = shape_of({{0, 0}, {10, 0}, {10, 20}, {0, 20}}, {s, p, p, p});
  const LabelledShape wide = shape_of({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {s, p, p, p});
  const LabelledShape unknown = shape_of({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {u, u, u, u});
  EXPECT_NEAR(distance({.labels = LabelRule::kIgnored}, narrow, wide), 0.0, 1e-12);
  // The map is then diag(2, 1/2): aspect 4, |a + b| = |(2, 1/2)|.
  EXPECT_NEAR(distance({}, narrow, wide), 0.5 * (3.0 + std::sqrt(4.25 / 2.0) - 1.0), 1e-12);
  EXPECT_NEAR(distance({}, narrow, unknown), 0.0, 1e-12);
  EXPECT_NEAR(distance({}, unknown, wide), 0.0, 1e-12);
}

TEST(AffineVertexSimilarity, WhereNoLabelsMatchTheyAreGivenUpAtAPrice) {
  const EdgeLabel s = EdgeLabel::kStreet;
  const EdgeLabel p = EdgeLabel::kProperty;
  const LabelledShape island = shape_of({{0, 0}, {10, 0}, {10, 20}, {0, 20}}, {s, s, s, s});
  const LabelledShape inner = shape_of({{0, 0}, {10, 0}, {10, 20}, {0, 20}}, {p, p, p, p});
  EXPECT_NEAR(distance({}, island, inner), AffineVertexSimilarity::kRelaxationPenalty, 1e-12);
}

TEST(AffineVertexSimilarity, WhereNoRemovalKeepsTheAreaTheSmallestTrianglesGo) {
  // A square on a triangle: any corner that goes takes half of it.
  const LabelledShape square = rectangle(10, 10);
  const LabelledShape triangle = shape_of({{0, 0}, {10, 0}, {0, 10}});
  EXPECT_NEAR(distance({.area_loss_01 = 0.49}, square, triangle),
              2.0 * AffineVertexSimilarity::kRelaxationPenalty, 1e-12);
  EXPECT_NEAR(distance({.area_loss_01 = 0.51}, square, triangle), 0.0, 1e-12);
}

TEST(AffineVertexSimilarity, ARemovalThatAddsAreaCountsToo) {
  const LabelledShape dart = shape_of({{0, 0}, {10, 0}, {10, 10}, {8, 2}});
  const LabelledShape triangle = shape_of({{0, 0}, {10, 0}, {10, 10}});
  // The notch has 30 of the dart's 20 m2.
  EXPECT_GE(distance({.area_loss_01 = 0.4}, dart, triangle),
            2.0 * AffineVertexSimilarity::kRelaxationPenalty);
}

TEST(AffineVertexSimilarity, ExchangesRolesWhereTheFirstHasFewerCorners) {
  Rng rng = property_rng("affine_vertex_roles");
  int exchanged = 0;
  for (int i = 0; i < iterations(200); ++i) {
    const LabelledShape a = random_lot(rng);
    const LabelledShape b = random_lot(rng);
    if (a.polygon.outer.size() == b.polygon.outer.size()) continue;
    ++exchanged;
    const ShapeComparison there = compare({}, a, b);
    const ShapeComparison back = compare({}, b, a);
    EXPECT_EQ(there.distance, back.distance);
    ASSERT_EQ(there.correspondence.size(), back.correspondence.size());
    for (const auto& [p, q] : there.correspondence)
      EXPECT_TRUE(std::ranges::find(back.correspondence, std::pair(q, p)) !=
                  back.correspondence.end());
  }
  EXPECT_GT(exchanged, 100);
}

TEST(AffineVertexSimilarity, DoesNotMirror) {
  const LabelledShape left = shape_of({{0, 0}, {30, 0}, {30, 10}, {20, 12}, {0, 5}});
  LabelledShape right = left;
  for (Point& q : right.polygon.outer) q.x = -q.x;
  std::ranges::reverse(right.polygon.outer);
  EXPECT_GT(distance({}, left, right), 0.02);
}

TEST(AffineVertexSimilarity, IsFiniteForAnyPair) {
  Rng rng = property_rng("affine_vertex_finite");
  std::vector<LabelledShape> shapes;
  for (const Polygon& block : testing::synthetic_blocks(rng, iterations(25)))
    shapes.push_back({block, {}, ""});
  // Needles, combs, slivers, dust and continents.
  shapes.push_back(shape_of({{0, 0}, {1000, 0}, {1000, 1.0 / 1024}}));
  shapes.push_back(shape_of({{0, 0}, {0.001, 0}, {0.001, 0.001}, {0, 0.001}}));
  shapes.push_back(rectangle(1e6, 1e6));
  shapes.push_back(rectangle(1e6, 0.001));
  Ring comb{{0, 10}, {0, 0}};
  for (int i = 0; i < 12; ++i) {
    comb.push_back({4.0 * i + 1, 0});
    comb.push_back({4.0 * i + 1, 9});
    comb.push_back({4.0 * i + 4, 9});
    comb.push_back({4.0 * i + 4, 0});
  }
  comb.push_back({60, 0});
  comb.push_back({60, 10});
  shapes.push_back(shape_of(comb));
  for (const double loss : {0.0, 0.1, 1.0}) {
    for (const int corners : {3, 8, 12}) {
      const AffineVertexSimilarity measure(Options{.area_loss_01 = loss, .max_corners = corners});
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const LabelledShape& other : shapes) {
          const auto a = measure.prepare(shapes[i]).value();
          const auto b = measure.prepare(other).value();
          EXPECT_LE(a.outline.count, static_cast<std::size_t>(corners));
          for (std::size_t n = 1; n <= a.outline.count; ++n)  // 12 over 6
            EXPECT_LE(a.outline.choice_ends[n] - a.outline.choice_ends[n - 1], 924U);
          const double d = measure.distance(a, b);
          EXPECT_TRUE(std::isfinite(d) && d >= 0.0) << i << ' ' << d;
        }
      }
    }
  }
}

TEST(AffineVertexSimilarity, TileAxesDoNotDependOnTheDirectionOfTheCity) {
  Rng rng = property_rng("affine_vertex_frame");
  int differ = 0;
  for (int i = 0; i < iterations(100); ++i) {
    const LabelledShape a = random_lot(rng);
    const LabelledShape b = random_lot(rng);
    LabelledShape turned = a;
    turned.polygon = transformed(Affine::rotation(rng.uniform(0, 6)), a.polygon);
    const Options tile{.labels = LabelRule::kIgnored, .frame = DistortionFrame::kTileAxes};
    EXPECT_NEAR(distance(tile, turned, b), distance(tile, a, b), 1e-9);
    const Options city{.labels = LabelRule::kIgnored};
    differ += std::abs(distance(city, turned, b) - distance(city, a, b)) > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(differ, 20);
}

}  // namespace
}  // namespace plat::similarity
