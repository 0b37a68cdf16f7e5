#include "similarity/descriptor_similarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "similarity/shape_descriptor.h"

namespace plat::similarity {
namespace {

constexpr double kPi = std::numbers::pi;

LabelledShape rectangle(double length, double width, const std::string& zone = "") {
  return {{{{0, 0}, {length, 0}, {length, width}, {0, width}}, {}}, {}, zone};
}

double distance(const DescriptorSimilarity::Options& options, const LabelledShape& a,
                const LabelledShape& b) {
  const DescriptorSimilarity measure(options);
  return measure.distance(measure.prepare(a).value(), measure.prepare(b).value());
}

constexpr DescriptorSimilarity::Options kNothing{0, 0, 0, 0, 0};

TEST(ShapeDescriptor, OfARectangle) {
  const ShapeDescriptor s = descriptor_of(rectangle(30, 10, "park"));
  EXPECT_EQ(s.zone, "park");
  EXPECT_DOUBLE_EQ(s.area_m2, 300.0);
  EXPECT_EQ(s.corner_count, 4);
  EXPECT_DOUBLE_EQ(s.mean_angle_rad, 0.5 * kPi);
  EXPECT_NEAR(s.angle_deviation_rad, 0.0, 1e-12);
}

TEST(ShapeDescriptor, OfAReflexCorner) {
  // Five right angles and one of 270 degrees: mean 120, squares 5 * 30^2 + 150^2 = 27,000 of six.
  const LabelledShape shape{{{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}, {}}, {}, ""};
  const ShapeDescriptor s = descriptor_of(shape);
  EXPECT_EQ(s.corner_count, 6);
  EXPECT_NEAR(s.mean_angle_rad, 120.0 * kPi / 180.0, 1e-12);
  EXPECT_NEAR(s.angle_deviation_rad, std::sqrt(4500.0) * kPi / 180.0, 1e-12);
}

TEST(ShapeDescriptor, AreaIsWithoutHolesAndVerticesOnEdgesAreNoCorners) {
  LabelledShape shape = rectangle(30, 10);
  shape.polygon.holes = {{{5, 4}, {5, 6}, {7, 6}, {7, 4}}};
  shape.polygon.outer.insert(shape.polygon.outer.begin() + 1, Point{12, 0});
  const ShapeDescriptor s = descriptor_of(shape);
  EXPECT_DOUBLE_EQ(s.area_m2, 296.0);
  EXPECT_EQ(s.corner_count, 4);
}

TEST(DescriptorSimilarity, EachWeightScalesItsEntryAlone) {
  const LabelledShape square = rectangle(10, 10, "park");
  const LabelledShape twice = rectangle(20, 10, "park");
  const LabelledShape triangle{{{{0, 0}, {20, 0}, {0, 10}}, {}}, {}, "park"};
  DescriptorSimilarity::Options area = kNothing;
  area.area_weight = 3.0;
  EXPECT_NEAR(distance(area, square, twice), 3.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(distance(area, twice, square), 3.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(distance(area, square, triangle), 0.0, 1e-12);
  DescriptorSimilarity::Options corners = kNothing;
  corners.corner_count_weight = 0.5;
  EXPECT_NEAR(distance(corners, square, triangle), 0.5, 1e-12);
  DescriptorSimilarity::Options mean = kNothing;
  mean.mean_angle_weight = 2.0;
  EXPECT_NEAR(distance(mean, square, triangle), 2.0 * (kPi / 2.0 - kPi / 3.0), 1e-12);
  DescriptorSimilarity::Options deviation = kNothing;
  deviation.angle_deviation_weight = 1.0;
  const double low = std::atan2(1.0, 2.0);
  const double third = kPi / 3.0;
  const double sigma = std::sqrt((std::pow(kPi / 2.0 - third, 2) + std::pow(low - third, 2) +
                                  std::pow(kPi / 2.0 - low - third, 2)) /
                                 3.0);
  EXPECT_NEAR(distance(deviation, square, triangle), sigma, 1e-12);
  EXPECT_NEAR(distance(kNothing, square, triangle), 0.0, 1e-12);
}

TEST(DescriptorSimilarity, ZonesThatAreKnownAndDifferAddOneTerm) {
  DescriptorSimilarity::Options zone = kNothing;
  zone.zone_weight = 2.0;
  zone.area_weight = 1.0;
  EXPECT_DOUBLE_EQ(distance(zone, rectangle(9, 5, "park"), rectangle(9, 5, "house")), 2.0);
  EXPECT_DOUBLE_EQ(distance(zone, rectangle(9, 5, "park"), rectangle(9, 5, "park")), 0.0);
  EXPECT_DOUBLE_EQ(distance(zone, rectangle(9, 5, "park"), rectangle(9, 5)), 0.0);
  EXPECT_NEAR(distance(zone, rectangle(9, 5, "park"), rectangle(18, 5, "house")),
              std::hypot(2.0, std::log(2.0)), 1e-12);
}

TEST(DescriptorSimilarity, RefusesWhatHasNoArea) {
  const DescriptorSimilarity measure({});
  const auto code = [&](Ring ring) {
    return measure.prepare({{std::move(ring), {}}, {}, ""}).error().code;
  };
  EXPECT_EQ(code({{0, 0}, {1, 0}}), FailureCode::kTooSmall);
  EXPECT_EQ(code({{0, 0}, {1, 0}, {2, 0}}), FailureCode::kTooSmall);
  EXPECT_EQ(code({{0, 0}, {0, 1}, {1, 0}}), FailureCode::kNotSimple);
  EXPECT_EQ(code({{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}, {1, 1}}),
            FailureCode::kNotFinite);
  EXPECT_THROW((void)measure.prepare({{{{0, 0}, {1, 0}, {0, 1}}, {}}, {EdgeLabel::kStreet}, ""}),
               LogicError);
}

}  // namespace
}  // namespace plat::similarity
