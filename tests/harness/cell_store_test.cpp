#include "harness/cell_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/working_grid.h"
#include "geodata/scratch_folder.h"
#include "support/property.h"
#include "support/synthetic_blocks.h"

namespace plat::harness {
namespace {

using testing::ScratchFolder;

std::vector<DividedBlock> divided_blocks(const std::string& name) {
  Rng rng = testing::property_rng(name);
  std::vector<DividedBlock> out;
  for (const Polygon& shape : testing::synthetic_blocks(rng, 20)) {
    DividedBlock block;
    block.block = {static_cast<std::uint32_t>(out.size())};
    block.seed = rng();
    block.options = {{"corners", std::string("street_width")}, {"width_m", rng.uniform(-1.0, 1.0)}};
    if (out.size() % 5 == 4) {
      block.parcels = fail(FailureCode::kNoSkeleton, "a message with \"quotes\" and \n a line");
    } else {
      block.parcels = std::vector<parcels::Parcel>{{ParcelId{0}, shape}, {ParcelId{1}, shape}};
    }
    out.push_back(std::move(block));
  }
  return out;
}

TEST(CellStore, GivesBackWhatWasSavedToTheLastBit) {
  const ScratchFolder folder;
  const CellStore store(folder.file("cells"));
  const std::vector<DividedBlock> saved = divided_blocks("CellStore.RoundTrip");
  store.save("city__obb__0", "key", saved);
  const auto loaded = store.load("city__obb__0", "key");
  ASSERT_TRUE(loaded);
  ASSERT_EQ(loaded->size(), saved.size());
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const DividedBlock& a = saved[i];
    const DividedBlock& b = (*loaded)[i];
    EXPECT_EQ(a.block, b.block);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.options, b.options);
    ASSERT_EQ(a.parcels.has_value(), b.parcels.has_value());
    if (a.parcels) {
      EXPECT_EQ(*a.parcels, *b.parcels);
    } else {
      EXPECT_EQ(a.parcels.error().code, b.parcels.error().code);
      EXPECT_EQ(a.parcels.error().message, b.parcels.error().message);
    }
  }
}

TEST(CellStore, TakesNoCellOfAnotherKey) {
  const ScratchFolder folder;
  const CellStore store(folder.file(""));
  store.save("cell", "seed 1", divided_blocks("CellStore.Key"));
  EXPECT_TRUE(store.load("cell", "seed 1"));
  EXPECT_FALSE(store.load("cell", "seed 2"));
  EXPECT_FALSE(store.load("cell", ""));
  EXPECT_FALSE(store.load("other", "seed 1"));
}

TEST(CellStore, TakesNoDamagedCell) {
  const ScratchFolder folder;
  const CellStore store(folder.file(""));
  for (const char* text :
       {"", "{", "[]", "3", R"({"key": 3, "blocks": []})", R"({"key": "k"})",
        R"({"key": "k", "blocks": [{}]})", R"({"key": "k", "blocks": 3})",
        R"({"key": "k", "blocks": [{"block": 0, "seed": 1, "options": {}, "parcels": [[3]]}]})"}) {
    std::ofstream(folder.file("cell.json")) << text;
    EXPECT_FALSE(store.load("cell", "k")) << text;
  }
}

TEST(InputDigest, ChangesWithWhateverAStrategySees) {
  Rng rng = testing::property_rng("InputDigest");
  std::vector<blocks::Block> blocks;
  for (Polygon& shape : testing::synthetic_blocks(rng, 5))
    blocks.push_back(blocks::block_from_contour({0}, std::move(shape)));
  std::vector<parcels::ParcelStyle> styles(5);
  const std::uint64_t before = input_digest(blocks, styles);
  EXPECT_EQ(input_digest(blocks, styles), before);
  const auto expect_other = [&](auto change, auto undo) {
    change();
    EXPECT_NE(input_digest(blocks, styles), before);
    undo();
    EXPECT_EQ(input_digest(blocks, styles), before);
  };
  double& x = blocks[3].contour.outer[1].x;
  expect_other([&] { x += kGridStep_m; }, [&] { x -= kGridStep_m; });
  blocks::BlockEdge& edge = blocks[4].edges[0][0];
  const blocks::BlockEdge kept = edge;
  expect_other([&] { edge = {}; }, [&] { edge = kept; });
  expect_other([&] { styles[2].count = 7; }, [&] { styles[2].count = 0; });
  expect_other([&] { styles[1].width_mean_m = 1; }, [&] { styles[1].width_mean_m = 0; });
}

TEST(CellStore, LeavesNoTemporaryBeside) {
  const ScratchFolder folder;
  CellStore(folder.file("")).save("cell", "k", {});
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file(""))) {
    EXPECT_EQ(entry.path().filename(), "cell.json");
    ++files;
  }
  EXPECT_EQ(files, 1);
}

TEST(CellStore, SaysWhereItCannotWrite) {
  const ScratchFolder folder;
  std::ofstream(folder.file("cells")) << "a file";
  EXPECT_THROW(CellStore(folder.file("cells")).save("cell", "k", {}), InputError);
}

}  // namespace
}  // namespace plat::harness
