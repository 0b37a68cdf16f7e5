#include "sequences/structure_decomposition.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/failure.h"

namespace plat::sequences {
namespace {

using KeyPointIndex = std::uint32_t;

std::optional<KeyPointIndex> start_of(const Structure& structure, const DirectedSegment& directed) {
  const Segment& segment = structure.segments[directed.segment];
  return directed.is_forward ? segment.from : segment.to;
}

std::optional<KeyPointIndex> end_of(const Structure& structure, const DirectedSegment& directed) {
  return start_of(structure, {directed.segment, !directed.is_forward});
}

/// Segments in a row, and how long they are.
struct Trail {
  std::vector<DirectedSegment> segments;
  std::int64_t primary_minimum = 0;

  [[nodiscard]] bool is_longer_than(const Trail& other) const {
    return std::pair(primary_minimum, segments.size()) >
           std::pair(other.primary_minimum, other.segments.size());
  }
};

/// Finds the longest trails among segments that lie on no path yet, by trying all: there are few,
/// as a key point has three segments at most and cycles are few. Where a trail meets a path or
/// itself, it took the third segment, and ends.
class TrailSearch {
 public:
  explicit TrailSearch(const Structure& structure)
      : structure_(structure),
        leaving_(structure.key_points.size()),
        is_used_(structure.segments.size(), false) {
    for (std::uint32_t s = 0; s < structure.segments.size(); ++s) {
      for (const bool is_forward : {true, false})
        if (const auto key = start_of(structure, {s, is_forward}))
          leaving_[*key].push_back({s, is_forward});
    }
  }

  /// Puts a trail on a path: its segments are used.
  void take(const Trail& trail) {
    for (const auto& directed : trail.segments) is_used_[directed.segment] = true;
  }
  /// The longest trail that leaves a key point, empty where all of its segments are used.
  Trail longest_from(KeyPointIndex key) { return search(key, std::nullopt); }
  /// The longest trail back to the key point, empty where it lies on no cycle.
  Trail longest_cycle_at(KeyPointIndex key) { return search(key, key); }
  /// The longest trail between two ends of the structure.
  Trail longest_between_ends() {
    Trail best;
    for (KeyPointIndex key = 0; key < leaving_.size(); ++key) {
      if (leaving_[key].size() != 1) continue;
      if (Trail trail = longest_from(key); trail.is_longer_than(best)) best = std::move(trail);
    }
    for (std::uint32_t s = 0; s < structure_.segments.size(); ++s) {
      for (const bool is_forward : {true, false}) {
        if (start_of(structure_, {s, is_forward})) continue;
        best_ = {};
        target_.reset();
        follow({s, is_forward});
        if (best_.is_longer_than(best)) best = std::move(best_);
      }
    }
    return best;
  }

 private:
  Trail search(KeyPointIndex key, std::optional<KeyPointIndex> target) {
    best_ = {};
    target_ = target;
    extend(key);
    return std::move(best_);
  }
  void extend(KeyPointIndex key) {
    for (const auto& directed : leaving_[key])
      if (!is_used_[directed.segment]) follow(directed);
  }
  void follow(const DirectedSegment& directed) {
    const std::int64_t length = minimum_of(directed.segment);
    current_.segments.push_back(directed);
    current_.primary_minimum += length;
    is_used_[directed.segment] = true;
    const auto end = end_of(structure_, directed);
    if ((!target_ || end == target_) && current_.is_longer_than(best_)) best_ = current_;
    if (end) extend(*end);
    is_used_[directed.segment] = false;
    current_.primary_minimum -= length;
    current_.segments.pop_back();
  }
  [[nodiscard]] std::int64_t minimum_of(std::uint32_t segment) const {
    const auto& bounds = structure_.segments[segment].bounds;
    return bounds.empty() ? 0 : bounds.front().min;
  }

  const Structure& structure_;
  std::vector<std::vector<DirectedSegment>> leaving_;  // by key point
  std::vector<bool> is_used_;
  Trail current_;
  Trail best_;
  std::optional<KeyPointIndex> target_;
};

/// Extracts children until no segment is left: those of the primary path first, then theirs.
std::vector<StructurePath> with_primary(const Structure& structure, const Trail& primary) {
  TrailSearch search(structure);
  search.take(primary);
  std::vector<StructurePath> paths{
      {primary.segments, start_of(structure, primary.segments.front()), std::nullopt}};
  for (std::uint32_t parent = 0; parent < paths.size(); ++parent) {
    std::vector<KeyPointIndex> keys;
    if (paths[parent].start) keys.push_back(*paths[parent].start);
    for (const auto& directed : paths[parent].segments)
      if (const auto end = end_of(structure, directed)) keys.push_back(*end);
    for (const KeyPointIndex key : keys) {
      for (Trail child = search.longest_from(key); !child.segments.empty();
           child = search.longest_from(key)) {
        search.take(child);
        paths.push_back({std::move(child.segments), key, parent});
      }
    }
  }
  return paths;
}

std::size_t cycle_count(const Structure& structure) {
  std::size_t corners = structure.key_points.size();
  for (const Segment& segment : structure.segments)
    corners += (segment.from ? 0U : 1U) + (segment.to ? 0U : 1U);
  return structure.segments.size() + 1 - std::min(corners, structure.segments.size() + 1);
}

/// The longest cycle, split at each of its key points in turn: that which copies least.
std::vector<StructurePath> with_best_split(const Structure& structure) {
  Trail cycle;
  for (KeyPointIndex key = 0; key < structure.key_points.size(); ++key) {
    Trail at_key = TrailSearch(structure).longest_cycle_at(key);
    if (at_key.is_longer_than(cycle)) cycle = std::move(at_key);
  }
  std::vector<StructurePath> best;
  double fewest_copies = 0.0;
  for (std::size_t split = 0; split < cycle.segments.size(); ++split) {
    auto paths = with_primary(structure, cycle);
    const double copies = copy_count(structure, visit_order(structure, paths));
    if (best.empty() || copies < fewest_copies) {
      best = std::move(paths);
      fewest_copies = copies;
    }
    std::ranges::rotate(cycle.segments, cycle.segments.begin() + 1);
  }
  return best;
}

void append_visits(const Structure& structure, const std::vector<StructurePath>& paths,
                   std::uint32_t path, std::vector<Visit>& visits) {
  const auto append_children = [&](std::optional<KeyPointIndex> key) {
    for (std::uint32_t child = path + 1; key && child < paths.size(); ++child)
      if (paths[child].parent == path && paths[child].start == key)
        append_visits(structure, paths, child, visits);
  };
  append_children(paths[path].start);
  for (const auto& directed : paths[path].segments) {
    const auto end = end_of(structure, directed);
    visits.push_back({directed, start_of(structure, directed), end, false, {}});
    if (end != paths[path].start) append_children(end);
  }
}

}  // namespace

std::vector<StructurePath> decompose(const Structure& structure) {
  const std::size_t cycles = cycle_count(structure);
  if (cycles > kMostCycles)
    throw InputError("structure: " + std::to_string(cycles) + " independent cycles, allowed 0.." +
                     std::to_string(kMostCycles));
  if (cycles > 0) return with_best_split(structure);
  return with_primary(structure, TrailSearch(structure).longest_between_ends());
}

std::vector<Visit> visit_order(const Structure& structure,
                               const std::vector<StructurePath>& paths) {
  std::vector<Visit> visits;
  append_visits(structure, paths, 0, visits);
  const auto is_met_after = [&](std::size_t visit, KeyPointIndex key) {
    return std::any_of(visits.begin() + static_cast<std::ptrdiff_t>(visit) + 1, visits.end(),
                       [key](const Visit& v) { return v.start == key || v.end == key; });
  };
  std::vector<KeyPointIndex> placed;
  const auto place = [&placed](std::optional<KeyPointIndex> key) {
    if (!key || std::ranges::binary_search(placed, *key)) return false;
    placed.insert(std::ranges::lower_bound(placed, *key), *key);
    return true;
  };
  for (std::size_t i = 0; i < visits.size(); ++i) {
    place(visits[i].start);
    for (const KeyPointIndex key : placed)
      if (key == visits[i].end || is_met_after(i, key)) visits[i].remembered.push_back(key);
    visits[i].is_end_placed = visits[i].end && !place(visits[i].end);
  }
  return visits;
}

double copy_count(const Structure& structure, const std::vector<Visit>& visits) {
  double copies = 0.0;
  for (const Visit& visit : visits) {
    double contexts = 1.0;
    for (const KeyPointIndex key : visit.remembered)
      contexts *= static_cast<double>(structure.key_points[key].allowed.size());
    copies += contexts;
  }
  return copies;
}

}  // namespace plat::sequences
