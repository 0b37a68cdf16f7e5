#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/failure.h"
#include "core/planar_graph.h"
#include "core/working_grid.h"

namespace plat {
namespace {

// Exactness: coordinates are below 2^31 grid units, so differences fit 32 bits, cross products 65
// bits and the crossing's numerator 98 bits: all in __int128, which g++ and clang have on every
// 64-bit machine.
__extension__ using Wide = __int128;

struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

struct GridSegment {
  GridPoint a;
  GridPoint b;
  std::uint32_t source = 0;
};

Wide cross(GridPoint o, GridPoint p, GridPoint q) {
  return static_cast<Wide>(p.x - o.x) * (q.y - o.y) - static_cast<Wide>(p.y - o.y) * (q.x - o.x);
}

int sign(Wide w) { return (w > 0) - (w < 0); }

std::int64_t floor_divide(Wide numerator, Wide denominator) {  // denominator > 0
  Wide q = numerator / denominator;
  if (numerator % denominator < 0) --q;
  return static_cast<std::int64_t>(q);
}

/// The crossing of two segments that cross properly, rounded to the grid as to_grid() rounds.
GridPoint rounded_crossing(const GridSegment& s, const GridSegment& t) {
  const GridPoint d{s.b.x - s.a.x, s.b.y - s.a.y};
  const GridPoint e{t.b.x - t.a.x, t.b.y - t.a.y};
  Wide denominator = static_cast<Wide>(d.x) * e.y - static_cast<Wide>(d.y) * e.x;
  Wide numerator = static_cast<Wide>(t.a.x - s.a.x) * e.y - static_cast<Wide>(t.a.y - s.a.y) * e.x;
  if (denominator < 0) {
    denominator = -denominator;
    numerator = -numerator;
  }
  const auto along = [&](std::int64_t from, std::int64_t delta) {
    return from + floor_divide(2 * numerator * delta + denominator, 2 * denominator);
  };
  return {along(s.a.x, d.x), along(s.a.y, d.y)};
}

bool cross_properly(const GridSegment& s, const GridSegment& t) {
  return sign(cross(s.a, s.b, t.a)) * sign(cross(s.a, s.b, t.b)) < 0 &&
         sign(cross(t.a, t.b, s.a)) * sign(cross(t.a, t.b, s.b)) < 0;
}

/// Whether the segment meets the cell [c - 1/2, c + 1/2) x [c - 1/2, c + 1/2). In doubled
/// coordinates the ends of the segment are even and the sides of the cell odd, so that only a
/// corner can be met without being crossed.
bool meets_cell(const GridSegment& s, GridPoint c) {
  if (std::max(s.a.x, s.b.x) < c.x || std::min(s.a.x, s.b.x) > c.x ||
      std::max(s.a.y, s.b.y) < c.y || std::min(s.a.y, s.b.y) > c.y) {
    return false;
  }
  const GridPoint a{2 * s.a.x, 2 * s.a.y};
  const GridPoint b{2 * s.b.x, 2 * s.b.y};
  const int bottom_left = sign(cross(a, b, {2 * c.x - 1, 2 * c.y - 1}));
  const int bottom_right = sign(cross(a, b, {2 * c.x + 1, 2 * c.y - 1}));
  const int top_left = sign(cross(a, b, {2 * c.x - 1, 2 * c.y + 1}));
  const int top_right = sign(cross(a, b, {2 * c.x + 1, 2 * c.y + 1}));
  const auto [low, high] = std::minmax({bottom_left, bottom_right, top_left, top_right});
  return (low < 0 && high > 0) || bottom_left == 0;
}

/// Buckets of a uniform grid over the segments; each lists what passes within one grid unit of it.
class Buckets {
 public:
  explicit Buckets(std::span<const GridSegment> segments) {
    GridPoint low{std::numeric_limits<std::int64_t>::max(),
                  std::numeric_limits<std::int64_t>::max()};
    GridPoint high{std::numeric_limits<std::int64_t>::min(),
                   std::numeric_limits<std::int64_t>::min()};
    double total_length = 0.0;
    for (const GridSegment& s : segments) {
      low = {std::min({low.x, s.a.x, s.b.x}), std::min({low.y, s.a.y, s.b.y})};
      high = {std::max({high.x, s.a.x, s.b.x}), std::max({high.y, s.a.y, s.b.y})};
      total_length +=
          std::hypot(static_cast<double>(s.b.x - s.a.x), static_cast<double>(s.b.y - s.a.y));
    }
    origin_ = low;
    // About as many cells as segments, but none much smaller than a mean segment.
    const auto count = static_cast<double>(segments.size());
    const double width = static_cast<double>(high.x - low.x) + 1.0;
    const double height = static_cast<double>(high.y - low.y) + 1.0;
    const double cell = std::max({std::sqrt(width * height / count), 0.5 * total_length / count,
                                  std::max(width, height) / 4096.0, 4.0});
    cell_ = static_cast<std::int64_t>(std::ceil(cell));
    columns_ = (high.x - low.x) / cell_ + 1;
    rows_ = (high.y - low.y) / cell_ + 1;
    fill(segments);
  }

  [[nodiscard]] std::size_t size() const { return offsets_.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> at(std::size_t bucket) const {
    return {items_.data() + offsets_[bucket], offsets_[bucket + 1] - offsets_[bucket]};
  }
  [[nodiscard]] std::size_t bucket_of(GridPoint p) const {
    return static_cast<std::size_t>(row(p.y) * columns_ + column(p.x));
  }

  template <class Visit>
  void for_each_bucket(const GridSegment& s, Visit visit) const {
    const auto [x0, x1] = std::minmax(s.a.x, s.b.x);
    const std::int64_t c0 = column(x0 - 1);
    const std::int64_t c1 = column(x1 + 1);
    if (c0 == c1) {
      const auto [y0, y1] = std::minmax(s.a.y, s.b.y);
      visit_column(c0, y0, y1, visit);
      return;
    }
    // In each column only the rows between the segment's heights there (widened: the clipping is in
    // doubles).
    const GridPoint left = s.a.x <= s.b.x ? s.a : s.b;
    const GridPoint right = s.a.x <= s.b.x ? s.b : s.a;
    const double slope = right.x == left.x ? 0.0
                                           : static_cast<double>(right.y - left.y) /
                                                 static_cast<double>(right.x - left.x);
    const auto height_at = [&](std::int64_t x) {
      if (x <= left.x) return left.y;
      if (x >= right.x) return right.y;
      return left.y +
             static_cast<std::int64_t>(std::lround(slope * static_cast<double>(x - left.x)));
    };
    for (std::int64_t c = c0; c <= c1; ++c) {
      std::int64_t y0 = height_at(origin_.x + c * cell_ - 2);
      std::int64_t y1 = height_at(origin_.x + (c + 1) * cell_ + 2);
      if (left.x == right.x) {
        y0 = left.y;
        y1 = right.y;
      }
      if (y0 > y1) std::swap(y0, y1);
      visit_column(c, y0 - 2, y1 + 2, visit);
    }
  }

 private:
  [[nodiscard]] std::int64_t column(std::int64_t x) const {
    return std::clamp<std::int64_t>((x - origin_.x) / cell_, 0, columns_ - 1);
  }
  [[nodiscard]] std::int64_t row(std::int64_t y) const {
    return std::clamp<std::int64_t>((y - origin_.y) / cell_, 0, rows_ - 1);
  }

  template <class Visit>
  void visit_column(std::int64_t c, std::int64_t y0, std::int64_t y1, Visit& visit) const {
    const std::int64_t last = row(y1 + 1);
    for (std::int64_t r = row(y0 - 1); r <= last; ++r)
      visit(static_cast<std::size_t>(r * columns_ + c));
  }

  void fill(std::span<const GridSegment> segments) {
    offsets_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (const GridSegment& s : segments)
      for_each_bucket(s, [&](std::size_t b) { ++offsets_[b + 1]; });
    for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
    items_.resize(offsets_.back());
    std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
      for_each_bucket(segments[i], [&](std::size_t b) { items_[next[b]++] = i; });
    }
  }

  GridPoint origin_;
  std::int64_t cell_ = 1;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::uint32_t> offsets_;
  std::vector<std::uint32_t> items_;
};

std::vector<GridPoint> find_hot_points(std::span<const GridSegment> segments,
                                       const Buckets& buckets) {
  std::vector<GridPoint> hot;
  hot.reserve(3 * segments.size());
  for (const GridSegment& s : segments) {
    hot.push_back(s.a);
    hot.push_back(s.b);
  }
  for (std::size_t bucket = 0; bucket < buckets.size(); ++bucket) {
    const auto items = buckets.at(bucket);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const GridSegment& s = segments[items[i]];
      const auto [sx0, sx1] = std::minmax(s.a.x, s.b.x);
      const auto [sy0, sy1] = std::minmax(s.a.y, s.b.y);
      for (std::size_t j = i + 1; j < items.size(); ++j) {
        const GridSegment& t = segments[items[j]];
        if (std::max(t.a.x, t.b.x) < sx0 || std::min(t.a.x, t.b.x) > sx1 ||
            std::max(t.a.y, t.b.y) < sy0 || std::min(t.a.y, t.b.y) > sy1) {
          continue;
        }
        if (cross_properly(s, t)) hot.push_back(rounded_crossing(s, t));
      }
    }
  }
  std::sort(hot.begin(), hot.end());
  hot.erase(std::unique(hot.begin(), hot.end()), hot.end());
  return hot;
}

/// One pass of snap rounding; false where nothing had to be bent.
bool bend_through_hot_cells(std::vector<GridSegment>& segments) {
  const Buckets buckets(segments);
  const std::vector<GridPoint> hot = find_hot_points(segments, buckets);

  std::vector<std::uint32_t> offsets(buckets.size() + 1, 0);
  for (const GridPoint p : hot) ++offsets[buckets.bucket_of(p) + 1];
  for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
  std::vector<std::uint32_t> in_bucket(hot.size());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::uint32_t i = 0; i < hot.size(); ++i) in_bucket[next[buckets.bucket_of(hot[i])]++] = i;

  std::vector<GridSegment> bent;
  bent.reserve(segments.size() + segments.size() / 2);
  std::vector<std::pair<Wide, GridPoint>> met;
  bool has_changed = false;
  for (const GridSegment& s : segments) {
    met.clear();
    const GridPoint d{s.b.x - s.a.x, s.b.y - s.a.y};
    buckets.for_each_bucket(s, [&](std::size_t bucket) {
      for (std::uint32_t k = offsets[bucket]; k < offsets[bucket + 1]; ++k) {
        const GridPoint p = hot[in_bucket[k]];
        if (p == s.a || p == s.b || !meets_cell(s, p)) continue;
        met.emplace_back(
            static_cast<Wide>(p.x - s.a.x) * d.x + static_cast<Wide>(p.y - s.a.y) * d.y, p);
      }
    });
    if (met.empty()) {
      bent.push_back(s);
      continue;
    }
    has_changed = true;
    std::sort(met.begin(), met.end());
    GridPoint from = s.a;
    for (const auto& [along, p] : met) {
      if (p != from) bent.push_back({from, p, s.source});
      from = p;
    }
    if (from != s.b) bent.push_back({from, s.b, s.source});
  }
  // Collinear overlaps become equal segments: one of each is enough for the next pass, but every
  // source is kept.
  segments = std::move(bent);
  return has_changed;
}

PlanarGraph build_graph(std::span<const GridSegment> segments) {
  PlanarGraph graph;
  std::vector<GridPoint> nodes;
  nodes.reserve(2 * segments.size());
  for (const GridSegment& s : segments) {
    nodes.push_back(s.a);
    nodes.push_back(s.b);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto index_of = [&](GridPoint p) {
    return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), p) -
                                      nodes.begin());
  };
  std::vector<PlanarGraph::Edge> edges;
  edges.reserve(segments.size());
  for (const GridSegment& s : segments) edges.push_back({index_of(s.a), index_of(s.b), s.source});
  const auto ends = [](const PlanarGraph::Edge& e) {
    return std::pair(std::min(e.from, e.to), std::max(e.from, e.to));
  };
  std::sort(edges.begin(), edges.end(), [&](const auto& e, const auto& f) {
    return std::tuple(ends(e), e.source, e.from) < std::tuple(ends(f), f.source, f.from);
  });
  graph.edges.reserve(edges.size());
  for (const PlanarGraph::Edge& e : edges) {
    if (!graph.edges.empty() && ends(graph.edges.back()) == ends(e)) {
      const PlanarGraph::Overlap overlap{static_cast<std::uint32_t>(graph.edges.size() - 1),
                                         e.source};
      const bool is_known =
          graph.edges.back().source == e.source ||
          (!graph.overlaps.empty() && graph.overlaps.back().edge == overlap.edge &&
           graph.overlaps.back().source == e.source);
      if (!is_known) graph.overlaps.push_back(overlap);
    } else {
      graph.edges.push_back(e);
    }
  }
  graph.nodes.reserve(nodes.size());
  for (const GridPoint p : nodes) graph.nodes.push_back({from_grid(p.x), from_grid(p.y)});
  return graph;
}

}  // namespace

PlanarGraph node_segments(std::span<const Segment> input) {
  std::vector<GridSegment> segments;
  segments.reserve(input.size());
  for (std::uint32_t i = 0; i < input.size(); ++i) {
    const Segment& s = input[i];
    const bool is_usable = std::abs(s.a.x) <= kGridExtent_m && std::abs(s.a.y) <= kGridExtent_m &&
                           std::abs(s.b.x) <= kGridExtent_m && std::abs(s.b.y) <= kGridExtent_m;
    expects(is_usable, "segments to node are finite and within the grid's extent");
    const GridSegment g{{to_grid(s.a.x), to_grid(s.a.y)}, {to_grid(s.b.x), to_grid(s.b.y)}, i};
    if (g.a != g.b) segments.push_back(g);
  }
  if (segments.empty()) return {};
  // Halperin and Packer bound the number of passes; three are common, so reaching the guard is a
  // fault of ours.
  constexpr int kMaxPasses = 100;
  int passes = 0;
  while (bend_through_hot_cells(segments))
    expects(++passes < kMaxPasses, "iterated snap rounding converges");
  return build_graph(segments);
}

bool is_noded(const Polygon& polygon) {
  std::vector<Segment> edges;
  for_each_edge(polygon, [&](const Segment& s) { edges.push_back(s); });
  const PlanarGraph graph = node_segments(edges);
  return graph.edges.size() == edges.size() && graph.overlaps.empty();
}

}  // namespace plat
