#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "core/failure.h"

namespace plat::geodata::detail {

/// A file beside the target that becomes the target, or vanishes.
class PartialFile {
 public:
  explicit PartialFile(const std::filesystem::path& target) : target_(target), path_(target) {
    // The ending stays: GDAL goes by it.
    path_.replace_filename("." + target.stem().string() + ".partial" + target.extension().string());
    remove();
  }
  ~PartialFile() { remove(); }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }
  void commit() {
    std::error_code error;
    std::filesystem::rename(path_, target_, error);
    if (error)
      throw InputError(fmt::format("{}: cannot be written: {}", target_.string(), error.message()));
  }

 private:
  void remove() const {
    std::error_code ignored;
    for (const char* suffix : {"", "-journal", "-wal", "-shm"})
      std::filesystem::remove(path_.string() + suffix, ignored);
  }

  std::filesystem::path target_;
  std::filesystem::path path_;
};

}  // namespace plat::geodata::detail
