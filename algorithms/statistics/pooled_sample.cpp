#include "statistics/pooled_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/failure.h"

namespace plat::statistics {
namespace {

constexpr std::size_t kLanes = PooledSample::kLanes;
using Real = std::array<double, kLanes>;
using Whole = std::array<std::int32_t, kLanes>;

struct Tagged {
  double value;
  std::uint32_t cell;
};

}  // namespace

PooledSample::PooledSample(std::span<const GroupedSample* const> samples, const Bins& bins) {
  expects(!samples.empty(), "a pool needs a sample");
  groups_ = samples.front()->groups();
  std::vector<Tagged> pool;
  for (const GroupedSample* sample : samples) {
    expects(sample->groups() == groups_, "samples of one pool have the same groups");
    for (std::size_t g = 0; g < groups_; ++g) {
      const auto id = static_cast<std::uint32_t>(cell_sizes_.size());
      cell_sizes_.push_back(static_cast<std::uint32_t>(sample->group(g).size()));
      for (const double value : sample->group(g)) {
        expects(std::isfinite(value), "measured values are finite");
        pool.push_back({value, id});
      }
    }
  }
  expects(pool.size() < std::numeric_limits<std::int32_t>::max(), "a pool below 2^31 values");
  std::sort(pool.begin(), pool.end(), [](const Tagged& a, const Tagged& b) {
    return a.value != b.value ? a.value < b.value : a.cell < b.cell;
  });
  cells_.reserve(pool.size());
  std::size_t bin = 0;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    cells_.push_back(pool[i].cell);
    const bool is_last = i + 1 == pool.size();
    if (!is_last && pool[i + 1].value == pool[i].value) continue;
    for (const std::size_t own = bins.index(pool[i].value); bin < own; ++bin)
      bin_ends_.push_back(static_cast<std::uint32_t>(runs_.size()));
    runs_.push_back(
        {static_cast<std::uint32_t>(i + 1), is_last ? 0.0 : pool[i + 1].value - pool[i].value});
  }
  bin_ends_.resize(bins.count(), static_cast<std::uint32_t>(runs_.size()));
}

std::array<Distances, PooledSample::kLanes> PooledSample::distances(
    std::span<const CellWeight> weights) const {
  expects(weights.size() == cell_sizes_.size(), "one weight per cell");
  std::array<std::int64_t, kLanes> x_total{};
  std::array<std::int64_t, kLanes> y_total{};
  for (std::size_t c = 0; c < weights.size(); ++c) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      x_total[l] += static_cast<std::int64_t>(weights[c].x[l]) * cell_sizes_[c];
      y_total[l] += static_cast<std::int64_t>(weights[c].y[l]) * cell_sizes_[c];
    }
  }
  Real x_size{};
  Real y_size{};
  for (std::size_t l = 0; l < kLanes; ++l) {
    expects(x_total[l] > 0 && y_total[l] > 0, "each lane weighs two non-empty samples");
    expects(std::max(x_total[l], y_total[l]) < std::numeric_limits<std::int32_t>::max(),
            "weighted samples below 2^31 values");
    x_size[l] = static_cast<double>(x_total[l]);
    y_size[l] = static_cast<double>(y_total[l]);
  }

  // Counts are whole numbers, hence exact; lanes are independent, so that the compiler may compute
  // them side by side without changing a bit.
  Whole x{};
  Whole y{};
  Real ks{};
  Real area{};
  std::array<double, kLanes> divergence{};
  std::size_t entry = 0;
  std::size_t run = 0;
  const CellWeight* const table = weights.data();
  for (const std::uint32_t bin_end : bin_ends_) {
    const Whole x_before = x;
    const Whole y_before = y;
    for (; run < bin_end; ++run) {
      const Run& r = runs_[run];
      for (; entry < r.end; ++entry) {
        const CellWeight& w = table[cells_[entry]];
        for (std::size_t l = 0; l < kLanes; ++l) x[l] += w.x[l];
        for (std::size_t l = 0; l < kLanes; ++l) y[l] += w.y[l];
      }
      for (std::size_t l = 0; l < kLanes; ++l) {
        // Scaled by both sizes: whole numbers, exact below 2^53, and exactly 0 for equal samples.
        const double d = std::abs(x[l] * y_size[l] - y[l] * x_size[l]);
        ks[l] = ks[l] < d ? d : ks[l];
        area[l] += d * r.gap;
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double p = (x[l] - x_before[l]) / x_size[l];
      const double q = (y[l] - y_before[l]) / y_size[l];
      if (p == q) continue;
      const double m = 0.5 * (p + q);
      if (p > 0.0) divergence[l] += 0.5 * p * std::log2(p / m);
      if (q > 0.0) divergence[l] += 0.5 * q * std::log2(q / m);
    }
  }
  std::array<Distances, kLanes> out;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double scale = x_size[l] * y_size[l];
    out[l][DistanceKind::kKolmogorovSmirnov] = ks[l] / scale;
    out[l][DistanceKind::kWasserstein] = area[l] / scale;
    out[l][DistanceKind::kJensenShannon] = std::sqrt(std::clamp(divergence[l], 0.0, 1.0));
  }
  return out;
}

}  // namespace plat::statistics
