#include "core/rng.h"

#include <bit>
#include <boost/random/normal_distribution.hpp>

#include "core/failure.h"

namespace plat {
namespace {

std::uint64_t splitmix64(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

std::uint64_t derive_seed(std::uint64_t master, std::initializer_list<std::uint64_t> keys) {
  std::uint64_t state = master;
  std::uint64_t seed = splitmix64(state);
  for (const std::uint64_t key : keys) {
    state = seed ^ key;
    seed = splitmix64(state);
  }
  return seed;
}

std::uint64_t seed_key(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

Rng::Rng(std::uint64_t seed) : state_{} {
  for (std::uint64_t& word : state_) word = splitmix64(seed);
}

Rng::result_type Rng::operator()() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::uniform_01() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform_01(); }

std::uint64_t Rng::index(std::uint64_t n) {
  expects(n > 0, "Rng::index needs a non-empty range");
  // Rejection keeps every index equally likely.
  const std::uint64_t limit = max() - max() % n;
  std::uint64_t value = (*this)();
  while (value >= limit) value = (*this)();
  return value % n;
}

double Rng::normal(double mean, double standard_deviation) {
  return boost::random::normal_distribution<double>(mean, standard_deviation)(*this);
}

}  // namespace plat
