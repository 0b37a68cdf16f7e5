#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace plat::harness {

/// What this program was built from and with: {plat_version, commit, dirty, compiler,
/// compiler_flags, libraries}.
nlohmann::json build_info();

/// The folder with the experiments' configs and the report: PLAT_EXPERIMENTS_DIR where set, else
/// where it was built from.
std::filesystem::path experiments_folder();

}  // namespace plat::harness
