#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace plat::cli {

/// Runs the Python that Plat was configured with on a script, without a shell, so that no path
/// needs quoting.
/// @returns the script's exit status
/// @throws InputError where the script or Python is missing
int run_python(const std::filesystem::path& script, std::span<const std::string> arguments);

}  // namespace plat::cli
