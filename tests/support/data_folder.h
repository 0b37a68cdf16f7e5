#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace plat::testing {

/// PLAT_DATA_DIR/file where it exists.
inline std::optional<std::string> data_file(const std::string& file) {
  const char* folder = std::getenv("PLAT_DATA_DIR");
  if (folder == nullptr) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(folder) / file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path.string();
}

}  // namespace plat::testing

/// Defines `name` as the path of a real data file, or skips the test saying how to get it.
#define PLAT_REAL_DATA_OR_SKIP(name, file)                                                      \
  const auto name##_found = ::plat::testing::data_file(file);                                   \
  if (!name##_found)                                                                            \
    GTEST_SKIP() << "needs PLAT_DATA_DIR/" << (file) << " (plat data list says how to get it)"; \
  const std::string name = *name##_found
