#include "sequences/structure_check.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "core/failure.h"

namespace plat::sequences {
namespace {

std::string name_of(const KeyPoint& key, std::size_t index) {
  return "key point " + std::to_string(index) + (key.name.empty() ? "" : " (" + key.name + ")");
}

std::string name_of(const Segment& segment, std::size_t index) {
  return "segment " + std::to_string(index) +
         (segment.name.empty() ? "" : " (" + segment.name + ")");
}

void check_key_points(const SequenceProblem& problem) {
  const auto& keys = problem.structure.key_points;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto& allowed = keys[k].allowed;
    if (allowed.empty()) throw InputError(name_of(keys[k], k) + ": no element is allowed");
    if (std::ranges::adjacent_find(allowed, std::ranges::greater_equal{}) != allowed.end())
      throw InputError(name_of(keys[k], k) + ": the allowed elements are not ascending");
    if (allowed.back() >= problem.database.elements.size())
      throw InputError(name_of(keys[k], k) + ": element " + std::to_string(allowed.back()) +
                       " is allowed, of " + std::to_string(problem.database.elements.size()));
  }
}

void check_bounds(const std::vector<Bounds>& bounds, std::size_t resource_count,
                  const std::string& where) {
  if (bounds.size() > resource_count)
    throw InputError(where + ": " + std::to_string(bounds.size()) + " bounds, of " +
                     std::to_string(resource_count) + " resources");
  for (std::size_t r = 0; r < bounds.size(); ++r)
    if (bounds[r].min < 0 || bounds[r].min > bounds[r].max || bounds[r].min == kUnbounded)
      throw InputError(where + ": bounds " + std::to_string(bounds[r].min) + ".." +
                       std::to_string(bounds[r].max) + " on resource " + std::to_string(r) +
                       ", allowed 0 <= min <= max");
}

/// The groups of key points that segments connect.
class ConnectedKeyPoints {
 public:
  explicit ConnectedKeyPoints(std::size_t count) : group_(count) {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
  }
  std::size_t group(std::size_t key) {
    while (group_[key] != key) key = group_[key] = group_[group_[key]];
    return key;
  }
  void join(std::size_t a, std::size_t b) { group_[group(a)] = group(b); }

 private:
  std::vector<std::size_t> group_;
};

void check_segments(const SequenceProblem& problem) {
  const auto& [keys, segments] = problem.structure;
  std::vector<std::array<bool, kPortCount>> is_taken(keys.size());
  ConnectedKeyPoints connected(keys.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Segment& segment = segments[s];
    const std::string name = name_of(segment, s);
    check_bounds(segment.bounds, problem.database.resources.size(), name);
    if (!segment.from && !segment.to) throw InputError(name + ": touches no key point");
    const auto take = [&](std::optional<std::uint32_t> key, Port port) {
      if (!key) return;
      if (*key >= keys.size())
        throw InputError(name + ": key point " + std::to_string(*key) + ", of " +
                         std::to_string(keys.size()));
      bool& taken = is_taken[*key][static_cast<std::size_t>(port)];
      if (taken) throw InputError(name_of(keys[*key], *key) + ": two segments at one port");
      taken = true;
    };
    take(segment.from, segment.from_port);
    take(segment.to, segment.to_port);
    if (segment.from && segment.to) connected.join(*segment.from, *segment.to);
  }
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (connected.group(k) != connected.group(0))
      throw InputError(name_of(keys[k], k) + ": not connected with " + name_of(keys[0], 0));
}

}  // namespace

bool is_plain(const Structure& structure) {
  return structure.key_points.empty() && structure.segments.size() == 1 &&
         !structure.segments.front().from && !structure.segments.front().to;
}

void check_structure(const SequenceProblem& problem) {
  if (problem.structure.segments.empty()) throw InputError("structure: no segment");
  check_bounds(problem.bounds, problem.database.resources.size(), "problem");
  check_key_points(problem);
  check_segments(problem);
}

}  // namespace plat::sequences
