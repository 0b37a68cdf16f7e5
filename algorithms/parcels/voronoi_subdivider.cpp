#include "parcels/voronoi_subdivider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/oriented_box.h"
#include "core/working_grid.h"
#include "parcels/random_divisions.h"
#include "parcels/voronoi_partition.h"

namespace plat::parcels {
namespace {

using Rows = VoronoiSubdivider::Rows;

/// The parts of the long axis of the block's box that lie inside the block.
class Axis {
 public:
  Axis(const Polygon& contour, const OrientedBox& box) : box_(box) {
    std::vector<double> crossings;
    for_each_edge(contour, [&](const Segment& s) {
      const double from = cross(box.axis, s.a - box.center);
      const double to = cross(box.axis, s.b - box.center);
      if ((from >= 0.0) == (to >= 0.0)) return;
      crossings.push_back(dot(lerp(s.a, s.b, from / (from - to)) - box.center, box.axis));
    });
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      parts_.emplace_back(crossings[i], crossings[i + 1]);
      length_m_ += crossings[i + 1] - crossings[i];
    }
  }

  [[nodiscard]] double length_m() const { return length_m_; }

  /// The point at `s` metres from the axis's start, gaps outside the block left out.
  [[nodiscard]] Point at(double s) const {
    for (const auto& [from, to] : parts_) {
      if (s <= to - from || to == parts_.back().second) return box_.center + (from + s) * box_.axis;
      s -= to - from;
    }
    return box_.center;
  }

 private:
  OrientedBox box_;
  std::vector<std::pair<double, double>> parts_;
  double length_m_ = 0.0;
};

double aspect(double a, double b) { return std::max(a, b) / std::max(std::min(a, b), kGridStep_m); }

int choose_rows(const VoronoiSubdivider::Options& options, const OrientedBox& box, double parcels) {
  if (options.rows == Rows::kOne || parcels < 2.0) return 1;
  if (options.rows == Rows::kTwo) return 2;
  const auto misfit = [&](double rows) {
    const double ratio = aspect(box.length_m * rows / parcels, box.width_m / rows);
    return std::abs(std::log(ratio / options.aspect_ratio));
  };
  return misfit(2.0) < misfit(1.0) ? 2 : 1;
}

/// The middles of `count` spacings d + epsilon, epsilon ~ N(0, sigma_b^2), that fill the axis.
std::vector<double> sample_axis(double length_m, int count, double relative_deviation, Rng& rng) {
  const std::vector<double> ends = random_divisions(length_m, count, relative_deviation, rng);
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) out.push_back(0.5 * (ends[i] + ends[i + 1]));
  return out;
}

std::vector<Point> place_sites(const VoronoiSubdivider::Options& options,
                               const blocks::Block& block, Rng& rng) {
  const OrientedBox box = minimum_area_box(block.contour);
  const Axis axis(block.contour, box);
  const double wanted = std::max(1.0, std::round(area_m2(block.contour) / options.area_mean_m2));
  const int rows = choose_rows(options, box, wanted);
  // An odd number in two rows: the row on the left of the axis gets the extra parcel.
  const int total = static_cast<int>(wanted);
  const int left = rows == 1 ? total : (total + 1) / 2;
  // A row's parcels have equal depth, so areas spread as the spacing does.
  const double relative = options.area_deviation_m2 / options.area_mean_m2;
  const Point offset = rows == 1 ? Point{} : options.row_offset_m * perpendicular(box.axis);
  std::vector<Point> sites;
  const std::vector<double> positions = sample_axis(axis.length_m(), left, relative, rng);
  for (const double s : positions) sites.push_back(axis.at(s) + offset);
  if (rows == 2) {
    // Copies on the other side [AVB08]; with one parcel less, the copies are spread over the same
    // length.
    const int right = total - left;
    for (int i = 0; i < right; ++i) {
      const double s = right == left ? positions[static_cast<std::size_t>(i)]
                                     : 0.5 * (positions[static_cast<std::size_t>(i)] +
                                              positions[static_cast<std::size_t>(i) + 1]);
      sites.push_back(axis.at(s) - offset);
    }
  }
  return sites;
}

}  // namespace

Expected<std::vector<Parcel>> VoronoiSubdivider::subdivide(const blocks::Block& block,
                                                           Rng& rng) const {
  if (area_m2(block.contour) / options_.area_mean_m2 > static_cast<double>(kMaxLotsPerBlock)) {
    return fail(FailureCode::kNoConvergence,
                fmt::format("more than {} parcels: raise area_mean_m2", kMaxLotsPerBlock));
  }
  return partition_by_sites(block, place_sites(options_, block, rng))
      .map([](const BlockPartition& partition) { return partition.parcels(); });
}

VoronoiSubdivider VoronoiSubdivider::fitted(const ParcelStyle& style) const {
  Options o = options_;
  o.area_mean_m2 = std::max(1.0, style.area_mean_m2);
  o.area_deviation_m2 = style.area_deviation_m2;
  if (style.width_mean_m > 0.0) {
    // Depth is area over width.
    o.aspect_ratio =
        std::clamp(aspect(style.width_mean_m, style.area_mean_m2 / style.width_mean_m), 1.0, 100.0);
  }
  return VoronoiSubdivider(o);
}

}  // namespace plat::parcels
