// The contract of an Editor, over random sequences of all edits.
#include "editing/random_edits.h"

#include <gtest/gtest.h>

#include <map>

#include "editing/city_support.h"
#include "editing/tiled_city.h"
#include "support/property.h"

namespace plat::editing {
namespace {

/// Edits, undoes and redoes; looks at every state that an edit gives.
void run_session(City start, int steps, Rng& rng, std::map<std::string, int>& applied) {
  Editor editor(std::move(start));
  const std::string first = testing::bytes_of(editor.city());
  std::string last = first;
  for (int step = 0; step < steps; ++step) {
    const std::uint64_t way = rng.index(10);
    if (way == 0 && editor.undo_count() > 0) {
      editor.undo();
      editor.redo();
      ASSERT_EQ(testing::bytes_of(editor.city()), last) << "step " << step;
      editor.undo();
      last = testing::bytes_of(editor.city());
      continue;
    }
    if (way == 1 && editor.redo_count() > 0) {
      editor.redo();
      last = testing::bytes_of(editor.city());
      continue;
    }
    if (editor.city().streets().size() == 0) break;
    const City before = editor.city();
    const Edit edit = testing::random_edit(before, rng);
    const auto report = editor.apply(edit);
    const std::string now = testing::bytes_of(editor.city());
    if (!report) {
      ASSERT_EQ(now, last) << "step " << step << ", " << edit_name(edit) << " failed";
      continue;
    }
    // The same edit on the same city gives the same bytes.
    Editor again(before);
    ASSERT_TRUE(again.apply(edit).has_value());
    ASSERT_EQ(testing::bytes_of(again.city()), now) << edit_name(edit);
    last = now;
    ++applied[std::string(edit_name(edit))];
    testing::expect_exactly_changed(before, editor.city(), *report);
    testing::expect_as_from_scratch(editor.city());
    ASSERT_FALSE(::testing::Test::HasFailure()) << "step " << step << ", " << edit_name(edit);
  }
  const std::string end = testing::bytes_of(editor.city());
  const std::size_t count = editor.undo_count();
  while (editor.undo_count() > 0) editor.undo();
  EXPECT_EQ(testing::bytes_of(editor.city()), first);
  for (std::size_t i = 0; i < count; ++i) editor.redo();
  EXPECT_EQ(testing::bytes_of(editor.city()), end);
}

/// The edits of the variant before those of tiles.
constexpr std::size_t kStreetEdits = 10;

void expect_enough(const std::map<std::string, int>& applied, std::size_t kinds, int least) {
  int total = 0;
  for (const auto& [name, count] : applied) {
    total += count;
    std::printf("%s %d\n", name.c_str(), count);
  }
  EXPECT_EQ(applied.size(), kinds) << "every kind of edit was applied";
  EXPECT_GT(total, least) << "most edits must not be refused";
}

TEST(RandomEdits, EveryStateIsAsFromScratchAndUndoGoesBackToTheStart) {
  Rng rng = testing::property_rng("RandomEdits");
  std::map<std::string, int> applied;
  const int sessions = testing::iterations(10);
  for (int session = 0; session < sessions; ++session) {
    CityOptions options;
    options.style.strategy = "obb";
    options.seed = rng();
    City city = make_city(testing::town_network(), options);
    run_session(std::move(city), 40, rng, applied);
    ASSERT_FALSE(HasFailure()) << "session " << session;
  }
  expect_enough(applied, kStreetEdits, sessions * 40 / 4);
}

TEST(RandomEdits, OfTilesTooGoBackToTheStart) {
  Rng rng = testing::property_rng("RandomTileEdits");
  std::map<std::string, int> applied;
  const int sessions = testing::iterations(5);
  for (int session = 0; session < sessions; ++session) {
    run_session(testing::tiled_grid_city(4, 4), 40, rng, applied);
    ASSERT_FALSE(HasFailure()) << "session " << session;
  }
  // All but set_parcel_attribute: a city of tiles has no parcels.
  expect_enough(applied, std::variant_size_v<Edit> - 1, sessions * 40 / 4);
}

}  // namespace
}  // namespace plat::editing
