#include "similarity/weighted_k_means.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/failure.h"

namespace plat::similarity {
namespace {

/// Rows per task of the parallel loop.
constexpr std::size_t kRowsPerTask = 256;

double squared_distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// Columns times the roots of their weights: plain squared distances from here on.
NumberTable weighted(const NumberTable& table, std::span<const double> weights) {
  NumberTable out = table;
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] *= std::sqrt(weights[i % table.columns]);
  return out;
}

void append(NumberTable& to, std::span<const double> row) {
  to.values.insert(to.values.end(), row.begin(), row.end());
}

/// k-means++: each next seed with a probability proportional to the squared distance to the nearest
/// seed so far. Ends early where every row is a seed.
NumberTable seeds_of(const NumberTable& rows, std::size_t clusters, Rng& rng) {
  NumberTable seeds{rows.columns, {}};
  append(seeds, rows.row(rng.index(rows.rows())));
  std::vector<double> nearest(rows.rows(), std::numeric_limits<double>::infinity());
  while (seeds.rows() < clusters) {
    const auto last = seeds.row(seeds.rows() - 1);
    for (std::size_t i = 0; i < rows.rows(); ++i)
      nearest[i] = std::min(nearest[i], squared_distance(rows.row(i), last));
    const double total = std::accumulate(nearest.begin(), nearest.end(), 0.0);
    if (!(total > 0.0)) break;
    double left = rng.uniform_01() * total;
    std::size_t chosen = rows.rows();
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      if (!(nearest[i] > 0.0)) continue;
      chosen = i;  // the last candidate where rounding leaves a rest
      left -= nearest[i];
      if (left < 0.0) break;
    }
    append(seeds, rows.row(chosen));
  }
  return seeds;
}

struct Assignment {
  std::vector<std::uint32_t> cluster_of;
  std::vector<double> squared;  // to the mean of its cluster
};

/// Each row to the nearest mean; among equals it stays, else the lower number.
Assignment nearest_means(const NumberTable& rows, const NumberTable& means,
                         const std::vector<std::uint32_t>& before, Jobs jobs) {
  Assignment out{std::vector<std::uint32_t>(rows.rows()), std::vector<double>(rows.rows())};
  const std::size_t tasks = (rows.rows() + kRowsPerTask - 1) / kRowsPerTask;
  parallel_for(tasks, jobs, [&](std::size_t task) {
    const std::size_t end = std::min(rows.rows(), (task + 1) * kRowsPerTask);
    for (std::size_t i = task * kRowsPerTask; i < end; ++i) {
      std::size_t best = before.empty() ? 0 : before[i];
      double least = squared_distance(rows.row(i), means.row(best));
      for (std::size_t k = 0; k < means.rows(); ++k) {
        const double squared = squared_distance(rows.row(i), means.row(k));
        if (squared < least) {
          least = squared;
          best = k;
        }
      }
      out.cluster_of[i] = static_cast<std::uint32_t>(best);
      out.squared[i] = least;
    }
  });
  return out;
}

/// Gives every empty cluster the row that is farthest from its own mean, out of a cluster that has
/// others. There is one: no more clusters than different rows.
void fill_empty_clusters(Assignment& assignment, std::size_t clusters) {
  std::vector<std::size_t> size(clusters, 0);
  for (const std::uint32_t k : assignment.cluster_of) ++size[k];
  for (std::size_t k = 0; k < clusters; ++k) {
    if (size[k] > 0) continue;
    std::size_t farthest = assignment.cluster_of.size();
    for (std::size_t i = 0; i < assignment.cluster_of.size(); ++i) {
      if (size[assignment.cluster_of[i]] > 1 &&
          (farthest == assignment.cluster_of.size() ||
           assignment.squared[i] > assignment.squared[farthest]))
        farthest = i;
    }
    expects(farthest < assignment.cluster_of.size(), "no more clusters than rows");
    --size[assignment.cluster_of[farthest]];
    assignment.cluster_of[farthest] = static_cast<std::uint32_t>(k);
    assignment.squared[farthest] = 0.0;
    size[k] = 1;
  }
}

/// Summed in row order by one thread: the same to the last bit for any number of threads.
NumberTable means_of(const NumberTable& rows, const std::vector<std::uint32_t>& cluster_of,
                     std::size_t clusters) {
  NumberTable means{rows.columns, std::vector<double>(clusters * rows.columns, 0.0)};
  std::vector<double> size(clusters, 0.0);
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    size[cluster_of[i]] += 1.0;
    for (std::size_t c = 0; c < rows.columns; ++c)
      means.values[cluster_of[i] * rows.columns + c] += rows.row(i)[c];
  }
  for (std::size_t i = 0; i < means.values.size(); ++i) means.values[i] /= size[i / rows.columns];
  return means;
}

Clusters clusters_of(const NumberTable& rows, const NumberTable& means,
                     std::vector<std::uint32_t> cluster_of) {
  Clusters out{std::move(cluster_of), std::vector<std::vector<std::uint32_t>>(means.rows())};
  for (std::size_t i = 0; i < rows.rows(); ++i)
    out.members[out.cluster_of[i]].push_back(static_cast<std::uint32_t>(i));
  for (std::size_t k = 0; k < means.rows(); ++k) {
    std::stable_sort(out.members[k].begin(), out.members[k].end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return squared_distance(rows.row(a), means.row(k)) <
                              squared_distance(rows.row(b), means.row(k));
                     });
  }
  return out;
}

void expect_usable(const NumberTable& table, std::span<const double> weights, std::size_t clusters,
                   int max_steps) {
  expects(
      table.columns > 0 && table.rows() > 0 && table.values.size() == table.rows() * table.columns,
      "a table of at least one row");
  expects(weights.size() == table.columns, "a weight per column");
  expects(clusters > 0 && max_steps > 0, "at least one cluster and one step");
  const auto is_finite = [](double value) { return std::isfinite(value); };
  expects(std::all_of(table.values.begin(), table.values.end(), is_finite), "finite numbers");
  expects(std::all_of(weights.begin(), weights.end(),
                      [](double weight) { return std::isfinite(weight) && weight >= 0.0; }),
          "weights that are not negative");
}

}  // namespace

std::size_t cluster_count(std::size_t things, double percent) {
  const double count = std::round(static_cast<double>(things) * percent / 100.0);
  return std::max<std::size_t>(1, static_cast<std::size_t>(count));
}

KMeansResult weighted_k_means(const NumberTable& table, std::span<const double> weights,
                              std::size_t clusters, Rng& rng, int max_steps, Jobs jobs) {
  expect_usable(table, weights, clusters, max_steps);
  const NumberTable rows = weighted(table, weights);
  NumberTable means = seeds_of(rows, clusters, rng);
  KMeansResult out;
  std::vector<std::uint32_t> cluster_of;
  for (int step = 0; step < max_steps && !out.is_settled; ++step) {
    Assignment next = nearest_means(rows, means, cluster_of, jobs);
    fill_empty_clusters(next, means.rows());
    out.sum_of_squares.push_back(std::accumulate(next.squared.begin(), next.squared.end(), 0.0));
    out.is_settled = next.cluster_of == cluster_of;
    cluster_of = std::move(next.cluster_of);
    means = means_of(rows, cluster_of, means.rows());
  }
  out.means = means_of(table, cluster_of, means.rows());
  out.clusters = clusters_of(rows, means, std::move(cluster_of));
  return out;
}

}  // namespace plat::similarity
