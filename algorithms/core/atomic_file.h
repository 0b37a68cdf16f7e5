#pragma once

#include <filesystem>
#include <string_view>

namespace plat {

/// Writes a file whole or not at all: to a temporary beside it, then renamed.
/// @throws InputError where the path cannot be written
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace plat
