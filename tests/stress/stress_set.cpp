#include "stress/stress_set.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "harness/city.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "support/stress_blocks.h"

namespace plat::stress {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Ends the program where a block takes too long, naming it.
class HangGuard {
 public:
  HangGuard(std::string label, std::size_t blocks, double hang_s)
      : label_(std::move(label)),
        since_ms_(blocks),
        hang_ms_(1000.0 * hang_s),
        start_(Clock::now()) {
    for (auto& since : since_ms_) since = kIdle;
    thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
  }

  void begin(std::size_t block) { since_ms_[block] = milliseconds_since(start_); }
  void end(std::size_t block) { since_ms_[block] = kIdle; }

 private:
  static constexpr double kIdle = -1.0;

  void watch(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      const double now = milliseconds_since(start_);
      for (std::size_t i = 0; i < since_ms_.size(); ++i) {
        const double since = since_ms_[i];
        if (since == kIdle || now - since < hang_ms_) continue;
        fmt::print(stderr, "{}: block {} takes longer than {:g} s\n", label_, i, 0.001 * hang_ms_);
        std::_Exit(3);
      }
    }
  }

  std::string label_;
  std::vector<std::atomic<double>> since_ms_;
  double hang_ms_;
  Clock::time_point start_;
  std::jthread thread_;
};

struct Outcome {
  std::string code;  ///< empty where divided
  std::string message;
  std::size_t parcels = 0;
  double time_ms = 0.0;
};

Outcome divide(const blocks::Block& block, const parcels::AnyBlockSubdivider& strategy,
               std::uint64_t seed) {
  Outcome out;
  const auto start = Clock::now();
  try {
    Rng rng(derive_seed(seed, {block.id.value}));
    const auto parcels = strategy.subdivide(block, rng);
    out.time_ms = milliseconds_since(start);
    if (!parcels) {
      out.code = failure_name(parcels.error().code);
      out.message = parcels.error().message;
      return out;
    }
    out.parcels = parcels->size();
    if (const auto defect =
            parcels::find_coverage_defect(block.contour, *parcels, parcels::kContourTolerance_m)) {
      out.code = "not_covered";
      out.message = defect->message;
    }
  } catch (const std::exception& error) {
    out.time_ms = milliseconds_since(start);
    out.code = "exception";
    out.message = error.what();
  }
  return out;
}

void add(StressResult& result, const blocks::Block& block, const Outcome& outcome, double slow_ms) {
  const double area = area_m2(block.contour);
  const bool is_large = area > kLargeBlock_m2;
  ++result.blocks;
  result.large += is_large ? 1 : 0;
  result.parcels += outcome.parcels;
  result.total_s += 0.001 * outcome.time_ms;
  if (outcome.time_ms > result.slowest_ms) {
    result.slowest_ms = outcome.time_ms;
    result.slowest_block = block.id.value;
  }
  if (outcome.time_ms > slow_ms)
    result.incidents.push_back({block.id.value, "slow", outcome.message, area, outcome.time_ms});
  if (outcome.code.empty()) {
    ++result.divided;
    return;
  }
  ++result.failures[outcome.code];
  result.large_failed += is_large ? 1 : 0;
  result.incidents.push_back(
      {block.id.value, outcome.code, outcome.message, area, outcome.time_ms});
}

}  // namespace

StressSet random_set(std::uint64_t seed, std::uint32_t count) {
  StressSet set{"random", {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    set.blocks.push_back(testing::stress_block(seed, i));
    Rng rng(derive_seed(seed, {i, seed_key("style")}));
    const double area = std::exp(rng.uniform(std::log(120.0), std::log(3000.0)));
    const double width = std::sqrt(area) * rng.uniform(0.3, 1.0);
    const parcels::ParcelStyle style{1 + rng.index(30), area, area * rng.uniform(0.0, 1.5), width,
                                     width * rng.uniform(0.0, 1.0)};
    set.styles.push_back(rng.index(2) == 0 ? style : parcels::ParcelStyle{});
  }
  return set;
}

StressSet city_set(const std::string& dataset) {
  StressSet set{dataset, {}, {}};
  for (harness::ObservedBlock& observed : harness::load_city(geodata::dataset(dataset)).blocks) {
    set.styles.push_back(parcels::style_of(observed.block, observed.parcels));
    set.blocks.push_back(std::move(observed.block));
  }
  return set;
}

StressResult run_stress(const StressSet& set, const std::string& strategy, std::uint64_t seed,
                        double slow_ms, double hang_s, Jobs jobs) {
  const parcels::AnyBlockSubdivider base = parcels::block_subdividers().make(strategy);
  HangGuard guard(fmt::format("{} on {}", strategy, set.name), set.blocks.size(), hang_s);
  const auto outcomes = parallel_map<Outcome>(set.blocks.size(), jobs, [&](std::size_t i) {
    guard.begin(i);
    const bool is_fitted = set.styles[i].count > 0;
    Outcome outcome = divide(set.blocks[i], is_fitted ? base.fitted(set.styles[i]) : base, seed);
    guard.end(i);
    return outcome;
  });
  StressResult result;
  result.set = set.name;
  result.strategy = strategy;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    add(result, set.blocks[i], outcomes[i], slow_ms);
  return result;
}

std::string to_wkt(const Polygon& polygon) {
  std::string out = "POLYGON (";
  const auto add_ring = [&](const Ring& ring) {
    out += out.back() == ')' ? ", (" : "(";
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Point p = ring[i % ring.size()];
      out += fmt::format("{}{} {}", i == 0 ? "" : ", ", p.x, p.y);
    }
    out += ")";
  };
  add_ring(polygon.outer);
  for (const Ring& hole : polygon.holes) add_ring(hole);
  return out + ")";
}

}  // namespace plat::stress
