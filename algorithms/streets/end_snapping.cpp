#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/working_grid.h"
#include "streets/end_snapping_internal.h"
#include "streets/segment_index.h"

namespace plat::streets::detail {
namespace {

struct WayEnd {
  Point place;
  std::uint32_t way = 0;
  bool is_last = false;
};

class EndSnapper {
 public:
  EndSnapper(std::span<const RawStreet> raw, double snap_m, const std::vector<Way>& ways)
      : raw_(raw), snap_m_(snap_m), ways_(ways), index_(segments_of(ways)) {
    for (std::uint32_t w = 0; w < ways.size(); ++w) {
      first_segment_.push_back(static_cast<std::uint32_t>(way_of_.size()));
      way_of_.insert(way_of_.end(), ways[w].line.size() - 1, w);
    }
  }

  struct Target {
    Point place;
    std::uint32_t way = 0;
    double distance_m = 0.0;
  };

  /// Where the loose end belongs; nullopt where nothing is near, or it touches something already.
  [[nodiscard]] std::optional<Target> find_target(const WayEnd& end) const {
    const auto [skip_from, skip_to] = own_segments_near(end);
    std::optional<Target> vertex;
    std::optional<Target> foot;
    bool is_attached = false;
    index_.for_each_near(Box{end.place, end.place}.expanded(snap_m_), [&](std::uint32_t i) {
      if (i >= skip_from && i < skip_to) return;
      const Segment& s = index_.segments()[i];
      const std::uint32_t way = way_of_[i];
      const bool meets_middle = may_meet_middle(end.way, way);
      if (meets_middle && distance(s, end.place) <= kGridStep_m) is_attached = true;
      for (const Point p : {s.a, s.b}) {
        const bool is_way_end = p == ways_[way].line.front() || p == ways_[way].line.back();
        if (!meets_middle && !is_way_end) continue;
        if (p == end.place) is_attached = true;
        consider(vertex, {p, way, distance(p, end.place)});
      }
      if (meets_middle) {
        const Point p = snap(nearest_point(s, end.place));
        consider(foot, {p, way, distance(p, end.place)});
      }
    });
    if (is_attached) return std::nullopt;
    return vertex ? vertex : foot;
  }

 private:
  static std::vector<Segment> segments_of(const std::vector<Way>& ways) {
    std::vector<Segment> segments;
    for (const Way& way : ways) {
      for (std::size_t i = 1; i < way.line.size(); ++i)
        segments.push_back({way.line[i - 1], way.line[i]});
    }
    return segments;
  }

  [[nodiscard]] int level(std::uint32_t way) const { return raw_[ways_[way].raw].attributes.level; }

  [[nodiscard]] bool may_meet_middle(std::uint32_t of_end, std::uint32_t other) const {
    return level(other) == 0 || level(other) == level(of_end);
  }

  /// The way's own segments by its end, up to three snapping distances along: an end does not snap
  /// to the way that leads to it.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> own_segments_near(const WayEnd& end) const {
    const Polyline& line = ways_[end.way].line;
    const std::size_t count = line.size() - 1;
    std::size_t skipped = 0;
    double along_m = 0.0;
    while (skipped < count && (skipped == 0 || along_m < 3.0 * snap_m_)) {
      const std::size_t i = end.is_last ? count - 1 - skipped : skipped;
      along_m += distance(line[i], line[i + 1]);
      ++skipped;
    }
    const auto first = first_segment_[end.way];
    const auto n = static_cast<std::uint32_t>(skipped);
    const auto all = static_cast<std::uint32_t>(count);
    return end.is_last ? std::pair(first + all - n, first + all) : std::pair(first, first + n);
  }

  void consider(std::optional<Target>& best, const Target& candidate) const {
    if (candidate.distance_m > snap_m_) return;
    if (!best || candidate.distance_m < best->distance_m ||
        (candidate.distance_m == best->distance_m && candidate.place < best->place)) {
      best = candidate;
    }
  }

  std::span<const RawStreet> raw_;
  double snap_m_;
  const std::vector<Way>& ways_;
  SegmentIndex index_;
  std::vector<std::uint32_t> first_segment_;
  std::vector<std::uint32_t> way_of_;
};

std::vector<WayEnd> loose_ends(const std::vector<Way>& ways) {
  std::vector<WayEnd> ends;
  for (std::uint32_t w = 0; w < ways.size(); ++w) {
    ends.push_back({ways[w].line.front(), w, false});
    ends.push_back({ways[w].line.back(), w, true});
  }
  std::sort(ends.begin(), ends.end(), [](const WayEnd& e, const WayEnd& f) {
    return std::tuple(e.place.x, e.place.y, e.way, e.is_last) <
           std::tuple(f.place.x, f.place.y, f.way, f.is_last);
  });
  std::vector<WayEnd> loose;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool same_before = i > 0 && ends[i - 1].place == ends[i].place;
    const bool same_after = i + 1 < ends.size() && ends[i + 1].place == ends[i].place;
    if (!same_before && !same_after) loose.push_back(ends[i]);
  }
  return loose;
}

}  // namespace

void snap_loose_ends(std::span<const RawStreet> raw, double snap_m, std::vector<Way>& ways,
                     std::vector<Repair>& repairs) {
  const EndSnapper snapper(raw, snap_m, ways);
  struct Move {
    WayEnd end;
    Point to;
  };
  std::vector<Move> moves;
  // Ends that have moved, and ends that something moved to: the first take others along, the second
  // stay.
  std::map<Point, Point> moved;
  std::map<Point, bool> is_target;
  for (const WayEnd& end : loose_ends(ways)) {
    if (is_target.contains(end.place)) continue;
    auto target = snapper.find_target(end);
    if (!target) continue;
    if (const auto it = moved.find(target->place); it != moved.end()) target->place = it->second;
    is_target[target->place] = true;
    if (target->place == end.place) continue;
    moved[end.place] = target->place;
    moves.push_back({end, target->place});
    repairs.push_back(
        {raw[ways[end.way].raw].source_id, RepairKind::kSnappedEnd, target->place,
         fmt::format("end moved by {:.3f} m onto feature {}", distance(end.place, target->place),
                     raw[ways[target->way].raw].source_id)});
  }
  for (const Move& move : moves) {
    Polyline& line = ways[move.end.way].line;
    (move.end.is_last ? line.back() : line.front()) = move.to;
    line.erase(std::unique(line.begin(), line.end()), line.end());
  }
  std::erase_if(ways, [&](const Way& way) {
    if (way.line.size() >= 2) return false;
    repairs.push_back({raw[way.raw].source_id, RepairKind::kZeroLength,
                       snap(raw[way.raw].line.front()), "no length after its ends were moved"});
    return true;
  });
}

}  // namespace plat::streets::detail
