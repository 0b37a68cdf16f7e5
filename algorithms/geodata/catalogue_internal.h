#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plat::geodata::detail {

/// catalogue.json as it was when the program was built.
std::string_view catalogue_text();

/// SHA-256 of a file, 64 hexadecimal digits. @throws InputError where it cannot be read
std::string sha256_of(const std::filesystem::path& file);

/// Beside what was derived: from which source, and the checksum of each result.
inline constexpr const char* kProvenanceName = ".provenance.json";

}  // namespace plat::geodata::detail
