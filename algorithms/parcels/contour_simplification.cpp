#include "parcels/contour_simplification.h"

#include <algorithm>

#include "core/validity.h"
#include "core/working_grid.h"

namespace plat::parcels {
namespace {

/// Marks what stays between the kept vertices `from` and `to` (indices modulo n, to > from).
void mark(const Ring& ring, std::size_t from, std::size_t to, double tolerance_m,
          std::vector<bool>& is_kept) {
  if (to - from < 2) return;
  const std::size_t n = ring.size();
  const Segment chord{ring[from % n], ring[to % n]};
  double worst = tolerance_m;
  std::size_t at = from;
  for (std::size_t i = from + 1; i < to; ++i) {
    const double d = distance(chord, ring[i % n]);
    if (d > worst) {
      worst = d;
      at = i;
    }
  }
  if (at == from) return;
  is_kept[at % n] = true;
  mark(ring, from, at, tolerance_m, is_kept);
  mark(ring, at, to, tolerance_m, is_kept);
}

void simplify_ring(const Ring& ring, const std::vector<blocks::BlockEdge>& labels,
                   double tolerance_m, Ring& out, std::vector<blocks::BlockEdge>& out_labels) {
  const std::size_t n = ring.size();
  std::vector<bool> is_kept(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    is_kept[i] = labels[i].logical_street != labels[(i + n - 1) % n].logical_street;
  }
  // Where fewer than two vertices are fixed, the first and the one farthest from it are.
  if (std::count(is_kept.begin(), is_kept.end(), true) < 2) {
    const auto first = static_cast<std::size_t>(std::find(is_kept.begin(), is_kept.end(), true) -
                                                is_kept.begin()) %
                       n;
    std::size_t farthest = first;
    for (std::size_t i = 0; i < n; ++i) {
      if (distance(ring[first], ring[i]) > distance(ring[first], ring[farthest])) farthest = i;
    }
    is_kept[first] = is_kept[farthest] = true;
  }
  std::vector<std::size_t> fixed;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_kept[i]) fixed.push_back(i);
  }
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    const std::size_t to = k + 1 < fixed.size() ? fixed[k + 1] : fixed.front() + n;
    mark(ring, fixed[k], to, tolerance_m, is_kept);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_kept[i]) continue;
    out.push_back(ring[i]);
    out_labels.push_back(labels[i]);
  }
}

}  // namespace

LabelledContour simplify_contour(const blocks::Block& block, double tolerance_m) {
  for (; tolerance_m >= kGridStep_m; tolerance_m /= 4.0) {
    LabelledContour out;
    for (std::size_t r = 0; r < block.edges.size(); ++r) {
      Ring ring;
      simplify_ring(blocks::ring_at(block, r), block.edges[r], tolerance_m, ring, out.labels);
      if (r == 0) {
        out.polygon.outer = std::move(ring);
      } else {
        out.polygon.holes.push_back(std::move(ring));
      }
    }
    const bool is_valid = !find_defect(out.polygon).has_value();
    // Collinear vertices cost the skeleton its robustness (ADR 0002); dropping one could only be at
    // a street's end.
    if (is_valid) return out;
  }
  LabelledContour whole{block.contour, {}};
  for (const auto& ring : block.edges)
    whole.labels.insert(whole.labels.end(), ring.begin(), ring.end());
  return whole;
}

}  // namespace plat::parcels
