#include "imagery/scanline_grid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/failure.h"
#include "imagery/contour_chains_internal.h"

namespace plat::imagery {
namespace {

using detail::ChainEnds;
using detail::ChainVertex;
using detail::ContourChains;
using detail::ContourProfile;

/// Lines nearer than this in the parameter are one: some micrometres of a parcel.
constexpr double kSameLine_01 = 1e-7;
/// A corner of a quadrilateral may turn the wrong way by this share of the box's area: rounding of
/// points between vertices.
constexpr double kCornerRounding_01 = 1e-10;
/// How wide a step of one metre is made in the parameter, metres, one after the other.
constexpr std::array kLeans{0.5, 0.125, 0.0};

double cross_at(Point before, Point at, Point after) { return cross(after - at, before - at); }

/// Guarantee 1 for one quadrilateral.
bool turns_left_everywhere(const Quad& quad, double tolerance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double turn = cross_at(quad[(i + 3) % 4], quad[i], quad[(i + 1) % 4]);
    if (turn < -tolerance) return false;
    sum += turn;
  }
  return sum > 0.0;
}

struct ChainPoint {
  Point across;
  Point world;
};

/// The point of a chain at a parameter; `from` is the vertex before, kept between calls.
ChainPoint point_at(const std::vector<ChainVertex>& chain, double line, std::size_t& from) {
  while (from + 2 < chain.size() && chain[from + 1].line <= line) ++from;
  const ChainVertex& a = chain[from];
  const ChainVertex& b = chain[from + 1];
  const double t = std::clamp((line - a.line) / (b.line - a.line), 0.0, 1.0);
  return {lerp(a.across, b.across, t), lerp(a.world, b.world, t)};
}

std::vector<double> all_lines(const ContourChains& source, const ContourChains& target) {
  std::vector<double> lines;
  for (const auto* chain : {&source.lower, &source.upper, &target.lower, &target.upper}) {
    for (const ChainVertex& vertex : *chain) lines.push_back(vertex.line);
  }
  std::sort(lines.begin(), lines.end());
  const auto is_same = [](double a, double b) { return b - a < kSameLine_01; };
  lines.erase(std::unique(lines.begin(), lines.end(), is_same), lines.end());
  lines.back() = 1.0;
  return lines;
}

/// The quadrilaterals of one parcel in its frame and in the world.
struct Columns {
  std::vector<Quad> across;
  std::vector<Quad> world;
};

Columns columns_of(const ContourChains& chains, const std::vector<double>& lines) {
  Columns columns;
  std::size_t lower_from = 0;
  std::size_t upper_from = 0;
  ChainPoint lower = point_at(chains.lower, lines.front(), lower_from);
  ChainPoint upper = point_at(chains.upper, lines.front(), upper_from);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const ChainPoint next_lower = point_at(chains.lower, lines[k], lower_from);
    const ChainPoint next_upper = point_at(chains.upper, lines[k], upper_from);
    columns.across.push_back({lower.across, next_lower.across, next_upper.across, upper.across});
    columns.world.push_back({lower.world, next_lower.world, next_upper.world, upper.world});
    lower = next_lower;
    upper = next_upper;
  }
  return columns;
}

bool is_one_to_one(const Columns& columns, const OrientedBox& box) {
  return std::all_of(columns.across.begin(), columns.across.end(), [&](const Quad& quad) {
    return turns_left_everywhere(quad, kCornerRounding_01 * box.area_m2());
  });
}

struct Pair {
  const ParcelShape& source;
  const ParcelShape& target;
  Symmetry symmetry;
};

struct Profiles {
  ContourProfile source;
  ContourProfile target;

  Profiles(const Pair& pair, ScanAxis axis, double simplified_m = 0.0)
      : source(detail::profile_of(pair.source, axis, pair.symmetry,
                                  tolerance(pair.source, simplified_m))),
        target(detail::profile_of(pair.target, axis, Symmetry::kKept,
                                  tolerance(pair.target, simplified_m))) {}
  static double tolerance(const ParcelShape& shape, double wanted_m) {
    return std::min(wanted_m, kMostSimplified_01 * shape.box.width_m);
  }
  [[nodiscard]] bool are_monotone() const {
    return detail::is_monotone(source) && detail::is_monotone(target);
  }
};

struct Ends {
  ChainEnds source;
  ChainEnds target;
};
constexpr std::array kEnds{
    Ends{ChainEnds::kSides, ChainEnds::kSides}, Ends{ChainEnds::kTips, ChainEnds::kSides},
    Ends{ChainEnds::kSides, ChainEnds::kTips}, Ends{ChainEnds::kTips, ChainEnds::kTips}};

std::optional<WarpGrid> grid_of(const Pair& pair, const Profiles& profiles, Ends ends,
                                double lean) {
  const auto source = detail::chains_of(profiles.source, ends.source, lean);
  const auto target = detail::chains_of(profiles.target, ends.target, lean);
  if (!source || !target) return std::nullopt;
  WarpGrid grid;
  grid.symmetry = pair.symmetry;
  grid.lines = all_lines(*source, *target);
  Columns from = columns_of(*source, grid.lines);
  Columns to = columns_of(*target, grid.lines);
  if (!is_one_to_one(from, pair.source.box) || !is_one_to_one(to, pair.target.box))
    return std::nullopt;
  grid.source = std::move(from.world);
  grid.target = std::move(to.world);
  return grid;
}

/// Leaning less and less; at last upright lines between tips, which hardly fail on monotone
/// contours.
std::optional<WarpGrid> first_grid(const Pair& pair, const Profiles& profiles) {
  for (const Ends ends : kEnds) {
    for (const double lean : kLeans) {
      if (auto grid = grid_of(pair, profiles, ends, lean)) return grid;
    }
  }
  return std::nullopt;
}

/// Of contours that lose deeper and deeper notches.
std::optional<WarpGrid> simplified_grid(const Pair& pair) {
  for (double simplified_m = kMostSimplified_m / 8.0; simplified_m <= kMostSimplified_m;
       simplified_m *= 2.0) {
    for (const ScanAxis axis : {ScanAxis::kMain, ScanAxis::kOther}) {
      auto grid = first_grid(pair, Profiles(pair, axis, simplified_m));
      if (!grid) continue;
      grid->kind = WarpKind::kSimplified;
      grid->simplified_m = simplified_m;
      return grid;
    }
  }
  return std::nullopt;
}

Quad box_quad(const OrientedBox& box, Symmetry symmetry) {
  const BoxFrame frame(box, symmetry);
  const double l = frame.length_m();
  const double w = frame.width_m();
  return {frame.to_world({0, 0}), frame.to_world({l, 0}), frame.to_world({l, w}),
          frame.to_world({0, w})};
}

}  // namespace

std::string_view warp_kind_name(WarpKind kind) {
  switch (kind) {
    case WarpKind::kScanLines:
      return "scan_lines";
    case WarpKind::kOtherAxis:
      return "other_axis";
    case WarpKind::kSlanted:
      return "slanted";
    case WarpKind::kSimplified:
      return "simplified";
    case WarpKind::kBox:
      return "box";
  }
  throw LogicError("a warp kind has no name");
}

bool is_monotone(const ParcelShape& shape, ScanAxis axis) {
  return detail::is_monotone(detail::profile_of(shape, axis, Symmetry::kKept));
}

WarpGrid warp_grid(const ParcelShape& source, const ParcelShape& target, Symmetry symmetry) {
  const Pair pair{source, target, symmetry};
  const Profiles along_main(pair, ScanAxis::kMain);
  const Profiles along_other(pair, ScanAxis::kOther);
  const auto found = [](std::optional<WarpGrid> grid, WarpKind kind) {
    if (grid) grid->kind = kind;
    return grid;
  };
  std::optional<WarpGrid> grid;
  if (along_main.are_monotone()) grid = found(first_grid(pair, along_main), WarpKind::kScanLines);
  if (!grid && along_other.are_monotone())
    grid = found(first_grid(pair, along_other), WarpKind::kOtherAxis);
  if (!grid) grid = found(first_grid(pair, along_main), WarpKind::kSlanted);
  if (!grid) grid = found(first_grid(pair, along_other), WarpKind::kSlanted);
  if (!grid) grid = simplified_grid(pair);
  if (grid) return *std::move(grid);
  return {.kind = WarpKind::kBox,
          .symmetry = symmetry,
          .lines = {0.0, 1.0},
          .target = {box_quad(target.box, Symmetry::kKept)},
          .source = {box_quad(source.box, symmetry)}};
}

Point bilinear(const Quad& quad, double a, double b) {
  return lerp(lerp(quad[0], quad[1], a), lerp(quad[3], quad[2], a), b);
}

GridSamples grid_samples(const WarpGrid& grid, std::size_t lines, std::size_t samples) {
  expects(lines >= 2 && samples >= 2, "a grid has two lines and two samples at least");
  GridSamples out;
  std::size_t column = 0;
  for (std::size_t i = 0; i < lines; ++i) {
    const double line = static_cast<double>(i) / static_cast<double>(lines - 1);
    while (column + 1 < grid.target.size() && grid.lines[column + 1] < line) ++column;
    const double a = (line - grid.lines[column]) / (grid.lines[column + 1] - grid.lines[column]);
    for (std::size_t j = 0; j < samples; ++j) {
      const double b = static_cast<double>(j) / static_cast<double>(samples - 1);
      out.target.push_back(bilinear(grid.target[column], a, b));
      out.source.push_back(bilinear(grid.source[column], a, b));
    }
  }
  return out;
}

}  // namespace plat::imagery
