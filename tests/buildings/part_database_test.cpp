#include "buildings/part_database.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "buildings/made_meshes.h"
#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat::buildings {
namespace {

using nlohmann::ordered_json;
using testing::bytes_of;
using testing::crooked_row;
using testing::ScratchFolder;

Part crooked(const std::string& name, double length_m) {
  return make_part(name, {.part_class = PartClass::kMiddle, .right_m = length_m},
                   crooked_row(0, length_m), {{"windows", 2}});
}

Part plain(const std::string& name, double height_m) {
  return make_part(name, {.part_class = PartClass::kMiddle, .right_m = 1.0},
                   testing::box_mesh({0, -4, 0}, {1, 4, height_m}), {});
}

PartDatabase small_database() {
  return PartDatabase({.name = "small",
                       .summary = "two kinds",
                       .origin = "made here",
                       .kit = {},
                       .transition_limit_m2 = 20.0},
                      {crooked("a", 3.0), crooked("b", 2.0), plain("c", 3.0)});
}

TEST(PartDatabase, EqualSectionsAreOneAndCostNothing) {
  const PartDatabase database = small_database();
  EXPECT_EQ(database.sections().size(), 2U);
  EXPECT_EQ(database.section_of({0, 1}), database.section_of({1, 0}));
  EXPECT_EQ(database.cost({0, 1}, {1, 0}), 0);
}

TEST(PartDatabase, CostsAreTheDisagreementInSteps) {
  const PartDatabase database = small_database();
  EXPECT_EQ(database.cost({0, 1}, {2, 0}), 90000);  // 3 m x 3 m
  EXPECT_EQ(database.cost({2, 1}, {0, 0}), 90000);
  EXPECT_DOUBLE_EQ(database.cost_m2({0, 1}, {2, 0}), 9.0);
  EXPECT_EQ(database.cost({0, 1}, {1, 1}, Facing::kMirrored), 180000);
  EXPECT_EQ(database.cost({0, 1}, {2, 0}, Facing::kMirrored), 90000);
}

TEST(PartDatabase, TheLimitSaysWhichPartsMayMeet) {
  const PartDatabase database = small_database();
  EXPECT_TRUE(database.may_meet({0, 1}, {2, 0}));
  EXPECT_EQ(database.transition_count(), 9U);
  DatabaseInfo info = database.info();
  info.transition_limit_m2 = 8.9;
  EXPECT_EQ(PartDatabase(info, database.parts()).transition_count(), 4U + 1U);
}

TEST(PartDatabase, PartsOffTheQuantumAreScaledAndNamed) {
  const PartDatabase database(
      {.name = "odd", .summary = {}, .origin = {}, .kit = {}, .transition_limit_m2 = {}},
      {crooked("a", 3.07), crooked("b", 3.0)});
  ASSERT_EQ(database.scalings().size(), 1U);
  EXPECT_EQ(database.scalings()[0].part, "a");
  EXPECT_DOUBLE_EQ(database.scalings()[0].factor, 3.0 / 3.07);
}

TEST(PartDatabase, MoreAndEquallyNamedParts) {
  const PartDatabase more = with_parts(small_database(), {plain("d", 5.0)});
  EXPECT_EQ(more.parts().size(), 4U);
  EXPECT_EQ(more.sections().size(), 3U);
  EXPECT_EQ(more.find("d"), 3U);
  EXPECT_FALSE(more.find("e"));
  EXPECT_THROW(with_parts(small_database(), {plain("a", 5.0)}), InputError);
  EXPECT_THROW(PartDatabase({}, {}), InputError);
}

class DatabaseFiles : public ::testing::TestWithParam<std::string> {};

TEST_P(DatabaseFiles, ReadBackAsWritten) {
  const ScratchFolder scratch;
  const PartDatabase database = small_database();
  write_part_database(database, scratch.file("db"), GetParam());
  const PartDatabase back = read_part_database(scratch.file("db"));
  EXPECT_EQ(back.info(), database.info());
  EXPECT_EQ(back.parts(), database.parts());
  EXPECT_EQ(back.sections(), database.sections());
  EXPECT_EQ(back.transitions(), database.transitions());
}

INSTANTIATE_TEST_SUITE_P(Endings, DatabaseFiles, ::testing::Values(".obj", ".ply", ".off"),
                         [](const auto& at) { return at.param.substr(1); });

TEST(PartDatabase, SameDatabaseSameBytes) {
  const ScratchFolder scratch;
  write_part_database(small_database(), scratch.file("one"));
  write_part_database(small_database(), scratch.file("two"));
  for (const std::string file : {"/parts.json", "/transitions.json", "/meshes/a.ply"}) {
    EXPECT_FALSE(bytes_of(scratch.file("one") + file).empty());
    EXPECT_EQ(bytes_of(scratch.file("one") + file), bytes_of(scratch.file("two") + file));
  }
}

TEST(PartDatabase, TheStoredTableIsUsed) {
  const ScratchFolder scratch;
  write_part_database(small_database(), scratch.file("db"));
  const std::string file = scratch.file("db") + "/transitions.json";
  ordered_json json = ordered_json::parse(bytes_of(file));
  json["plain"][0][1] = json["plain"][1][0] = 12345;
  (void)scratch.write("db/transitions.json", json.dump());
  EXPECT_EQ(read_part_database(scratch.file("db")).cost({0, 1}, {2, 0}), 12345);
  std::filesystem::remove(file);
  EXPECT_EQ(read_part_database(scratch.file("db")).cost({0, 1}, {2, 0}), 90000);
}

TEST(PartDatabase, WritesOverADatabaseAndNothingElse) {
  const ScratchFolder scratch;
  (void)scratch.write("letters.txt", "dear");
  const std::string folder = std::filesystem::path(scratch.file("letters.txt")).parent_path();
  EXPECT_THROW(write_part_database(small_database(), folder), InputError);
  EXPECT_EQ(bytes_of(scratch.file("letters.txt")), "dear");
  write_part_database(with_parts(small_database(), {plain("d", 5.0)}), scratch.file("db"));
  write_part_database(small_database(), scratch.file("db"));
  EXPECT_EQ(read_part_database(scratch.file("db")).parts().size(), 3U);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("db") + "/meshes/d.ply"));
  EXPECT_THROW(write_part_database(small_database(), scratch.file("other"), ".stl"), InputError);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("other")));
}

/// What read_part_database says after one edit of a good folder.
std::string refusal(const ScratchFolder& scratch, const std::string& file,
                    const std::function<void(ordered_json&)>& edit) {
  write_part_database(small_database(), scratch.file("db"));
  ordered_json json = ordered_json::parse(bytes_of(scratch.file("db/" + file)));
  edit(json);
  (void)scratch.write("db/" + file, json.dump());
  try {
    (void)read_part_database(scratch.file("db"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

TEST(PartDatabase, ATableOfOtherPartsIsRefused) {
  const ScratchFolder scratch;
  const auto changed = [](ordered_json& json) { json["parts"][0]["attributes"]["windows"] = 3; };
  EXPECT_NE(refusal(scratch, "parts.json", changed).find("made of other parts"), std::string::npos);
  write_part_database(small_database(), scratch.file("db"));
  write_mesh(scratch.file("db/meshes/b.ply"), crooked_row(0, 2.00001));
  EXPECT_THROW((void)read_part_database(scratch.file("db")), InputError);
}

TEST(PartDatabase, BadManifestsAreRefusedWithThePlace) {
  const ScratchFolder scratch;
  const auto said = [&](const std::function<void(ordered_json&)>& edit) {
    return refusal(scratch, "parts.json", edit);
  };
  const auto expect = [&](const std::function<void(ordered_json&)>& edit,
                          const std::string& words) {
    const std::string text = said(edit);
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find("parts.json"), std::string::npos) << text;
  };
  expect([](ordered_json& json) { json.erase("name"); }, "\"name\" is missing");
  expect([](ordered_json& json) { json["format"] = "other"; }, "format");
  expect([](ordered_json& json) { json["nmae"] = 1; }, "did you mean \"name\"");
  expect([](ordered_json& json) { json["parts"][1]["class"] = "midle"; },
         "left_end, right_end, middle");
  expect([](ordered_json& json) { json["parts"][1]["length_m"] = "long"; }, "wrong type");
  expect([](ordered_json& json) { json["parts"][1].erase("length_m"); }, "part 1 (b)");
  expect([](ordered_json& json) { json["parts"][1]["angle_deg"] = 90; }, "no key \"angle_deg\"");
  expect([](ordered_json& json) { json["parts"][1]["attributes"]["windows"] = -1; },
         "allowed 0 and more");
  expect([](ordered_json& json) { json["materials"][0]["rgb"] = {1, 2}; }, "wrong type");
}

TEST(PartDatabase, BadMeshesAreRefusedWithTheFile) {
  const ScratchFolder scratch;
  const auto said = [&](const std::function<void(ordered_json&)>& edit) {
    return refusal(scratch, "parts.json", edit);
  };
  EXPECT_NE(said([](ordered_json& json) {
              json["parts"][1]["mesh"] = "meshes/z.ply";
            }).find("z.ply: no such file"),
            std::string::npos);
  const std::string longer = said([](ordered_json& json) { json["parts"][1]["length_m"] = 2.4; });
  EXPECT_NE(longer.find("b.ply"), std::string::npos) << longer;
  EXPECT_NE(longer.find("right port"), std::string::npos) << longer;
}

TEST(PartDatabase, BadTablesAreRefused) {
  const ScratchFolder scratch;
  const auto said = [&](const std::function<void(ordered_json&)>& edit) {
    return refusal(scratch, "transitions.json", edit);
  };
  EXPECT_NE(said([](ordered_json& json) { json["plain"].erase(0); }).find("rows"),
            std::string::npos);
  EXPECT_NE(said([](ordered_json& json) { json["plain"][0][1] = -5; }).find("none negative"),
            std::string::npos);
  EXPECT_NE(said([](ordered_json& json) { json["step_m2"] = 1; }).find("step_m2"),
            std::string::npos);
  EXPECT_NE(said([](ordered_json& json) {
              json["section_areas_m2"] = {1.0};
              json["plain"] = json["mirrored"] = {{0}};
            }).find("the table is of 1 sections, the parts have 2"),
            std::string::npos);
}

TEST(PartDatabase, AFolderThatIsNotThereIsRefused) {
  const ScratchFolder scratch;
  EXPECT_THROW((void)read_part_database(scratch.file("nowhere")), InputError);
  std::filesystem::create_directories(scratch.file("db"));
  (void)scratch.write("db/parts.json", "{");
  EXPECT_THROW((void)read_part_database(scratch.file("db")), InputError);
}

}  // namespace
}  // namespace plat::buildings
