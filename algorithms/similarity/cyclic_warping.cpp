#include "similarity/cyclic_warping.h"

#include <algorithm>
#include <limits>

#include "core/failure.h"

namespace plat::similarity {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The columns of a path, row by row: it enters a row at `first` and leaves it at `last`.
struct Path {
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> last;
};

// The torus of matches is cut open and laid out twice side by side: rows 0 .. n, row n being row 0
// again, columns 0 .. 2n. A warping that begins with (0, k) is a path from there to (n, k + n):
//
//     0        k              n       k+n       2n
//   0 .        o - .          .
//     .             \ .       .
//   n .                 \ - - - - - - o          .
class CyclicWarper {
 public:
  CyclicWarper(std::size_t size, std::span<const float> costs)
      : n_(static_cast<std::int32_t>(size)), width_(2 * size + 1) {
    shift_ = cheapest_diagonal(size, costs);
    costs_.resize(size * width_);
    const auto shift = static_cast<std::ptrdiff_t>(shift_);
    for (std::size_t i = 0; i < size; ++i) {
      const auto row = costs.subspan(i * size, size);
      float* out = costs_.data() + i * width_;
      std::rotate_copy(row.begin(), row.begin() + shift, row.end(), out);
      std::copy_n(out, size + 1, out + size);
      float cheapest = row[0];
      for (const float cost : row) cheapest = std::min(cheapest, cost);
      least_cost_ += cheapest;
    }
    reached_.resize((size + 1) * (size + 1));
  }

  CyclicWarping cheapest() {
    // The diagonal that the rings are turned by is the first to be beaten.
    best_cost_ = diagonal_cost_;
    best_.first.resize(static_cast<std::size_t>(n_) + 1);
    for (std::int32_t i = 0; i <= n_; ++i) best_.first[static_cast<std::size_t>(i)] = i;
    best_.last = best_.first;
    if (best_cost_ > least_cost_) {
      const Path left = cheapest_path(0, nullptr, nullptr);
      Path right = left;
      for (auto* columns : {&right.first, &right.last})
        for (std::int32_t& column : *columns) column += n_;
      search(0, left, n_, right);
    }
    return {best_cost_, matches()};
  }

 private:
  /// How far the second ring is turned for the cheapest warping by steps on both rings only.
  std::size_t cheapest_diagonal(std::size_t size, std::span<const float> costs) {
    std::vector<double> sums(size, 0.0);
    for (std::size_t i = 0; i < size; ++i) {
      const auto row = costs.subspan(i * size, size);
      for (std::size_t k = 0; k < size - i; ++k) sums[k] += row[k + i];
      for (std::size_t k = size - i; k < size; ++k) sums[k] += row[k + i - size];
    }
    const auto least = std::ranges::min_element(sums);
    diagonal_cost_ = *least;
    return static_cast<std::size_t>(least - sums.begin());
  }

  /// Tries all begins between two, whose cheapest paths bound theirs.
  void search(std::int32_t from, const Path& left, std::int32_t to, const Path& right) {
    if (to - from < 2) return;
    const std::int32_t middle = (from + to) / 2;
    const Path path = cheapest_path(middle, &left, &right);
    search(from, left, middle, path);
    search(middle, path, to, right);
  }

  /// The cheapest path from (0, begin) to (n, begin + n), between two others where they are given.
  Path cheapest_path(std::int32_t begin, const Path* left, const Path* right) {
    const std::int32_t end = begin + n_;
    const std::size_t stride = static_cast<std::size_t>(n_) + 1;
    from_.resize(stride);
    to_.resize(stride);
    for (std::int32_t i = 0; i <= n_; ++i) {
      const auto row = static_cast<std::size_t>(i);
      from_[row] = left == nullptr ? begin : std::max(begin, left->first[row]);
      to_[row] = right == nullptr ? end : std::min(end, right->last[row]);
      double* here = reached_.data() + row * stride;
      const float* cost = costs_.data() + (row % static_cast<std::size_t>(n_)) * width_;
      if (i == 0) {
        first_row(begin, here, cost);
      } else {
        next_row(i, begin, here, cost);
      }
    }
    return trace(begin);
  }

  void first_row(std::int32_t begin, double* here, const float* cost) const {
    here[0] = 0.0;  // paid at the end, where the path is back
    for (std::int32_t j = begin + 1; j <= to_[0]; ++j)
      here[j - begin] = here[j - begin - 1] + cost[j];
  }

  void next_row(std::int32_t i, std::int32_t begin, double* here, const float* cost) const {
    const auto row = static_cast<std::size_t>(i);
    const double* above = here - (n_ + 1);
    double left = kInfinity;
    const auto reach = [&](std::int32_t j, double before) {
      left = std::min(before, left) + cost[j];
      here[j - begin] = left;
    };
    // Above are columns from_[row - 1] .. to_[row - 1]; those of this row begin and end later.
    const std::int32_t above_to = to_[row - 1];
    std::int32_t j = from_[row];
    if (j == from_[row - 1]) {
      reach(j, above[j - begin]);
      ++j;
    }
    for (; j <= std::min(above_to, to_[row]); ++j)
      reach(j, std::min(above[j - begin], above[j - begin - 1]));
    for (; j <= to_[row]; ++j) reach(j, j == above_to + 1 ? above[j - begin - 1] : kInfinity);
  }

  /// Walks back from the end; keeps the path where it is the best so far.
  Path trace(std::int32_t begin) {
    const std::size_t stride = static_cast<std::size_t>(n_) + 1;
    Path path;
    path.first.resize(stride);
    path.last.resize(stride);
    std::int32_t j = begin + n_;
    for (std::int32_t i = n_; i >= 0; --i) {
      const auto row = static_cast<std::size_t>(i);
      const double* here = reached_.data() + row * stride;
      path.last[row] = j;
      if (i == 0) {
        path.first[0] = begin;
        break;
      }
      const double* above = here - stride;
      const auto value = [&](const double* values, std::size_t r, std::int32_t column) {
        return from_[r] <= column && column <= to_[r] ? values[column - begin] : kInfinity;
      };
      for (;;) {
        const double both = value(above, row - 1, j - 1);
        const double down = value(above, row - 1, j);
        const double right = value(here, row, j - 1);
        path.first[row] = j;
        if (both <= down && both <= right) {
          --j;
          break;
        }
        if (down <= right) break;
        --j;
      }
    }
    const double cost =
        reached_[static_cast<std::size_t>(n_) * stride + static_cast<std::size_t>(n_)];
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_ = path;
    }
    return path;
  }

  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> matches() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
    const auto size = static_cast<std::size_t>(n_);
    const auto add = [&](std::size_t i, std::int32_t j) {
      out.emplace_back(static_cast<std::uint32_t>(i % size),
                       static_cast<std::uint32_t>((static_cast<std::size_t>(j) + shift_) % size));
    };
    for (std::size_t i = 0; i <= size; ++i)
      for (std::int32_t j = best_.first[i]; j <= best_.last[i]; ++j)
        if (i > 0 || j > best_.first[0]) add(i, j);
    // Row n is row 0 again: what lies in it comes before all else.
    const auto last_row = static_cast<std::ptrdiff_t>(best_.last[size] - best_.first[size] + 1);
    std::ranges::rotate(out, out.end() - last_row);
    return out;
  }

  std::int32_t n_;
  std::size_t width_;
  std::size_t shift_ = 0;  ///< the second ring's thing in column 0
  double diagonal_cost_ = 0.0;
  double least_cost_ = 0.0;         ///< of any warping: the cheapest match of every row
  std::vector<float> costs_;        ///< n rows of 2n + 1
  std::vector<double> reached_;     ///< n + 1 rows of n + 1: cheapest way to (i, begin + j)
  std::vector<std::int32_t> from_;  ///< columns that are looked at, per row
  std::vector<std::int32_t> to_;
  double best_cost_ = kInfinity;
  Path best_;
};

}  // namespace

CyclicWarping cheapest_cyclic_warping(std::size_t size, std::span<const float> costs) {
  expects(size > 0 && costs.size() == size * size, "a square matrix of costs");
  return CyclicWarper(size, costs).cheapest();
}

}  // namespace plat::similarity
