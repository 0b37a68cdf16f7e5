// The contract of ShapeSimilarity, over every registered strategy and many shapes.
#include "similarity/similarity_contract.h"

#include "similarity/twin_measure.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::begun_elsewhere;
using plat::testing::iterations;
using plat::testing::made_shape;
using plat::testing::MeasureFault;
using plat::testing::property_rng;
using plat::testing::ShapeFamily;
using plat::testing::TwinMeasure;
using plat::testing::why_not_in_contract;
using plat::testing::why_wrong_shapes_pass;

/// The outline, or its beginning.
std::string text_of(const LabelledShape& shape) {
  constexpr std::size_t kShown = 12;
  const Ring& ring = shape.polygon.outer;
  std::string out = fmt::format("{} vertices: ", ring.size());
  for (std::size_t i = 0; i < std::min(kShown, ring.size()); ++i)
    out += fmt::format("{{{}, {}}}, ", ring[i].x, ring[i].y);
  return out;
}

// ---- the shapes, and the suite on measures that are wrong ----

TEST(MadeShapes, AreValidWithOneLabelPerEdgeOrNone) {
  Rng rng = property_rng("MadeShapes.Valid");
  int labelled = 0;
  int holed = 0;
  int far = 0;
  constexpr int kShapes = 1000;
  for (int i = 0; i < kShapes; ++i) {
    const LabelledShape shape =
        begun_elsewhere(rng, made_shape(rng, static_cast<ShapeFamily>(i % 10)));
    ASSERT_FALSE(find_ogc_defect(shape.polygon)) << text_of(shape);
    ASSERT_TRUE(shape.edges.empty() || shape.edges.size() == shape.polygon.outer.size());
    labelled += shape.edges.empty() ? 0 : 1;
    holed += shape.polygon.holes.empty() ? 0 : 1;
    far += std::abs(shape.polygon.outer[0].x) > 1e5 ? 1 : 0;
  }
  for (const int some : {labelled, holed, far}) EXPECT_GT(some, kShapes / 20);
}

TEST(MadeShapes, MirroredEdgesKeepTheirLabels) {
  using enum EdgeLabel;
  const LabelledShape shape{
      {{{0, 0}, {4, 0}, {4, 1}, {0, 3}}, {}}, {kStreet, kProperty, kUnknown, kStreet}, ""};
  const LabelledShape mirrored = plat::testing::image_of({.xx = -1.0}, shape);
  EXPECT_FALSE(find_ogc_defect(mirrored.polygon));
  for (std::size_t i = 0; i < 4; ++i) {
    const Point a = mirrored.polygon.outer[i];
    const Point b = mirrored.polygon.outer[(i + 1) % 4];
    const bool is_long_side = a.y == 0.0 && b.y == 0.0;
    const bool is_left_side = a.x == 0.0 && b.x == 0.0;
    EXPECT_EQ(mirrored.edges[i] == kStreet, is_long_side || is_left_side);
  }
}

TEST(SimilarityContract, AcceptsAnHonestMeasureAndRefusesItsBrokenTwins) {
  std::map<MeasureFault, int> objections;
  constexpr int kPairs = 200;
  Rng rng = property_rng("SimilarityContract.Twins");
  for (int i = 0; i < kPairs; ++i) {
    const LabelledShape a = made_shape(rng);
    const LabelledShape b = made_shape(rng);
    for (int fault = 0; fault <= static_cast<int>(plat::testing::kLastMeasureFault); ++fault) {
      const TwinMeasure twin{static_cast<MeasureFault>(fault)};
      std::string wrong = why_not_in_contract(twin, a, b, rng);
      if (wrong.empty()) wrong = why_wrong_shapes_pass(twin);
      objections[static_cast<MeasureFault>(fault)] += wrong.empty() ? 0 : 1;
      if (fault == 0) {
        ASSERT_EQ(wrong, "") << text_of(a) << "\n" << text_of(b);
      }
    }
  }
  objections.erase(MeasureFault::kNone);
  for (const auto& [fault, count] : objections)
    EXPECT_GT(count, kPairs / 20) << "fault " << static_cast<int>(fault);
}

// ---- every strategy on the menu ----

class SimilarityContract : public ::testing::TestWithParam<std::string> {};

TEST_P(SimilarityContract, HoldsOnRandomShapes) {
  const AnyShapeSimilarity measure = shape_similarities().make(GetParam());
  Rng rng = property_rng("SimilarityContract.Shapes");
  const int pairs = iterations(100);
  int prepared = 0;
  for (int i = 0; i < pairs; ++i) {
    const LabelledShape a = made_shape(rng);
    const LabelledShape b = made_shape(rng);
    prepared += measure.prepare(a) && measure.prepare(b) ? 1 : 0;
    ASSERT_EQ(why_not_in_contract(measure, a, b, rng), "") << "pair " << i << "\n"
                                                           << text_of(a) << "\n"
                                                           << text_of(b);
  }
  EXPECT_GE(prepared, pairs * 9 / 10);
}

TEST_P(SimilarityContract, HoldsForEveryPairOfFamilies) {
  const AnyShapeSimilarity measure = shape_similarities().make(GetParam());
  Rng rng = property_rng("SimilarityContract.Families");
  for (int a = 0; a < plat::testing::kShapeFamilies; ++a)
    for (int b = a; b < plat::testing::kShapeFamilies; ++b) {
      const LabelledShape one = made_shape(rng, static_cast<ShapeFamily>(a));
      const LabelledShape other = made_shape(rng, static_cast<ShapeFamily>(b));
      ASSERT_EQ(why_not_in_contract(measure, one, other, rng), "") << a << " " << b << "\n"
                                                                   << text_of(one) << "\n"
                                                                   << text_of(other);
    }
}

/// Any value that the field takes.
OptionValue random_value(Rng& rng, const FieldDescription& field) {
  if (!field.choices.empty()) return field.choices[rng.index(field.choices.size())];
  if (field.type == "number or none" && rng.index(3) == 0) return std::string(kAbsent);
  const bool is_whole = field.type == "integer";
  switch (rng.index(6)) {
    case 0:
      return field.min;
    case 1:
      return field.max;
    default: {
      // Ranges are wide; most of what matters lies at their lower end.
      const double value = field.min + (field.max - field.min) * std::pow(rng.uniform_01(), 3);
      return is_whole ? std::floor(value) : value;
    }
  }
}

TEST_P(SimilarityContract, HoldsForAnyOptions) {
  const auto& entry = shape_similarities().at(GetParam());
  Rng rng = property_rng("SimilarityContract.Options");
  for (int i = 0; i < iterations(60); ++i) {
    OptionMap options;
    for (const FieldDescription& field : entry.fields)
      if (rng.index(2) == 0) options[field.name] = random_value(rng, field);
    const LabelledShape a = made_shape(rng);
    const LabelledShape b = made_shape(rng);
    ASSERT_EQ(why_not_in_contract(entry.make(options), a, b, rng), "")
        << "pair " << i << " " << to_string(options) << "\n"
        << text_of(a) << "\n"
        << text_of(b);
  }
}

TEST_P(SimilarityContract, ShapesThatCannotBePreparedAreFailures) {
  EXPECT_EQ(why_wrong_shapes_pass(shape_similarities().make(GetParam())), "");
}

TEST_P(SimilarityContract, DistancesAreTheSameToTheLastBitOnAnyThread) {
  const AnyShapeSimilarity measure = shape_similarities().make(GetParam());
  Rng rng = property_rng("SimilarityContract.Threads");
  std::vector<AnyPreparedShape> shapes;
  while (shapes.size() < 20)
    if (auto prepared = measure.prepare(made_shape(rng))) shapes.push_back(*std::move(prepared));
  const auto row = [&](std::size_t i) {
    std::vector<double> out;
    for (const AnyPreparedShape& other : shapes) out.push_back(measure.distance(shapes[i], other));
    return out;
  };
  const auto one = parallel_map<std::vector<double>>(shapes.size(), Jobs{1}, row);
  const auto two = parallel_map<std::vector<double>>(shapes.size(), Jobs{2}, row);
  EXPECT_EQ(one, two);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SimilarityContract);
INSTANTIATE_TEST_SUITE_P(Menu, SimilarityContract,
                         ::testing::ValuesIn(shape_similarities().names()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace plat::similarity
