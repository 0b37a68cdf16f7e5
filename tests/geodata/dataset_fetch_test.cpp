#include "geodata/dataset_fetch.h"

#include <gmock/gmock.h>

#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat::geodata {
namespace {

using ::testing::HasSubstr;

std::string error_of(const Dataset& set, const std::string& folder) {
  try {
    fetch(set, folder, Progress::Style::kQuiet);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DatasetFetch, WhatHasNoAutomaticWaySaysWhereToGetIt) {
  const testing::ScratchFolder folder;
  const std::string message = error_of(dataset("san_roman_es"), folder.file(""));
  EXPECT_THAT(message, HasSubstr("Direccion General del Catastro"));
  EXPECT_THAT(message, HasSubstr("san_roman_es/san_roman_es.gpkg"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

/// A data set whose public source is a file on this machine.
Dataset local_set(const testing::ScratchFolder& folder, const std::string& sha256) {
  Dataset set;
  set.name = "s";
  set.source = "a public place";
  set.files = {{"s/a.txt", sha256, "file://" + folder.write("source.txt", "abc"), false}};
  set.fetch = FetchFiles{};
  return set;
}
const std::string kShaOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(DatasetFetch, VerifiesWhatItGetsAndLeavesGoodFilesAlone) {
  const testing::ScratchFolder folder;
  const Dataset set = local_set(folder, kShaOfAbc);
  EXPECT_EQ(fetch(set, folder.file("data"), Progress::Style::kQuiet),
            std::vector<std::string>{"s/a.txt"});
  EXPECT_EQ(testing::bytes_of(folder.file("data/s/a.txt")), "abc");
  EXPECT_TRUE(fetch(set, folder.file("data"), Progress::Style::kQuiet).empty());
}

TEST(DatasetFetch, AWrongChecksumLeavesNothing) {
  const testing::ScratchFolder folder;
  const Dataset set = local_set(folder, std::string(64, '0'));
  EXPECT_THAT(error_of(set, folder.file("data")), HasSubstr("checksum"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("data/s")));
}

TEST(DatasetFetch, ASourceOutOfReachNamesTheWayByHand) {
  const testing::ScratchFolder folder;
  Dataset set = local_set(folder, kShaOfAbc);
  set.files[0].url = "file://" + folder.file("none.txt");
  const std::string message = error_of(set, folder.file("data"));
  EXPECT_THAT(message, HasSubstr("cannot be fetched"));
  EXPECT_THAT(message, HasSubstr("a public place"));
}

}  // namespace
}  // namespace plat::geodata
