#include "core/atomic_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/failure.h"
#include "geodata/scratch_folder.h"

namespace plat {
namespace {

namespace fs = std::filesystem;
using testing::ScratchFolder;

TEST(WriteFile, ReplacesWholeOrNotAtAll) {
  const ScratchFolder folder;
  const fs::path path = folder.file("a.csv");
  write_file(path, "one");
  write_file(path, "two");
  EXPECT_EQ(testing::bytes_of(path.string()), "two");
  EXPECT_THROW(write_file(folder.file("none/a.csv"), "three"), InputError);
  fs::create_directory(folder.file("taken"));
  write_file(folder.file("taken/inside"), "");
  EXPECT_THROW(write_file(folder.file("taken"), "four"), InputError);
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder.file(""))) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 2U);
}

}  // namespace
}  // namespace plat
