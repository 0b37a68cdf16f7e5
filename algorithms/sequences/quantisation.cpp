#include "sequences/quantisation.h"

#include <cmath>
#include <numeric>

#include "core/failure.h"

namespace plat::sequences {
namespace {

constexpr int kMaxDecimals = 9;
constexpr double kMaxValue = 1e9;
/// A double holds about 15.9 decimal digits: what differs less than this from a whole number, by
/// its own size, is that number as far as it was written.
constexpr double kRelativeTolerance = 1e-14;

/// How many decimals the value is written with, at most 9.
std::optional<int> decimals(double value) {
  double scale = 1.0;
  for (int count = 0; count <= kMaxDecimals; ++count, scale *= 10.0) {
    const double scaled = value * scale;
    if (std::abs(scaled - std::round(scaled)) <= kRelativeTolerance * scaled) return count;
  }
  return std::nullopt;
}

}  // namespace

Quantised quantised(double value, double step) {
  expects(step > 0.0, "a step is positive");
  const double steps = std::round(value / step);
  return {static_cast<std::int64_t>(steps), std::abs(value / step - steps)};
}

std::optional<double> common_step(std::span<const double> values) {
  int most = 0;
  for (const double value : values) {
    if (!(std::abs(value) <= kMaxValue)) return std::nullopt;
    const auto count = decimals(std::abs(value));
    if (!count) return std::nullopt;
    most = std::max(most, *count);
  }
  const double scale = std::pow(10.0, most);
  std::int64_t divisor = 0;
  for (const double value : values) divisor = std::gcd(divisor, std::llround(value * scale));
  return divisor == 0 ? 1.0 : static_cast<double>(divisor) / scale;
}

}  // namespace plat::sequences
