#include "harness/resource_use.h"

#include <malloc.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

namespace plat::harness {
namespace {

double cpu_seconds() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

Stopwatch::Stopwatch() : start_(std::chrono::steady_clock::now()), cpu_start_s_(cpu_seconds()) {}

Duration Stopwatch::elapsed() const {
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(),
          cpu_seconds() - cpu_start_s_};
}

void reset_peak_memory() {
  malloc_trim(0);
  // Linux: 5 resets the high-water mark of the resident set (proc(5)).
  std::ofstream("/proc/self/clear_refs") << "5";
}

std::optional<double> peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("VmHWM:")) continue;
    double kibibytes = 0.0;
    std::istringstream(line.substr(6)) >> kibibytes;
    return kibibytes * 1024.0 / 1e6;
  }
  return std::nullopt;
}

}  // namespace plat::harness
