#include "similarity/box_similarity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::similarity {
namespace {

LabelledShape rectangle(double length, double width) {
  return {{{{0, 0}, {length, 0}, {length, width}, {0, width}}, {}}, {}, ""};
}

ShapeComparison compare(const BoxSimilarity::Options& options, const LabelledShape& a,
                        const LabelledShape& b) {
  const BoxSimilarity measure(options);
  return measure.compare(measure.prepare(a).value(), measure.prepare(b).value());
}

TEST(BoxSimilarity, ComparesAreaAndAspectRatioInLogarithms) {
  // 20 x 10 and 20 x 80: eight times the area, twice the aspect ratio.
  const LabelledShape a = rectangle(20, 10);
  const LabelledShape b = rectangle(20, 80);
  EXPECT_NEAR(compare({1.0, 0.0}, a, b).distance, 3.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(compare({0.0, 3.0}, a, b).distance, 3.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(compare({1.0, 1.0}, a, b).distance, std::sqrt(10.0) * std::log(2.0), 1e-12);
}

TEST(BoxSimilarity, LaysBoxOnBoxWithoutAMirror) {
  Rng rng = testing::property_rng("box_similarity_map");
  const std::vector<Polygon> blocks = testing::synthetic_blocks(rng, testing::iterations(40));
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i) {
    const auto map = compare({}, {blocks[i], {}, ""}, {blocks[i + 1], {}, ""}).transformation;
    ASSERT_TRUE(map);
    EXPECT_GT(map->determinant(), 0.0);
    const OrientedBox from = minimum_area_box(blocks[i]);
    const OrientedBox to = minimum_area_box(blocks[i + 1]);
    EXPECT_NEAR(distance((*map)(from.center), to.center), 0.0, 1e-9);
    const Point end = (*map)(from.center + 0.5 * from.length_m * from.axis);
    EXPECT_NEAR(distance(end, to.center + 0.5 * to.length_m * to.axis), 0.0, 1e-9);
    const Point side = (*map)(from.center + 0.5 * from.width_m * perpendicular(from.axis));
    EXPECT_NEAR(distance(side, to.center + 0.5 * to.width_m * perpendicular(to.axis)), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace plat::similarity
