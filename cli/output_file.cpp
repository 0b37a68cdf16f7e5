#include "output_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "core/failure.h"
#include "geodata/layer_io.h"

namespace plat::cli {

void expect_output(const std::string& path, std::initializer_list<std::string> inputs,
                   std::string_view flag, std::string_view ending) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path target(path);
  if (target.extension() != ending || target.stem().empty())
    throw InputError(fmt::format("{} {}: must be a file that ends in {}", flag, path, ending));
  if (fs::is_directory(target, ignored))
    throw InputError(fmt::format("{} {}: is a folder; name a file in it", flag, path));
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw InputError(fmt::format("{} {}: the folder {} is not there; make it first", flag, path,
                                 folder.string()));
  const fs::path probe = folder / ("." + target.stem().string() + ".probe");
  const bool is_writable = std::ofstream(probe).is_open();
  fs::remove(probe, ignored);
  if (!is_writable)
    throw InputError(fmt::format("{} {}: no file can be written in {}; choose another folder", flag,
                                 path, folder.string()));
  for (const std::string& input : inputs) {
    if (input.empty() || !fs::exists(target, ignored)) continue;
    if (fs::equivalent(target, geodata::parse_layer_source(input).file, ignored))
      throw InputError(
          fmt::format("{} {}: is an input, which would be lost; choose another file", flag, path));
  }
}

}  // namespace plat::cli
