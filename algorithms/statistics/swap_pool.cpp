#include <algorithm>
#include <cmath>
#include <limits>

#include "core/failure.h"
#include "statistics/swap_pool_internal.h"

namespace plat::statistics::detail {
namespace {

constexpr std::size_t kLanes = SwapPool::kLanes;
using Real = std::array<double, kLanes>;
using Whole = std::array<std::int32_t, kLanes>;

constexpr std::uint32_t kObserved = 0xffffffffU;

struct Tagged {
  double value;
  std::uint32_t cell;
};

/// What one bin adds to the Jensen-Shannon divergence, p and q being its shares.
double divergence_of(double p, double q) {
  if (p == q) return 0.0;
  const double m = 0.5 * (p + q);
  double sum = 0.0;
  if (p > 0.0) sum += 0.5 * p * std::log2(p / m);
  if (q > 0.0) sum += 0.5 * q * std::log2(q / m);
  return sum;
}

}  // namespace

SwapPool::SwapPool(const GroupedSample& observed, const GroupedSample& a, const GroupedSample& b,
                   const Bins& bins)
    : groups_(observed.groups()), observed_size_(static_cast<double>(observed.values.size())) {
  expects(a.groups() == groups_ && b.groups() == groups_, "three samples over the same groups");
  std::vector<Tagged> pool;
  pool.reserve(observed.values.size() + a.values.size() + b.values.size());
  for (const double value : observed.values) pool.push_back({value, kObserved});
  for (std::size_t g = 0; g < groups_; ++g) {
    a_sizes_.push_back(static_cast<std::int32_t>(a.group(g).size()));
    b_sizes_.push_back(static_cast<std::int32_t>(b.group(g).size()));
    const auto cell = static_cast<std::uint32_t>(2 * g);
    for (const double value : a.group(g)) pool.push_back({value, cell});
    for (const double value : b.group(g)) pool.push_back({value, cell + 1});
  }
  expects(pool.size() < std::numeric_limits<std::int32_t>::max(), "a pool below 2^31 values");
  std::sort(pool.begin(), pool.end(), [](const Tagged& x, const Tagged& y) {
    return x.value != y.value ? x.value < y.value : x.cell < y.cell;
  });

  // A step ends after a whole run of equal values: where it is long enough, where a bin ends, and
  // at the end.
  const std::size_t least = pool.size() / kMostSteps;
  double observed_count = 0.0;
  double others_count = 0.0;
  double observed_before_bin = 0.0;
  double last_value = 0.0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    if (pool[i].cell == kObserved) {
      observed_count += 1.0;
    } else {
      others_count += 1.0;
      cells_.push_back(pool[i].cell);
    }
    const bool is_last = i + 1 == pool.size();
    if (!is_last && pool[i + 1].value == pool[i].value) continue;
    const bool ends_bin = is_last || bins.index(pool[i + 1].value) != bins.index(pool[i].value);
    if (!ends_bin && i + 1 - begin < least) continue;
    if (!steps_.empty()) steps_.back().gap = pool[i].value - last_value;
    steps_.push_back({static_cast<std::uint32_t>(cells_.size()), observed_count, others_count, 0.0,
                      ends_bin ? observed_count - observed_before_bin : -1.0});
    if (ends_bin) observed_before_bin = observed_count;
    last_value = pool[i].value;
    begin = i + 1;
  }
}

std::array<Distances, SwapPool::kLanes> SwapPool::differences(const Swaps& swaps) const {
  std::vector<Whole> in_a(2 * groups_);  // whether a cell's values count as A's
  Whole a_total{};
  Whole b_total{};
  for (std::size_t g = 0; g < groups_; ++g) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::int32_t is_swapped = swaps[g][l];
      in_a[2 * g][l] = 1 - is_swapped;
      in_a[2 * g + 1][l] = is_swapped;
      a_total[l] += is_swapped != 0 ? b_sizes_[g] : a_sizes_[g];
      b_total[l] += is_swapped != 0 ? a_sizes_[g] : b_sizes_[g];
    }
  }
  Real a_size{};
  Real b_size{};
  for (std::size_t l = 0; l < kLanes; ++l) {
    expects(a_total[l] > 0 && b_total[l] > 0, "no label is left without values");
    a_size[l] = a_total[l];
    b_size[l] = b_total[l];
  }

  Whole count{};  // values that count as A's so far
  Real a_ks{};
  Real b_ks{};
  Real a_area{};
  Real b_area{};
  Real a_divergence{};
  Real b_divergence{};
  Real a_before_bin{};
  Real b_before_bin{};
  std::size_t entry = 0;
  for (const Step& step : steps_) {
    for (; entry < step.end; ++entry) {
      const Whole& is_in = in_a[cells_[entry]];
      for (std::size_t l = 0; l < kLanes; ++l) count[l] += is_in[l];
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
      // Scaled by both sizes: whole numbers, exact below 2^53.
      const double a_count = count[l];
      const double b_count = step.others - a_count;
      const double a_d = std::abs(a_count * observed_size_ - step.observed * a_size[l]);
      const double b_d = std::abs(b_count * observed_size_ - step.observed * b_size[l]);
      a_ks[l] = a_ks[l] < a_d ? a_d : a_ks[l];
      b_ks[l] = b_ks[l] < b_d ? b_d : b_ks[l];
      a_area[l] += a_d * step.gap;
      b_area[l] += b_d * step.gap;
    }
    if (step.observed_in_bin < 0.0) continue;
    const double q = step.observed_in_bin / observed_size_;
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double a_count = count[l];
      const double b_count = step.others - a_count;
      a_divergence[l] += divergence_of((a_count - a_before_bin[l]) / a_size[l], q);
      b_divergence[l] += divergence_of((b_count - b_before_bin[l]) / b_size[l], q);
      a_before_bin[l] = a_count;
      b_before_bin[l] = b_count;
    }
  }

  std::array<Distances, kLanes> out;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double a_scale = a_size[l] * observed_size_;
    const double b_scale = b_size[l] * observed_size_;
    out[l][DistanceKind::kKolmogorovSmirnov] = a_ks[l] / a_scale - b_ks[l] / b_scale;
    out[l][DistanceKind::kWasserstein] = a_area[l] / a_scale - b_area[l] / b_scale;
    out[l][DistanceKind::kJensenShannon] = std::sqrt(std::clamp(a_divergence[l], 0.0, 1.0)) -
                                           std::sqrt(std::clamp(b_divergence[l], 0.0, 1.0));
  }
  return out;
}

}  // namespace plat::statistics::detail
