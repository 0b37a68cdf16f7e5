#include "similarity/shape_similarity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plat::similarity {
namespace {

/// By area only: the least that the concept asks for.
class AreaMeasure {
 public:
  static constexpr std::string_view kName = "area";
  static constexpr std::string_view kSummary = "Difference in area.";
  struct Options {
    double weight = 1.0;
    static constexpr auto fields() {
      return std::tuple{Field{"weight", &Options::weight, 0.0, 10.0, "Factor."}};
    }
  };
  using Prepared = double;

  explicit AreaMeasure(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<Prepared> prepare(const LabelledShape& shape) const {
    const double area = area_m2(shape.polygon);
    if (!(area > 0.0)) return fail(FailureCode::kTooSmall, "no area");
    return area;
  }
  [[nodiscard]] double distance(double a, double b) const {
    return options_.weight * std::abs(a - b);
  }
  [[nodiscard]] ShapeComparison compare(double a, double b) const {
    return {distance(a, b), {}, {}};
  }
  [[nodiscard]] SimilarityClaims claims() const { return {.is_symmetric = true}; }
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(ShapeSimilarity<AreaMeasure> && Registrable<AreaMeasure>);

LabelledShape square(double side) {
  return {{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}, {}, ""};
}

TEST(AnyShapeSimilarity, SaysWhatTheStrategySays) {
  Registry<AnyShapeSimilarity> menu;
  menu.add<AreaMeasure>();
  const AnyShapeSimilarity measure = menu.make("area", {{"weight", 2.0}});
  const auto a = measure.prepare(square(2));
  const auto b = measure.prepare(square(3));
  ASSERT_TRUE(a && b);
  EXPECT_DOUBLE_EQ(measure.distance(*a, *b), 10.0);
  EXPECT_DOUBLE_EQ(measure.compare(*a, *b).distance, 10.0);
  EXPECT_TRUE(measure.claims().is_symmetric);
  EXPECT_EQ(measure.name(), "area");
  EXPECT_EQ(measure.options(), (OptionMap{{"weight", 2.0}}));
  EXPECT_EQ(measure.prepare(square(0)).error().code, FailureCode::kTooSmall);
}

}  // namespace
}  // namespace plat::similarity
