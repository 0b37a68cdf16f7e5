// Scripts of any operations on made cities: whatever is done, what comes out is a layout, and what
// is refused changes nothing.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "similarity/shape_similarity.h"
#include "support/property.h"
#include "tiles/reconfiguration_support.h"

namespace plat::tiles {
namespace {

using namespace plat::testing;  // NOLINT: the support of this test

class Script {
 public:
  Script(TileLayout layout, Rng& rng) : layout_(std::move(layout)), rng_(rng) {}

  void step();
  [[nodiscard]] int done() const { return done_; }
  [[nodiscard]] int refused() const { return refused_; }
  [[nodiscard]] const std::array<int, 7>& done_by_kind() const { return done_by_kind_; }

 private:
  [[nodiscard]] std::vector<TileId> some_tiles() {
    std::vector<TileId> out;
    const auto count = 1 + rng_.index(3);
    for (std::uint64_t k = 0; k < count; ++k)
      out.push_back(layout_.tiles[rng_.index(layout_.tiles.size())].id);
    return out;
  }
  [[nodiscard]] TileId any_tile() { return layout_.tiles[rng_.index(layout_.tiles.size())].id; }
  Expected<Reconfiguration> operation(std::size_t kind);

  TileLayout layout_;
  Rng& rng_;
  int done_ = 0;
  int refused_ = 0;
  std::array<int, 7> done_by_kind_{};
};

Expected<Reconfiguration> Script::operation(std::size_t kind) {
  ReconfigurationOptions options = small_city_options();
  const auto measures = similarity::shape_similarities().names();
  options.similarity = measures[rng_.index(measures.size())];
  options.solver.keep_size = rng_.uniform_01();
  options.pasted = rng_.index(2) == 0 ? PastedTiles::kHeld : PastedTiles::kFree;
  if (rng_.index(4) == 0)
    options.replacement = ReplacementOptions{.candidates = 2, .max_rounds = 2};
  const TileId tile = any_tile();
  switch (kind) {
    case 0:
      return move_tiles(layout_, {{tile}},
                        Affine::translation({rng_.uniform(-3, 3), rng_.uniform(-3, 3)}), options);
    case 1:
      return move_tiles(layout_, some_tiles(),
                        Affine::rotation(rng_.uniform(-0.1, 0.1), middle_of(layout_, tile)),
                        options);
    case 2:
      return relax(layout_, options);
    case 3:
      return cut_tiles(layout_, some_tiles(), VacatedLand::kVacant, options);
    case 4:
      return cut_tiles(layout_, {{tile}}, VacatedLand::kClosed, options);
    case 5: {
      const auto group = copy_tiles(layout_, some_tiles()).value();
      const Point from = centroid(shape_of(group.tiles, group.tiles.tiles.front()));
      const Affine turn = Affine::rotation(rng_.uniform(-std::numbers::pi, std::numbers::pi), from);
      return paste_tiles(layout_, group,
                         Affine::translation(middle_of(layout_, tile) - from) * turn, options);
    }
    default: {
      auto unpinned = unpin_tiles(layout_, some_tiles());
      return Reconfiguration{unpinned.value(), {}};
    }
  }
}

void Script::step() {
  const TileLayout before = layout_;
  const std::size_t kind = rng_.index(7);
  auto result = operation(kind);
  ASSERT_EQ(layout_, before);
  if (!result) {
    ++refused_;
    EXPECT_TRUE(result.error().code == FailureCode::kTilesOverlap ||
                result.error().code == FailureCode::kNoPlace)
        << failure_name(result.error().code) << ": " << result.error().message;
    EXPECT_FALSE(result.error().message.empty());
    return;
  }
  layout_ = std::move(result->layout);
  ASSERT_EQ(defect_of(layout_), "") << "operation " << kind;
  ASSERT_EQ(parts_of(layout_), 1U) << "operation " << kind;
  ++done_;
  ++done_by_kind_[kind];
}

TEST(RandomReconfigurations, EveryStateIsALayout) {
  Rng rng = property_rng("RandomReconfigurations.EveryStateIsALayout");
  int done = 0;
  int refused = 0;
  std::array<int, 7> kinds{};
  for (int script = 0; script < iterations(20); ++script) {
    Script city(
        with_pinned_corners(made_layout({.blocks_x = 2 + script % 2,
                                         .parcels_south = 2 + static_cast<int>(rng.index(4)),
                                         .parcels_north = 2 + static_cast<int>(rng.index(4)),
                                         .jitter_m = rng.uniform(0, 4),
                                         .seed = rng()})),
        rng);
    for (int i = 0; i < 25 && !HasFatalFailure(); ++i) city.step();
    if (HasFatalFailure()) return;
    done += city.done();
    refused += city.refused();
    for (std::size_t k = 0; k < kinds.size(); ++k) kinds[k] += city.done_by_kind()[k];
  }
  EXPECT_GT(done, refused);
  for (const int count : kinds) EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace plat::tiles
