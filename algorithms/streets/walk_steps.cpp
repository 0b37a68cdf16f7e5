#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "streets/growth_cells.h"
#include "streets/walk_steps_internal.h"

namespace plat::streets::detail {
namespace {

using Options = RandomWalkGrower::Options;

/// The probability that a street goes on from its first point in no direction that is seen, because
/// it ends there: the paper gives none. A tenth: far below a street that goes straight on, far
/// above one that turns by three deviations.
constexpr double kEndProbability = 0.1;
/// Steps so much less probable than the best take nothing from its certainty.
constexpr double kNegligibleShare = 0.01;
/// Cells in which slots are looked up are no smaller, metres.
constexpr double kSmallestCell_m = 1.0;

/// About as large as a step, but no smaller than what a slot has to itself.
double cell_size_m(const WalkSlots& slots, std::span<const std::uint32_t> members, const Box& box) {
  std::vector<double> distances;
  for (const std::uint32_t i : members) distances.push_back(slots[i].style.distance_mean_m);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const double share_m2 = box.width() * box.height() / static_cast<double>(members.size());
  return std::max({*middle, std::sqrt(share_m2), kSmallestCell_m});
}

Box common(const Box& a, const Box& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

}  // namespace

WalkSteps::WalkSteps(const GrowthPlane& plane, const WalkSlots& slots, const Options& options)
    : plane_(plane),
      slots_(slots),
      options_(options),
      model_{options.distance, options.angle, options.min_distance_deviation_m,
             options.min_angle_deviation_rad},
      targets_(slots.size()) {}

Point WalkSteps::way(std::uint32_t from, std::uint32_t to) const {
  return slots_[to].place - slots_[from].place;
}

void WalkSteps::look_around(std::span<const std::uint32_t> members) {
  for (const std::uint32_t i : members_) targets_[i] = {};
  members_.assign(members.begin(), members.end());
  if (members.empty()) return;
  Box box;
  for (const std::uint32_t i : members_) box.add(slots_[i].place);
  GrowthCells cells(cell_size_m(slots_, members, box));
  for (const std::uint32_t i : members_) cells.add({slots_[i].place, slots_[i].place}, i);

  std::vector<std::uint32_t> near;
  for (const std::uint32_t i : members_) {
    near.clear();
    const DistanceRange range = likely_distances(slots_[i].style, options_.threshold, model_);
    const Point place = slots_[i].place;
    const Point reach{range.max_m, range.max_m};
    const Box near_by = common(Box{place - reach, place + reach}, box);
    cells.for_each_in(near_by, [&](std::uint32_t k) {
      const double d = length(way(i, k));
      if (slots_[k].vertex != slots_[i].vertex && range.min_m <= d && d <= range.max_m)
        near.push_back(k);
      return true;
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    find_targets(i, near);
  }

  find_twins();
}

/// Each target knows the way back, where the other end sees it at all.
void WalkSteps::find_twins() {
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> numbers(slots_.size());
  for (const std::uint32_t i : members_) {
    for (std::uint32_t t = 0; t < targets_[i].size(); ++t)
      numbers[i].emplace_back(targets_[i][t].slot, t);
    std::sort(numbers[i].begin(), numbers[i].end());
  }
  for (const std::uint32_t i : members_) {
    for (Target& target : targets_[i]) {
      const auto& back = numbers[target.slot];
      const auto it = std::lower_bound(back.begin(), back.end(), std::pair(i, 0U));
      if (it != back.end() && it->first == i) target.twin = it->second;
    }
  }
}

void WalkSteps::find_targets(std::uint32_t base, const std::vector<std::uint32_t>& near) {
  for (const std::uint32_t k : near) {
    Target target{.slot = k};
    if (!is_possible(base, target)) continue;
    const double clearance = clearance_m(slots_[base], slots_[k], options_);
    if (plane_.passes_over(slots_[base].vertex, slots_[k].vertex, clearance)) continue;
    target.by_distance = transition_probability(
        slots_[base].style, {.distance_m = length(way(base, k)), .turn_rad = {}}, model_);
    targets_[base].push_back(target);
  }
  std::stable_sort(targets_[base].begin(), targets_[base].end(),
                   [](const Target& a, const Target& b) { return a.by_distance > b.by_distance; });
}

/// Whether nothing but its probability is against the step.
bool WalkSteps::is_possible(std::uint32_t base, Target& target) {
  if (target.is_barred || !slots_[target.slot].is_free()) return false;
  const std::uint32_t from = slots_[base].vertex;
  const std::uint32_t to = slots_[target.slot].vertex;
  target.is_barred = options_.crossings == RandomWalkGrower::Crossings::kForbidden
                         ? !plane_.admits(from, to)
                         : !plane_.crossings(from, to).has_value();
  return !target.is_barred;
}

/// The first step of a street that passes is judged by how well its best continuation on the other
/// side of the base point fits.
void WalkSteps::look_ahead(std::uint32_t base, Target& target) {
  double best = 0.0;
  target.opposite = kNone;
  for (const Target& other : targets_[base]) {
    if (other.by_distance <= best) break;
    if (other.is_barred || !slots_[other.slot].is_free()) continue;
    if (slots_[other.slot].vertex == slots_[target.slot].vertex) continue;
    const TransitionStep step{length(way(base, other.slot)),
                              turn_between(way(target.slot, base), way(base, other.slot))};
    const double p = transition_probability(slots_[base].style, step, model_);
    if (p > best) {
      best = p;
      target.opposite = other.slot;
    }
  }
  target.view = target.by_distance * std::max(best, kEndProbability);
}

double WalkSteps::view(std::uint32_t base, Target& target) {
  const WalkSlot& slot = slots_[base];
  const bool is_known = target.view_age == slot.connections &&
                        (target.opposite == kNone || slots_[target.opposite].is_free());
  if (is_known) return target.view;
  target.view_age = slot.connections;
  const Point to = way(base, target.slot);
  if (slot.heading) {
    target.opposite = kNone;
    target.view =
        transition_probability(slot.style, {length(to), turn_between(*slot.heading, to)}, model_);
  } else if (options_.first_step == RandomWalkGrower::FirstStep::kLookAhead && slot.capacity > 1) {
    look_ahead(base, target);
  } else {
    target.view = target.by_distance;
  }
  return target.view;
}

double WalkSteps::probability(std::uint32_t base, Target& target) {
  const double forth = view(base, target);
  if (forth < options_.threshold) return 0.0;
  if (options_.view == RandomWalkGrower::View::kBase) return forth;
  if (target.twin == kNone) return 0.0;
  const double back = view(target.slot, targets_[target.slot][target.twin]);
  return back < options_.threshold ? 0.0 : forth * back;
}

std::vector<WalkSteps::Ranked> WalkSteps::ranked(std::uint32_t base) {
  std::vector<Ranked> out;
  if (!slots_[base].is_free()) return out;
  for (std::uint32_t t = 0; t < targets_[base].size(); ++t) {
    Target& target = targets_[base][t];
    if (target.is_barred || !slots_[target.slot].is_free()) continue;
    const double p = probability(base, target);
    if (p > 0.0) out.push_back({p, t});
  }
  const auto key = [&](const Ranked& r) {
    const std::uint32_t slot = targets_[base][r.target].slot;
    return std::tuple(-r.probability, slots_[slot].vertex, slot);
  };
  std::sort(out.begin(), out.end(),
            [&](const Ranked& a, const Ranked& b) { return key(a) < key(b); });
  return out;
}

std::optional<WalkStep> WalkSteps::likeliest(std::uint32_t slot) {
  for (const Ranked& r : ranked(slot)) {
    Target& target = targets_[slot][r.target];
    if (is_possible(slot, target)) return WalkStep{slot, target.slot, r.probability};
  }
  return std::nullopt;
}

std::optional<WalkStep> WalkSteps::sampled(std::uint32_t slot, Rng& rng) {
  std::vector<Ranked> steps = ranked(slot);
  std::erase_if(steps,
                [&](const Ranked& r) { return !is_possible(slot, targets_[slot][r.target]); });
  if (steps.empty()) return std::nullopt;
  double sum = 0.0;
  for (const Ranked& r : steps) sum += r.probability;
  double left = rng.uniform_01() * sum;
  std::size_t k = 0;
  while (k + 1 < steps.size() && left >= steps[k].probability) left -= steps[k++].probability;
  return WalkStep{slot, targets_[slot][steps[k].target].slot, steps[k].probability};
}

double WalkSteps::share(std::uint32_t base, std::uint32_t to_vertex) {
  double sum = 0.0;
  double wanted = 0.0;
  double best = 0.0;
  std::vector<std::uint32_t> counted;  // vertices: two slots of one are one target
  for (const Ranked& r : ranked(base)) {
    if (r.probability < kNegligibleShare * best) break;
    Target& target = targets_[base][r.target];
    const std::uint32_t vertex = slots_[target.slot].vertex;
    if (std::find(counted.begin(), counted.end(), vertex) != counted.end()) continue;
    if (!is_possible(base, target)) continue;
    counted.push_back(vertex);
    best = std::max(best, r.probability);
    sum += r.probability;
    if (vertex == to_vertex) wanted = r.probability;
  }
  return sum > 0.0 ? wanted / sum : 0.0;
}

std::optional<double> WalkSteps::certainty(std::uint32_t slot) {
  const auto best = likeliest(slot);
  if (!best) return std::nullopt;
  const double forth = share(slot, slots_[best->to].vertex);
  if (options_.view == RandomWalkGrower::View::kBase) return forth;
  return forth * share(best->to, slots_[slot].vertex);
}

}  // namespace plat::streets::detail
