#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "core/parallel.h"
#include "parcels/parcel_style.h"

namespace plat::stress {

/// Blocks from one source, each with a style to fit the options to where it has one.
struct StressSet {
  std::string name;
  std::vector<blocks::Block> blocks;
  std::vector<parcels::ParcelStyle> styles;  ///< of no parcels: the strategy's default options
};

/// Random blocks (support/stress_blocks.h), every second one with a random style.
StressSet random_set(std::uint64_t seed, std::uint32_t count);

/// The blocks of an observed city with their styles.
/// @throws InputError where its files are not there
StressSet city_set(const std::string& dataset);

/// A block that was not divided, or not within the time bound.
struct Incident {
  std::uint32_t block = 0;
  std::string code;  ///< of the failure, or "slow"
  std::string message;
  double area_m2 = 0.0;
  double time_ms = 0.0;
};

/// What a strategy made of a set.
struct StressResult {
  std::string set;
  std::string strategy;
  std::size_t blocks = 0;
  std::size_t divided = 0;
  std::size_t parcels = 0;
  std::size_t large = 0;                        ///< blocks above kLargeBlock_m2
  std::size_t large_failed = 0;                 ///< of these
  std::map<std::string, std::size_t> failures;  ///< by code; "not_covered" is a wrong result
  double slowest_ms = 0.0;
  std::uint32_t slowest_block = 0;
  double total_s = 0.0;  ///< of all threads together
  std::vector<Incident> incidents;
};

inline constexpr double kLargeBlock_m2 = 200.0;

/// Divides every block of the set and checks every result to be a coverage. A block that takes
/// longer than `hang_s` ends the program with its number: a hang cannot be stopped from inside.
StressResult run_stress(const StressSet& set, const std::string& strategy, std::uint64_t seed,
                        double slow_ms, double hang_s, Jobs jobs);

/// Well-known text, every digit.
std::string to_wkt(const Polygon& polygon);

}  // namespace plat::stress
