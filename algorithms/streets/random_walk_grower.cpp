#include "streets/random_walk_grower.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "streets/growth_plane.h"
#include "streets/segment_geometry.h"
#include "streets/walk_joints_internal.h"
#include "streets/walk_slots_internal.h"
#include "streets/walk_steps_internal.h"

namespace plat::streets {
namespace {

using detail::WalkSlots;
using detail::WalkStep;
using detail::WalkSteps;
using Options = RandomWalkGrower::Options;

class Walks {
 public:
  Walks(const GrowthSite& site, GrowthPlane& plane, const Options& options, Rng& rng)
      : plane_(plane),
        options_(options),
        rng_(rng),
        slots_(site, plane, options),
        steps_(plane, slots_, options) {}

  /// Every level until nothing is added to it (the paper's REPEAT); then the next. Lower levels
  /// only fill slots and bar ways, so that none has to be walked again.
  void walk() {
    std::map<int, std::vector<std::uint32_t>> levels;
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
      const bool is_matched = options_.levels == RandomWalkGrower::Levels::kMatch;
      levels[is_matched ? slots_[i].style.hierarchy : 0].push_back(i);
    }
    for (auto& [level, members] : levels) {
      steps_.look_around(members);
      std::size_t before = 0;
      do {
        before = edges_.size();
        if (options_.start == RandomWalkGrower::Start::kRandom) {
          walk_one_by_one(members);
        } else {
          walk_together(members);
        }
      } while (edges_.size() > before);
    }
  }

  /// Open ends that no walk came to are joined to what is free near them.
  void join_open_ends() {
    for (const WalkStep& joint : detail::open_end_joints(slots_, options_)) {
      const detail::WalkSlot& from = slots_[joint.from];
      const detail::WalkSlot& to = slots_[joint.to];
      if (!from.is_free() || !to.is_free() || !plane_.admits(from.vertex, to.vertex)) continue;
      const double clearance = detail::clearance_m(from, to, options_);
      if (!plane_.passes_over(from.vertex, to.vertex, clearance)) take(joint);
    }
  }

  std::vector<GrownEdge> finish() {
    number_streets();
    if (options_.curves == RandomWalkGrower::Curves::kTortuous) bend();
    return std::move(edges_);
  }

 private:
  /// Shuffled, but streets that are already under way first. Each walk goes on at both of its ends
  /// until neither finds a step.
  void walk_one_by_one(std::vector<std::uint32_t> starts) {
    for (std::size_t i = starts.size(); i > 1; --i) std::swap(starts[i - 1], starts[rng_.index(i)]);
    std::stable_partition(starts.begin(), starts.end(),
                          [&](std::uint32_t i) { return slots_[i].heading.has_value(); });
    for (const std::uint32_t start : starts) {
      std::array<std::optional<std::uint32_t>, 2> ends{start, start};
      while (ends[0] || ends[1]) {
        for (auto& end : ends) {
          if (end) end = walk_on(*end);
        }
      }
    }
  }

  /// All streets of the level grow at once: the step that is most certain is taken next.
  void walk_together(const std::vector<std::uint32_t>& members) {
    struct Entry {
      double certainty = 0.0;
      std::uint32_t slot = 0;
    };
    const auto is_later = [&](const Entry& a, const Entry& b) {
      return std::tuple(a.certainty, slots_[b.slot].vertex, b.slot) <
             std::tuple(b.certainty, slots_[a.slot].vertex, a.slot);
    };
    std::priority_queue<Entry, std::vector<Entry>, decltype(is_later)> queue(is_later);
    const auto push = [&](std::uint32_t slot) {
      if (const auto certainty = steps_.certainty(slot)) queue.push({*certainty, slot});
    };
    for (const std::uint32_t i : members) push(i);
    while (!queue.empty()) {
      const Entry top = queue.top();
      queue.pop();
      // What was certain when it was put here may no longer be.
      const auto certainty = steps_.certainty(top.slot);
      if (!certainty) continue;
      if (*certainty < top.certainty) {
        queue.push({*certainty, top.slot});
        continue;
      }
      const auto reached = walk_on(top.slot);
      push(top.slot);
      if (reached) push(*reached);
    }
  }

  /// @returns the slot at the end of the step; none where there is no step, or it ended at a street
  std::optional<std::uint32_t> walk_on(std::uint32_t slot) {
    const auto step = options_.selection == RandomWalkGrower::Selection::kSampled
                          ? steps_.sampled(slot, rng_)
                          : steps_.likeliest(slot);
    if (!step) return std::nullopt;
    return take(*step);
  }

  std::optional<std::uint32_t> take(const WalkStep& step) {
    const detail::WalkSlot& from = slots_[step.from];
    const detail::WalkSlot& to = slots_[step.to];
    const std::uint32_t end = add_to_plane(from.vertex, to.vertex);
    GrownEdge edge{.from = from.vertex, .to = end};
    edge.segment.hierarchy = std::max(from.style.hierarchy, 0);
    edge.width_m = mean_width_m(from.style, to.style);
    edges_.push_back(edge);
    steps_taken_.push_back(step);
    const Point way = to.place - from.place;
    if (end != to.vertex) {
      slots_.connect(step.from, std::nullopt, way);
      return std::nullopt;
    }
    slots_.connect(step.from, step.to, way);
    return step.to;
  }

  /// @returns the vertex at which the segment ends
  std::uint32_t add_to_plane(std::uint32_t from, std::uint32_t to) {
    if (options_.crossings != RandomWalkGrower::Crossings::kForbidden) {
      const std::vector<Point> crossings = plane_.crossings(from, to).value();
      if (!crossings.empty() && options_.crossings == RandomWalkGrower::Crossings::kTee)
        return plane_.add_up_to(from, to, crossings);
      if (!crossings.empty()) {
        plane_.add_across(from, to, crossings);
        return to;
      }
    }
    plane_.add(from, to);
    return to;
  }

  static double mean_width_m(const PassingStreet& a, const PassingStreet& b) {
    const auto is_known = [](double width) { return width > 0.0 && std::isfinite(width); };
    if (!is_known(a.width_m)) return b.width_m;
    if (!is_known(b.width_m)) return a.width_m;
    return 0.5 * (a.width_m + b.width_m);
  }

  /// Streets are numbered in the order of their first segments. Where levels are ignored, a street
  /// has the highest order (the lowest number) of its segments.
  void number_streets() {
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<int> levels;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      const std::uint32_t street =
          numbers.try_emplace(slots_.street_of(steps_taken_[e].from), next).first->second;
      edges_[e].segment.street = street;
      if (street == levels.size()) levels.push_back(edges_[e].segment.hierarchy);
      levels[street] = std::min(levels[street], edges_[e].segment.hierarchy);
    }
    for (GrownEdge& edge : edges_) edge.segment.hierarchy = levels[edge.segment.street];
  }

  /// When all segments stand, so that none is refused for the curve of another.
  void bend() {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const double tortuosity = 0.5 * (slots_[steps_taken_[e].from].style.tortuosity +
                                       slots_[steps_taken_[e].to].style.tortuosity);
      edges_[e].line = bend_segment(plane_, edges_[e].from, edges_[e].to, tortuosity, rng_);
    }
  }

  GrowthPlane& plane_;
  const Options& options_;
  Rng& rng_;
  WalkSlots slots_;
  WalkSteps steps_;
  std::vector<GrownEdge> edges_;
  std::vector<WalkStep> steps_taken_;  ///< per edge
};

}  // namespace

Expected<Growth> RandomWalkGrower::grow(const GrowthSite& site, Rng& rng) const {
  auto plane = GrowthPlane::over(site);
  if (!plane) return tl::unexpected(std::move(plane.error()));
  Walks walks(site, *plane, options_, rng);
  walks.walk();
  if (options_.open_ends == OpenEnds::kJoined) walks.join_open_ends();
  return assemble_growth(site, *plane, walks.finish());
}

}  // namespace plat::streets
