#include "editing/editor.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "editing/city_parts.h"
#include "editing/city_support.h"

namespace plat::editing {
namespace {

using testing::block_at;
using testing::bytes_of;
using testing::node_near;
using testing::street_near;

/// Applies an edit, and looks at what every edit promises.
EditReport applied(Editor& editor, const Edit& edit) {
  const City before = editor.city();
  const auto report = editor.apply(edit);
  EXPECT_TRUE(report) << edit_name(edit) << ": " << report.error().message;
  if (!report) return {};
  testing::expect_exactly_changed(before, editor.city(), *report);
  testing::expect_as_from_scratch(editor.city());
  return *report;
}

/// An edit that must be refused, and leave everything as it is.
void expect_refused(Editor& editor, const Edit& edit, FailureCode code) {
  const std::string before = bytes_of(editor.city());
  const auto report = editor.apply(edit);
  ASSERT_FALSE(report) << edit_name(edit);
  EXPECT_EQ(report.error().code, code) << report.error().message;
  EXPECT_EQ(bytes_of(editor.city()), before);
  EXPECT_EQ(editor.undo_count(), 0U);
}

std::set<ParcelId> parcel_ids(const City& city) {
  std::set<ParcelId> out;
  std::size_t count = 0;
  city.blocks().for_each([&](BlockId, const CityBlock& block) {
    for (const parcels::Parcel& parcel : block.parcels) out.insert(parcel.id);
    count += block.parcels.size();
  });
  EXPECT_EQ(out.size(), count) << "parcel ids are unique";
  return out;
}

std::size_t count_with(const City& city, std::string_view key, std::string_view value) {
  std::size_t count = 0;
  city.blocks().for_each([&](BlockId, const CityBlock& block) {
    for (const ParcelRecord& record : block.records) {
      const auto it = record.attributes.find(key);
      count += it != record.attributes.end() && it->second == value ? 1 : 0;
    }
  });
  return count;
}

TEST(Editor, MovingANodeChangesTheBlocksAroundItOnly) {
  Editor editor(testing::grid_city(4, 4));
  ASSERT_EQ(editor.city().blocks().size(), 9U);
  const EditReport report =
      applied(editor, MoveNode{node_near(editor.city(), {100, 80}), {107, 85}});
  EXPECT_EQ(report.changed.size(), 4U);
  EXPECT_TRUE(report.appeared.empty());
  EXPECT_TRUE(report.vanished.empty());
  EXPECT_GT(report.parcels_kept, 20U);
}

TEST(Editor, AMoveBelowTheGridChangesNothing) {
  Editor editor(testing::grid_city(3, 3));
  const EditReport report =
      applied(editor, MoveNode{node_near(editor.city(), {100, 80}), {100.0001, 80}});
  EXPECT_TRUE(report.changed.empty());
}

TEST(Editor, UndoAndRedoRestoreTheBytes) {
  Editor editor(testing::grid_city(4, 4));
  const std::string start = bytes_of(editor.city());
  ASSERT_TRUE(editor.apply(MoveNode{node_near(editor.city(), {100, 80}), {107, 85}}));
  ASSERT_TRUE(editor.apply(AddStreet{{130, 80}, {140, 160}}));
  const std::string end = bytes_of(editor.city());
  EXPECT_NE(start, end);
  editor.undo();
  editor.undo();
  EXPECT_EQ(bytes_of(editor.city()), start);
  editor.redo();
  editor.redo();
  EXPECT_EQ(bytes_of(editor.city()), end);
  editor.undo();
  ASSERT_TRUE(editor.apply(SetStreetWidth{street_near(editor.city(), {50, 0}), 20.0}));
  EXPECT_EQ(editor.redo_count(), 0U) << "a new edit ends what could be redone";
}

TEST(Editor, MovingAStreetMovesBothItsEnds) {
  Editor editor(testing::grid_city(4, 4));
  const EditReport report =
      applied(editor, MoveStreet{street_near(editor.city(), {150, 80}), {0, 6}});
  EXPECT_EQ(report.changed.size(), 6U);
  EXPECT_EQ(editor.city().nodes().at(node_near(editor.city(), {100, 86})).position,
            (Point{100, 86}));
}

TEST(Editor, BendingAStreetCurvesTheBlocksOnBothSides) {
  Editor editor(testing::grid_city(3, 3));
  const StreetId street = street_near(editor.city(), {50, 80});
  const EditReport report = applied(editor, BendStreet{street, Curve{{30, 95}, {70, 95}}});
  EXPECT_EQ(report.changed.size(), 2U);
  EXPECT_GT(editor.city().streets().at(street).line.size(), 8U);
  const std::string bent = bytes_of(editor.city());
  applied(editor, BendStreet{street, std::nullopt});
  EXPECT_EQ(editor.city().streets().at(street).line.size(), 2U);
  editor.undo();
  EXPECT_EQ(bytes_of(editor.city()), bent);
}

TEST(Editor, ASampledCurveStaysWithinItsTolerance) {
  const Curve curve{{30, 95}, {70, -20}};
  const Polyline line = sampled({0, 0}, curve, {100, 40});
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    const double u = 1.0 - t;
    const Point p =
        3 * u * u * t * curve.first + 3 * u * t * t * curve.second + t * t * t * Point{100, 40};
    double least = 1e9;
    for (std::size_t k = 1; k < line.size(); ++k)
      least = std::min(least, distance(Segment{line[k - 1], line[k]}, p));
    EXPECT_LE(least, kFlatness_m + 0.001);
  }
}

TEST(Editor, AWiderStreetTakesLandFromBothSides) {
  Editor editor(testing::grid_city(3, 3));
  const BlockId block = block_at(editor.city(), {50, 40});
  const double before = area_m2(editor.city().blocks().at(block).block.contour);
  const EditReport report =
      applied(editor, SetStreetWidth{street_near(editor.city(), {50, 80}), 20.0});
  EXPECT_EQ(report.changed.size(), 2U);
  EXPECT_LT(area_m2(editor.city().blocks().at(block).block.contour), before - 300.0);
}

TEST(Editor, ANewStreetSplitsABlockAndBothPartsInherit) {
  Editor editor(testing::grid_city(3, 3));
  const BlockId block = block_at(editor.city(), {50, 40});
  applied(editor, SetBlockStyle{{block}, {"obb", {{"area_max_m2", 500.0}}}});
  for (const parcels::Parcel& parcel : std::vector(editor.city().blocks().at(block).parcels))
    applied(editor, SetParcelAttribute{parcel.id, "use", "shop"});
  const EditReport report = applied(editor, AddStreet{{50.2, 0.3}, {50.3, 79.9}});
  EXPECT_EQ(report.appeared.size(), 1U);
  EXPECT_TRUE(report.vanished.empty());
  EXPECT_EQ(editor.city().blocks().size(), 5U);
  const CityBlock& child = editor.city().blocks().at(report.appeared.front());
  const CityBlock& parent = editor.city().blocks().at(block);
  EXPECT_EQ(child.style, parent.style);
  EXPECT_EQ(count_with(editor.city(), "use", "shop"), child.parcels.size() + parent.parcels.size());
  EXPECT_GT(report.parcels_kept, 4U);
  parcel_ids(editor.city());
}

TEST(Editor, RemovingAStreetJoinsBlocksIntoTheLarger) {
  Editor editor(testing::grid_city(3, 3));
  applied(editor, MoveStreet{street_near(editor.city(), {50, 80}), {0, 15}});
  const BlockId larger = block_at(editor.city(), {50, 40});
  const BlockId smaller = block_at(editor.city(), {50, 130});
  const ParcelId mark = editor.city().blocks().at(smaller).parcels.back().id;
  applied(editor, SetParcelAttribute{mark, "use", "school"});
  const EditReport report = applied(editor, RemoveStreet{street_near(editor.city(), {50, 95})});
  EXPECT_EQ(report.vanished, std::vector{smaller});
  EXPECT_EQ(block_at(editor.city(), {50, 80}), larger);
  EXPECT_GE(count_with(editor.city(), "use", "school"), 1U) << "both parts hand down attributes";
}

TEST(Editor, AStreetAcrossOthersMakesNodes) {
  Editor editor(testing::grid_city(4, 4));
  const std::size_t nodes = editor.city().nodes().size();
  const EditReport report = applied(editor, AddStreet{{30, 20}, {270, 30}});
  EXPECT_EQ(editor.city().nodes().size(), nodes + 4) << "two free ends and two crossings";
  EXPECT_EQ(report.appeared.size(), 1U) << "only the block between the crossings is split";
  EXPECT_EQ(report.changed.size(), 3U);
}

TEST(Editor, MovingALooseEndOntoAStreetClosesABlock) {
  Editor editor(testing::grid_city(3, 3));
  applied(editor, AddStreet{{50, 0}, {50, 60}});
  const NodeId end = node_near(editor.city(), {50, 60});
  const EditReport report = applied(editor, MoveNode{end, {50, 79.5}, 1.0});
  EXPECT_EQ(report.appeared.size(), 1U);
  EXPECT_FALSE(editor.city().nodes().contains(end));
}

TEST(Editor, AJoinedNodeLeavesTheOtherSideOfItsStreetsKnown) {
  Editor editor(testing::grid_city(2, 3));
  applied(editor, AddStreet{{50, 80}, {50, 120}});
  applied(editor, RemoveStreet{street_near(editor.city(), {50, 100})});
  applied(editor, MoveNode{node_near(editor.city(), {50, 80}), {50, 159.8}, 1.0});
  EXPECT_EQ(editor.city().blocks().size(), 3U);
  for (const Point p : {Point{25, 120}, {75, 120}})
    applied(editor, SetStreetWidth{street_near(editor.city(), p), 8.0});
}

TEST(Editor, AnIslandChangesTheBlockThatHoldsIt) {
  Editor editor(make_city(testing::town_network(), {}));
  const BlockId around = block_at(editor.city(), {110, 120});
  EXPECT_FALSE(editor.city().blocks().at(around).block.contour.holes.empty());
  const EditReport report =
      applied(editor, MoveNode{node_near(editor.city(), {130, 100}), {128, 101}});
  EXPECT_EQ(report.changed.size(), 2U);
  applied(editor, AddStreet{{130, 120}, {100, 120}});
  EXPECT_TRUE(editor.city().blocks().at(around).block.contour.holes.empty());
}

TEST(Editor, ACityTurnedAndScaledKeepsItsParcels) {
  CityOptions options;
  options.style.strategy = "obb";
  Editor editor(testing::grid_city(3, 3, options));
  const auto count = static_cast<double>(parcel_ids(editor.city()).size());
  EditReport report = applied(editor, RotateNodes{{}, {0, 0}, std::numbers::pi / 2.0});
  EXPECT_EQ(report.changed.size(), 4U);
  EXPECT_GT(static_cast<double>(report.parcels_kept), 0.8 * count);
  report = applied(editor, ScaleNodes{{}, {50, 50}, 1.01});
  EXPECT_GT(static_cast<double>(report.parcels_kept), 0.8 * count);
}

TEST(Editor, AnotherStyleDividesTheNamedBlocksOnly) {
  Editor editor(testing::grid_city(3, 3));
  const BlockId block = block_at(editor.city(), {50, 40});
  EXPECT_EQ(applied(editor, SetBlockStyle{{block}, {"voronoi", {}}}).changed, std::vector{block});
  EXPECT_TRUE(applied(editor, SetBlockStyle{{block}, {"voronoi", {}}}).changed.empty());
  EXPECT_EQ(applied(editor, SetBlockStyle{{}, {"obb", {}}}).changed.size(), 4U);
  const std::string before = bytes_of(editor.city());
  EXPECT_THROW(static_cast<void>(editor.apply(SetBlockStyle{{}, {"no such", {}}})), InputError);
  EXPECT_EQ(bytes_of(editor.city()), before);
}

TEST(Editor, RefusesWhatWouldBreakTheNetwork) {
  Editor editor(make_city(testing::town_network(), {}));
  const City& city = editor.city();
  const NodeId corner = node_near(city, {100, 80});
  expect_refused(editor, MoveNode{corner, {100, 170}}, FailureCode::kStreetsCross);
  expect_refused(editor, MoveNode{corner, {100, 160}}, FailureCode::kStreetsCross);
  expect_refused(editor, MoveNode{node_near(city, {250, 120}), {270, 130}},
                 FailureCode::kStreetCollapsed);
  expect_refused(editor, BendStreet{street_near(city, {50, 80}), Curve{{20, 200}, {70, 200}}},
                 FailureCode::kStreetsCross);
  expect_refused(editor, AddStreet{{100, 80}, {200, 80}}, FailureCode::kStreetsCross);
  expect_refused(editor, AddStreet{{100, 80.2}, {100.3, 80}}, FailureCode::kStreetCollapsed);
  // The free triangle turned inside out, and a yard that would jump into another block.
  expect_refused(editor, MoveNode{node_near(city, {560, 120}), {540, -100}},
                 FailureCode::kFaceInverted);
  std::vector<NodeId> yard;
  for (const Point p : {Point{130, 100}, {170, 100}, {170, 140}, {130, 140}})
    yard.push_back(node_near(city, p));
  expect_refused(editor, ScaleNodes{yard, {150, 1000}, 0.9}, FailureCode::kFaceInverted);
}

TEST(Editor, RefusesUnknownIdsAndValues) {
  Editor editor(testing::grid_city(3, 3));
  const StreetId street = street_near(editor.city(), {50, 0});
  expect_refused(editor, MoveNode{NodeId{999}, {0, 0}}, FailureCode::kUnknownEntity);
  expect_refused(editor, RemoveStreet{StreetId{999}}, FailureCode::kUnknownEntity);
  expect_refused(editor, SetBlockStyle{{BlockId{999}}, {}}, FailureCode::kUnknownEntity);
  expect_refused(editor, SetParcelAttribute{ParcelId{99999}, "a", "b"},
                 FailureCode::kUnknownEntity);
  expect_refused(editor, SetStreetWidth{street, 0.0}, FailureCode::kOutOfRange);
  expect_refused(editor, ScaleNodes{{}, {0, 0}, 0.0}, FailureCode::kOutOfRange);
  expect_refused(editor, MoveStreet{street, {std::nan(""), 0}}, FailureCode::kOutOfRange);
}

TEST(Editor, IdsAreNotUsedAgain) {
  Editor editor(testing::grid_city(3, 3));
  std::set<ParcelId> seen = parcel_ids(editor.city());
  const std::uint32_t last = seen.rbegin()->value;
  applied(editor, AddStreet{{50, 0}, {50, 80}});
  applied(editor, RemoveStreet{street_near(editor.city(), {50, 40})});
  for (const ParcelId id : parcel_ids(editor.city()))
    EXPECT_TRUE(seen.contains(id) || id.value > last);
}

TEST(Editor, TheNumberOfThreadsDoesNotShow) {
  std::set<std::string> outcomes;
  for (const int jobs : {1, 2, 4}) {
    CityOptions options;
    options.jobs.count = jobs;
    Editor editor(make_city(testing::town_network(), options));
    applied(editor, RotateNodes{{}, {200, 200}, 0.3});
    applied(editor, AddStreet{{150, 90}, {190, 130}});
    outcomes.insert(bytes_of(editor.city()));
  }
  EXPECT_EQ(outcomes.size(), 1U);
}

TEST(CityParts, ARestoredCityIsTheSame) {
  Editor editor(make_city(testing::town_network(), {}));
  applied(editor, AddStreet{{150, 0}, {160, 80}});
  applied(editor, BendStreet{street_near(editor.city(), {50, 80}), Curve{{30, 95}, {70, 95}}});
  const auto restored = restore_city(parts_of(editor.city()));
  ASSERT_TRUE(restored) << restored.error().message;
  Editor other(*restored);
  const Edit edit = MoveNode{node_near(editor.city(), {200, 160}), {205, 163}};
  const EditReport first = applied(editor, edit);
  const EditReport second = applied(other, edit);
  EXPECT_EQ(first.changed, second.changed);
  const CityParts a = parts_of(editor.city());
  const CityParts b = parts_of(other.city());
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.streets, b.streets);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].block.contour, b.blocks[i].block.contour);
    EXPECT_EQ(a.blocks[i].parcels, b.blocks[i].parcels);
    EXPECT_EQ(a.blocks[i].records, b.blocks[i].records);
  }
}

TEST(CityParts, AStreetOfAFewGridStepsIsRestored) {
  streets::StreetNetwork network = testing::grid_network(3, 3);
  streets::Street stub = network.streets.front();
  stub.id = StreetId{static_cast<std::uint32_t>(network.streets.size())};
  stub.line = {{50, 0}, {50, 2.0 / 1024.0}};
  network.streets.push_back(stub);
  const auto restored = restore_city(parts_of(make_city(network, {})));
  EXPECT_TRUE(restored) << restored.error().message;
}

TEST(CityParts, PartsThatDoNotFitAreRefused) {
  CityParts parts = parts_of(testing::grid_city(3, 3));
  parts.blocks.pop_back();
  EXPECT_EQ(restore_city(parts).error().code, FailureCode::kNotCovered);
  parts = parts_of(testing::grid_city(3, 3));
  parts.nodes.front().second = {150, 120};
  EXPECT_FALSE(restore_city(parts));
}

}  // namespace
}  // namespace plat::editing
