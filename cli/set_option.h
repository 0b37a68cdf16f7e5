#pragma once

#include <string>
#include <vector>

#include "core/options.h"

namespace plat::cli {

/// What the arguments of `--set` say, each "key=value".
/// @throws InputError for one that is no assignment, or a key that is given twice
OptionMap options_from_settings(const std::vector<std::string>& settings);

}  // namespace plat::cli
