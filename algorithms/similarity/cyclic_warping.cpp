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
    reached_.resize((size + 1) * (size + 2));
  }

  CyclicWarping cheapest() {
    // The diagonal that the rings are turned by is the first to be beaten.
    best_cost_ = diagonal_cost_;
    best_.first.resize(static_cast<std::size_t>(n_) + 1);
    for (std::int32_t i = 0; i <= n_; ++i) best_.first[static_cast<std::size_t>(i)] = i;
    best_.last = best_.first;
    if (best_cost_ > least_cost_) {
      reach(0, nullptr, nullptr);
      const Path left = trace(0);
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
    reach(middle, &left, &right);
    if (to - from == 2 && reached_.back() >= best_cost_) return;  // bounds no other
    const Path path = trace(middle);
    search(from, left, middle, path);
    search(middle, path, to, right);
  }

  /// A row while it is filled, from the left. Columns count from the begin.
  struct Row {
    double* here;
    const double* above;
    const float* cost;
    double left = kInfinity;

    void fill(std::int32_t j) {
      left = std::min(std::min(above[j], above[j - 1]), left) + static_cast<double>(cost[j]);
      here[j] = left;
    }
  };

  double* cells(std::int32_t row) {
    return reached_.data() + static_cast<std::size_t>(row) * stride() + 1;
  }
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(n_) + 2; }

  /// The row, with what lies beside the columns that are looked at out of reach for this row and
  /// the next.
  Row open_row(std::int32_t i, std::int32_t begin) {
    const auto row = static_cast<std::size_t>(i);
    double* here = cells(i);
    here[from_[row] - 1] = kInfinity;
    if (i < n_) std::fill(here + to_[row] + 1, here + to_[row + 1] + 1, kInfinity);
    const auto torus_row = row % static_cast<std::size_t>(n_);
    return {here, i > 0 ? cells(i - 1) : nullptr, costs_.data() + torus_row * width_ + begin};
  }

  /// How cheaply all is reached from (0, begin), up to (n, begin + n), between two paths where they
  /// are given.
  void reach(std::int32_t begin, const Path* left, const Path* right) {
    from_.assign(static_cast<std::size_t>(n_) + 1, 0);
    to_.assign(from_.size(), n_);
    for (std::size_t row = 0; row < from_.size(); ++row) {
      if (left != nullptr) from_[row] = std::max(0, left->first[row] - begin);
      if (right != nullptr) to_[row] = std::min(n_, right->last[row] - begin);
    }
    const Row top = open_row(0, begin);
    top.here[0] = 0.0;  // paid at the end, where the path is back
    for (std::int32_t j = 1; j <= to_[0]; ++j)
      top.here[j] = top.here[j - 1] + static_cast<double>(top.cost[j]);
    std::int32_t i = 1;
    for (; i < n_; i += 2) fill_two_rows(i, begin);
    if (i > n_) return;
    Row last = open_row(n_, begin);
    for (std::int32_t j = from_.back(); j <= to_.back(); ++j) last.fill(j);
  }

  /// A row and the next, a column behind: each waits for its own left only, so that a processor
  /// can work on both at once.
  void fill_two_rows(std::int32_t i, std::int32_t begin) {
    const auto row = static_cast<std::size_t>(i);
    Row one = open_row(i, begin);
    Row next = open_row(i + 1, begin);
    const std::int32_t one_to = to_[row];
    const std::int32_t next_from = from_[row + 1];
    std::int32_t j = from_[row];
    for (; j <= std::min(next_from, one_to); ++j) one.fill(j);
    for (; j <= one_to; ++j) {
      one.fill(j);
      next.fill(j - 1);
    }
    for (j = std::max(next_from, one_to); j <= to_[row + 1]; ++j) next.fill(j);
  }

  /// The cheapest path from this begin, back from its end; kept where it is the best so far.
  Path trace(std::int32_t begin) {
    Path path;
    path.first.resize(from_.size());
    path.last.resize(from_.size());
    std::int32_t j = n_;
    for (std::int32_t i = n_; i > 0; --i) {
      const auto row = static_cast<std::size_t>(i);
      const double* here = cells(i);
      const double* above = cells(i - 1);
      path.last[row] = begin + j;
      while (here[j - 1] < std::min(above[j - 1], above[j])) --j;
      path.first[row] = begin + j;
      if (above[j - 1] <= above[j]) --j;
    }
    path.last[0] = begin + j;
    path.first[0] = begin;
    if (reached_.back() < best_cost_) {
      best_cost_ = reached_.back();
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
    const std::ptrdiff_t last_row = best_.last[size] - best_.first[size] + 1;
    std::ranges::rotate(out, out.end() - last_row);
    return out;
  }

  std::int32_t n_;
  std::size_t width_;
  std::size_t shift_ = 0;  ///< the second ring's thing in column 0
  double diagonal_cost_ = 0.0;
  double least_cost_ = 0.0;      ///< of any warping: the cheapest match of every row
  std::vector<float> costs_;     ///< n rows of 2n + 1
  std::vector<double> reached_;  ///< n + 1 rows of n + 2: cheapest way to (i, begin + j), j from -1
  std::vector<std::int32_t> from_;  ///< columns behind the begin that are looked at, per row
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
