#include "editing/editor.h"

#include <gtest/gtest.h>

#include "editing/city_support.h"

namespace plat::editing {
namespace {

using testing::node_near;

TEST(Editor, MovingANodeChangesTheBlocksAroundItOnly) {
  Editor editor(testing::grid_city(4, 4));
  ASSERT_EQ(editor.city().blocks().size(), 9U);
  const City before = editor.city();
  const auto report = editor.apply(MoveNode{node_near(before, {100, 80}), {107, 85}});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->changed.size(), 4U);
  EXPECT_TRUE(report->appeared.empty());
  EXPECT_TRUE(report->vanished.empty());
  EXPECT_GT(report->parcels_kept, 20U);
  testing::expect_exactly_changed(before, editor.city(), *report);
  testing::expect_as_from_scratch(editor.city());
}

TEST(Editor, UndoAndRedoRestoreTheBytes) {
  Editor editor(testing::grid_city(4, 4));
  const std::string start = testing::bytes_of(editor.city());
  ASSERT_TRUE(editor.apply(MoveNode{node_near(editor.city(), {100, 80}), {107, 85}}));
  const std::string end = testing::bytes_of(editor.city());
  EXPECT_NE(start, end);
  editor.undo();
  EXPECT_EQ(testing::bytes_of(editor.city()), start);
  editor.redo();
  EXPECT_EQ(testing::bytes_of(editor.city()), end);
}

}  // namespace
}  // namespace plat::editing
