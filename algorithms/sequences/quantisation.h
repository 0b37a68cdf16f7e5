#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace plat::sequences {

/// How far from a whole number of steps a value may be, in steps, to count as one: what is left of
/// a decimal fraction after it was summed or multiplied as a double, and far below any quantum that
/// means something.
inline constexpr double kMultipleTolerance = 1e-6;

/// A value in whole steps, and how far off that is.
struct Quantised {
  std::int64_t steps = 0;
  double error = 0.0;  ///< |value - steps * step|, in steps
  [[nodiscard]] bool is_multiple() const { return error <= kMultipleTolerance; }
};
/// The nearest whole number of steps. Pre: step > 0.
Quantised quantised(double value, double step);

/// The greatest common divisor of the values as they are written in decimal notation: 0.6 and 1.5
/// share 0.3. Values that are zero do not count; 1 where all are. Nothing where a value needs more
/// than 9 decimals or is beyond 10^9: such values were measured, not counted, and need a step that
/// a person chooses.
/// Paper: [Har, Sec. 3.3.1]
std::optional<double> common_step(std::span<const double> values);

}  // namespace plat::sequences
