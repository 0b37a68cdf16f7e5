#include "set_option.h"

#include <fmt/format.h>

#include <utility>

#include "core/failure.h"

namespace plat::cli {

OptionMap options_from_settings(const std::vector<std::string>& settings) {
  OptionMap options;
  for (const std::string& setting : settings) {
    auto [key, value] = parse_option(setting);
    if (!options.emplace(key, std::move(value)).second)
      throw InputError(fmt::format("--set {}: given twice", key));
  }
  return options;
}

}  // namespace plat::cli
