#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>

namespace plat {

/// A seed for one entity: a function of the master seed and of what the stream is for, so that no
/// result depends on the order of work. Leave the strategy out of `keys`: strategies then meet the
/// same randomness.
std::uint64_t derive_seed(std::uint64_t master, std::initializer_list<std::uint64_t> keys);

/// A key for derive_seed from a name (FNV-1a, the same on every machine).
std::uint64_t seed_key(std::string_view name);

/// A random stream: xoshiro256** (Blackman and Vigna 2018), seeded by splitmix64. Meets
/// UniformRandomBitGenerator. Its distributions are Boost.Random's or its own, never the standard
/// library's, which differ between implementations.
class Rng {
 public:
  using result_type = std::uint64_t;

  explicit Rng(std::uint64_t seed);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  result_type operator()();

  /// Uniform in [0, 1), 53 bits.
  double uniform_01();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Uniform in 0 .. n-1. Pre: n > 0.
  std::uint64_t index(std::uint64_t n);
  /// Normal with the given mean and standard deviation (Boost's ziggurat).
  double normal(double mean, double standard_deviation);

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace plat
