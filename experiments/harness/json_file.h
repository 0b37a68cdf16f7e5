#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace plat::harness {

/// The file's JSON, as it stands.
/// @throws InputError with the file's name where it cannot be read or is no JSON, and why
nlohmann::json read_json(const std::string& file);

}  // namespace plat::harness
