#include "streets/network_recovery.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "streets/network_graph.h"
#include "streets/segment_index.h"

namespace plat::streets {
namespace {

std::optional<double> share(double part, double whole) {
  if (!(whole > 0.0)) return std::nullopt;
  return part / whole;
}

/// One part per pair of ends, sorted by them, lower end first.
std::vector<JudgedPart> pairs_of(const LevelledNetwork& levelled, std::span<const Point> places) {
  expects(levelled.levels.size() == levelled.network.streets.size(), "every street has a level");
  const NetworkGraph graph = network_graph(levelled.network, places);
  std::vector<JudgedPart> pairs;
  for (const NetworkGraph::Edge& edge : graph.edges) {
    int level = levelled.levels[edge.streets.front()];
    for (const std::uint32_t street : edge.streets)
      level = std::min(level, levelled.levels[street]);
    pairs.push_back({{graph.nodes[edge.from], graph.nodes[edge.to]}, level, 1.0, 0.0});
  }
  const auto key = [](const JudgedPart& p) { return std::tuple(p.chord.a, p.chord.b, p.level); };
  std::sort(pairs.begin(), pairs.end(),
            [&](const JudgedPart& p, const JudgedPart& q) { return key(p) < key(q); });
  pairs.erase(
      std::unique(pairs.begin(), pairs.end(),
                  [](const JudgedPart& p, const JudgedPart& q) { return p.chord == q.chord; }),
      pairs.end());
  return pairs;
}

/// The pieces of the straight segments of a network, ready to be looked up.
SegmentIndex segments_of(const StreetNetwork& network) {
  std::vector<Segment> segments;
  for (const Street& street : network.streets) {
    for (std::size_t i = 1; i < street.line.size(); ++i)
      segments.push_back({street.line[i - 1], street.line[i]});
  }
  return SegmentIndex(std::move(segments));
}

/// What rounding may take off the cosine of two directions.
constexpr double kCosineRounding = 1e-12;

using Interval = std::pair<double, double>;  // metres along a segment; empty where second <= first

/// Where the points origin + s direction, 0 <= s <= length, lie within `radius` of `center`.
Interval within_disc(Point origin, Point direction, double length, Point center, double radius) {
  const Point to = center - origin;
  const double middle = dot(to, direction);
  const double across = cross(direction, to);
  const double half_squared = radius * radius - across * across;
  if (!(half_squared > 0.0)) return {0.0, 0.0};
  const double half = std::sqrt(half_squared);
  return {std::max(0.0, middle - half), std::min(length, middle + half)};
}

/// Narrows the interval to where low <= at + s slope <= high.
void narrow(Interval& interval, double at, double slope, double low, double high) {
  if (slope == 0.0) {
    if (at < low || at > high) interval = {0.0, 0.0};
    return;
  }
  const double s0 = (low - at) / slope;
  const double s1 = (high - at) / slope;
  interval.first = std::max(interval.first, std::min(s0, s1));
  interval.second = std::min(interval.second, std::max(s0, s1));
}

/// Where they lie beside `other`, no farther than `radius` from its line.
Interval within_strip(Point origin, Point direction, double length, const Segment& other,
                      double radius) {
  const double size = plat::length(other);
  const Point along = (other.b - other.a) / size;
  const Point to = origin - other.a;
  Interval interval{0.0, length};
  narrow(interval, dot(to, along), dot(direction, along), 0.0, size);
  narrow(interval, cross(along, to), cross(along, direction), -radius, radius);
  return interval;
}

double covered_m(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end());
  double covered = 0.0;
  double reached = 0.0;
  for (const auto& [begin, end] : intervals) {
    covered += std::max(0.0, end - std::max(reached, begin));
    reached = std::max(reached, end);
  }
  return covered;
}

class Buffer {
 public:
  Buffer(const StreetNetwork& network, const LengthRecoveryOptions& options)
      : index_(segments_of(network)),
        radius_m_(options.buffer_m),
        least_cosine_(std::cos(options.max_turn_rad) - kCosineRounding) {}

  /// Metres of the segment that lie in it.
  [[nodiscard]] double matched_m(const Segment& segment) const {
    const double size = length(segment);
    if (!(size > 0.0)) return 0.0;
    const Point direction = (segment.b - segment.a) / size;
    std::vector<Interval> intervals;
    const auto add = [&](Interval interval) {
      if (interval.second > interval.first) intervals.push_back(interval);
    };
    Box box;
    box.add(segment.a);
    box.add(segment.b);
    index_.for_each_near(box.expanded(radius_m_), [&](std::uint32_t i) {
      const Segment& other = index_.segments()[i];
      const Point along = normalized(other.b - other.a);
      if (along == Point{} || !(std::abs(dot(direction, along)) >= least_cosine_)) return;
      add(within_disc(segment.a, direction, size, other.a, radius_m_));
      add(within_disc(segment.a, direction, size, other.b, radius_m_));
      add(within_strip(segment.a, direction, size, other, radius_m_));
    });
    return std::min(size, covered_m(intervals));
  }

 private:
  SegmentIndex index_;
  double radius_m_;
  double least_cosine_;
};

std::vector<JudgedPart> streets_in(const LevelledNetwork& levelled, const Buffer& buffer) {
  expects(levelled.levels.size() == levelled.network.streets.size(), "every street has a level");
  std::vector<JudgedPart> out;
  for (std::size_t s = 0; s < levelled.network.streets.size(); ++s) {
    const Polyline& line = levelled.network.streets[s].line;
    JudgedPart part{{line.front(), line.back()}, levelled.levels[s], length_m(line), 0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
      part.matched += buffer.matched_m({line[i - 1], line[i]});
    part.matched = std::min(part.matched, part.amount);
    out.push_back(part);
  }
  return out;
}

}  // namespace

std::optional<double> RecoveryShares::recall_01() const { return share(recovered, known); }
std::optional<double> RecoveryShares::precision_01() const { return share(right, grown); }
std::optional<double> RecoveryShares::f1_01() const {
  const std::optional<double> r = recall_01();
  const std::optional<double> p = precision_01();
  if (!r || !p) return std::nullopt;
  return *r + *p > 0.0 ? 2.0 * *r * *p / (*r + *p) : 0.0;
}

RecoveryShares& RecoveryShares::operator+=(const RecoveryShares& other) {
  known += other.known;
  recovered += other.recovered;
  grown += other.grown;
  right += other.right;
  return *this;
}

RecoveryShares shares_of(const Recovery& recovery) {
  RecoveryShares sums;
  for (const auto& [level, shares] : shares_by_level(recovery)) sums += shares;
  return sums;
}

std::map<int, RecoveryShares> shares_by_level(const Recovery& recovery) {
  std::map<int, RecoveryShares> out;
  for (const JudgedPart& part : recovery.known)
    out[part.level] += {part.amount, part.matched, 0.0, 0.0};
  for (const JudgedPart& part : recovery.grown)
    out[part.level] += {0.0, 0.0, part.amount, part.matched};
  return out;
}

std::vector<int> levels_of(const Growth& growth, int existing_level) {
  expects(growth.segments.size() <= growth.network.streets.size(), "grown streets are the last");
  std::vector<int> levels(growth.network.streets.size() - growth.segments.size(), existing_level);
  for (const GrownSegment& segment : growth.segments) levels.push_back(segment.hierarchy);
  return levels;
}

Recovery recover_edges(const LevelledNetwork& known, const LevelledNetwork& grown,
                       std::span<const Point> places) {
  Recovery out{pairs_of(known, places), pairs_of(grown, places)};
  const auto ends = [](const JudgedPart& p) { return std::pair(p.chord.a, p.chord.b); };
  std::size_t g = 0;
  for (JudgedPart& part : out.known) {
    while (g < out.grown.size() && ends(out.grown[g]) < ends(part)) ++g;
    if (g == out.grown.size() || ends(part) < ends(out.grown[g])) continue;
    part.matched = part.amount;
    out.grown[g].matched = out.grown[g].amount;
  }
  return out;
}

Recovery recover_length(const LevelledNetwork& known, const LevelledNetwork& grown,
                        const LengthRecoveryOptions& options) {
  const Buffer of_known(known.network, options);
  const Buffer of_grown(grown.network, options);
  return {streets_in(known, of_grown), streets_in(grown, of_known)};
}

}  // namespace plat::streets
