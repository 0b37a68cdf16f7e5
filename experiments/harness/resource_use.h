#pragma once

#include <chrono>
#include <optional>

namespace plat::harness {

/// Time that passed and that the processors spent, seconds.
struct Duration {
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of all threads
};

/// Runs from its construction on.
class Stopwatch {
 public:
  Stopwatch();
  [[nodiscard]] Duration elapsed() const;

 private:
  std::chrono::steady_clock::time_point start_;
  double cpu_start_s_;
};

/// Gives free memory back and makes the peak start again from what is in use.
void reset_peak_memory();

/// Most memory in use since the last reset, MB (1e6 bytes); nothing where the system does not say.
std::optional<double> peak_memory_mb();

}  // namespace plat::harness
