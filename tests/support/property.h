#pragma once

#include <cstdlib>
#include <string>

#include "core/rng.h"

namespace plat::testing {

inline std::uint64_t number_from_environment(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  return text == nullptr ? fallback : std::strtoull(text, nullptr, 10);
}

/// The stream of a randomised test: its name, plus PLAT_TEST_SEED to try another.
inline Rng property_rng(const std::string& test_name) {
  return Rng(derive_seed(number_from_environment("PLAT_TEST_SEED", 0), {seed_key(test_name)}));
}

/// How many cases to draw: `base` times PLAT_TEST_ITERATIONS (1 by default).
inline int iterations(int base) {
  return base * static_cast<int>(number_from_environment("PLAT_TEST_ITERATIONS", 1));
}

}  // namespace plat::testing
