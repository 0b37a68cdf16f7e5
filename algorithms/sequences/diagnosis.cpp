#include "sequences/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sequences/quantisation.h"
#include "sequences/stretched_search.h"

namespace plat::sequences {
namespace {

using Stretches = std::vector<std::vector<Stretch>>;
constexpr Stretch kRemoved{0, 0};
/// Weights as whole numbers beyond this could overflow the price of a long path.
constexpr double kMostScaledWeight = 1e9;

Stretches no_stretches(const CompiledProblem& compiled) {
  return Stretches(compiled.graph.zones.size(),
                   std::vector<Stretch>(compiled.graph.dimension_count));
}

/// Sets what the bound at a place may be missed by, wherever it holds.
void stretch(const CompiledProblem& compiled, const BoundPlace& place, const Stretch& by,
             Stretches& stretches) {
  for (std::size_t z = 0; z < stretches.size(); ++z)
    for (std::size_t d = 0; d < stretches[z].size(); ++d)
      if (place_of(compiled, d, z) == place) stretches[z][d] = by;
}

/// Asks the questions of a diagnosis, each a search; remembers the first failure.
class Diagnostician {
 public:
  Diagnostician(const CompiledProblem& compiled, const SequenceProblem& problem,
                const DiagnosisLimits& limits)
      : compiled_(compiled), problem_(problem), limits_(limits), bounds_(bounds_of(compiled)) {}

  Expected<Diagnosis> run() {
    std::vector<std::size_t> all(bounds_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (!has_sequence_without(all) && !failure_) diagnosis_.gap = gap();
    if (diagnosis_.gap.empty() && !failure_) {
      find_cuts();
      find_nearest();
    }
    if (failure_) return tl::unexpected(*failure_);
    return std::move(diagnosis_);
  }

 private:
  std::optional<std::int64_t> least_price(const Stretches& stretches) {
    if (failure_) return std::nullopt;
    const auto found =
        stretched_path(compiled_.graph, stretches, PriceTies::kAny, limits_.max_states);
    if (!found) {
      failure_ = found.error();
      return std::nullopt;
    }
    if (!*found) return std::nullopt;
    return (*found)->price;
  }
  bool has_sequence_without(const std::vector<std::size_t>& removed) {
    Stretches stretches = no_stretches(compiled_);
    for (const std::size_t b : removed) stretch(compiled_, bounds_[b].place, kRemoved, stretches);
    return least_price(stretches).has_value();
  }

  void add_cut(const std::vector<std::size_t>& set) {
    std::vector<BoundPlace> places;
    for (const std::size_t b : set) places.push_back(bounds_[b].place);
    diagnosis_.cuts.push_back(std::move(places));
  }

  /// Tries all sets of 1, 2, ... bounds, until some of one size are found.
  void find_cuts() {
    std::size_t trials = 0;
    for (std::size_t size = 1; size <= bounds_.size(); ++size) {
      std::vector<std::uint8_t> is_in(bounds_.size(), 0);
      std::fill_n(is_in.begin(), size, std::uint8_t{1});
      do {
        if (failure_) return;
        if (++trials > kMostTrials) return find_one_cut();
        std::vector<std::size_t> set;
        for (std::size_t b = 0; b < bounds_.size(); ++b)
          if (is_in[b] != 0) set.push_back(b);
        if (has_sequence_without(set)) add_cut(set);
      } while (std::ranges::prev_permutation(is_in).found);
      if (!diagnosis_.cuts.empty()) return;
    }
  }

  /// Puts the bounds back one after the other where sequences are left.
  void find_one_cut() {
    diagnosis_.has_all_cuts = false;
    diagnosis_.cuts.clear();
    std::vector<std::size_t> set(bounds_.size());
    std::iota(set.begin(), set.end(), std::size_t{0});
    for (std::size_t b = 0; b < bounds_.size(); ++b) {
      std::vector<std::size_t> smaller = set;
      std::erase(smaller, b);
      if (has_sequence_without(smaller)) set = std::move(smaller);
    }
    add_cut(set);
  }

  /// Only a bound that cuts alone has attainable amounts while all others are kept.
  void find_nearest() {
    for (const BoundUse& bound : bounds_) {
      NearestAmounts nearest{bound, std::nullopt, std::nullopt};
      const bool cuts_alone =
          !diagnosis_.has_all_cuts ||
          std::ranges::find(diagnosis_.cuts, std::vector{bound.place}) != diagnosis_.cuts.end();
      if (cuts_alone) {
        Stretches stretches = no_stretches(compiled_);
        stretch(compiled_, bound.place, {1, std::nullopt}, stretches);
        if (const auto price = least_price(stretches)) nearest.below = bound.bounds.min - *price;
        stretch(compiled_, bound.place, {std::nullopt, 1}, stretches);
        if (const auto price = least_price(stretches)) nearest.above = bound.bounds.max + *price;
      }
      diagnosis_.nearest.push_back(nearest);
    }
  }

  /// The nodes that transitions lead to from an entry, whatever is consumed.
  [[nodiscard]] std::vector<bool> reached() const {
    const SearchGraph& graph = compiled_.graph;
    std::vector<bool> is_reached(graph.node_count(), false);
    std::vector<std::uint32_t> open;
    const auto reach = [&](std::uint32_t node) {
      if (!is_reached[node]) open.push_back(node);
      is_reached[node] = true;
    };
    for (const auto& entry : graph.entries) reach(entry.node);
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      const Zone& zone = graph.zones[graph.zone_of(node)];
      if (zone.table) {
        const TransitionTable& table = graph.tables[*zone.table];
        const std::uint32_t local = node - zone.first_node;
        for (std::uint32_t a = table.first[local]; a < table.first[local + 1]; ++a)
          reach(zone.first_node + table.arcs[a].head);
      }
      const auto [first, last] = graph.links_from(node);
      for (std::uint32_t i = first; i < last; ++i) reach(graph.links[i].to);
    }
    return is_reached;
  }

  [[nodiscard]] std::string gap() const {
    const SearchGraph& graph = compiled_.graph;
    if (graph.entries.empty()) return "no element may begin";
    if (graph.exits.empty()) return "no element may end";
    const std::vector<bool> is_reached = reached();
    const auto last = std::find(is_reached.rbegin(), is_reached.rend(), true);
    const auto node = static_cast<std::uint32_t>(is_reached.rend() - last) - 1;
    if (problem_.structure.key_points.empty())
      return "no row of transitions leads from an element that may begin to one that may end";
    const std::string segment =
        segment_name(problem_, compiled_.zone_segments[graph.zone_of(node)]);
    const auto& placement = compiled_.placements[node];
    if (placement && placement->place == Placement::Place::kKeyPoint)
      return fmt::format("no transition leads on from key point \"{}\"",
                         problem_.structure.key_points[placement->index].name);
    return fmt::format("no transitions lead through segment \"{}\"", segment);
  }

  const CompiledProblem& compiled_;
  const SequenceProblem& problem_;
  DiagnosisLimits limits_;
  std::vector<BoundUse> bounds_;
  Diagnosis diagnosis_;
  std::optional<Failure> failure_;
};

double step_of(const SequenceProblem& problem, const BoundPlace& place) {
  return problem.database.resources[place.resource].step;
}

/// The weight of one quantum, by bound.
std::vector<double> weights_per_quantum(const SequenceProblem& problem,
                                        const std::vector<BoundWeight>& weights) {
  std::vector<double> out;
  for (const auto& [place, weight] : weights) {
    if (!(weight > 0.0))
      throw InputError(
          fmt::format("weight of {} = {}, allowed above 0", place_name(problem, place), weight));
    out.push_back(weight * step_of(problem, place));
  }
  return out;
}

void expect_bounds(const CompiledProblem& compiled, const SequenceProblem& problem,
                   const std::vector<BoundWeight>& weights) {
  const auto bounds = bounds_of(compiled);
  for (const auto& weight : weights)
    if (std::ranges::find(bounds, weight.place, &BoundUse::place) == bounds.end())
      throw InputError(fmt::format("{} has no bound to relax", place_name(problem, weight.place)));
}

}  // namespace

Expected<Diagnosis> diagnose(const CompiledProblem& compiled, const SequenceProblem& problem,
                             const DiagnosisLimits& limits) {
  return Diagnostician(compiled, problem, limits).run();
}

Expected<std::optional<Relaxation>> relax(const CompiledProblem& compiled,
                                          const SequenceProblem& problem,
                                          const std::vector<BoundWeight>& weights,
                                          const DiagnosisLimits& limits) {
  expect_bounds(compiled, problem, weights);
  const std::vector<double> per_quantum = weights_per_quantum(problem, weights);
  const auto unit = common_step(per_quantum);
  Stretches stretches = no_stretches(compiled);
  for (std::size_t w = 0; w < weights.size(); ++w) {
    if (!unit || per_quantum[w] / *unit > kMostScaledWeight)
      throw InputError(
          "the weights, each times its resource's step, have no common measure of at most 9 "
          "decimals; give rounder ones");
    const std::int64_t price = std::llround(per_quantum[w] / *unit);
    stretch(compiled, weights[w].place, {price, price}, stretches);
  }
  const auto found =
      stretched_path(compiled.graph, stretches, PriceTies::kByCost, limits.max_states);
  if (!found) return tl::unexpected(found.error());
  if (!*found) return std::nullopt;
  Relaxation relaxation;
  relaxation.distance = static_cast<double>((*found)->price) * unit.value_or(1.0);
  relaxation.path = (*found)->path;
  relaxation.uses = bound_uses(compiled, relaxation.path);
  return relaxation;
}

std::string segment_name(const SequenceProblem& problem, std::size_t segment) {
  const std::string& name = problem.structure.segments[segment].name;
  return name.empty() ? fmt::format("segment {}", segment + 1) : name;
}

std::string place_name(const SequenceProblem& problem, const BoundPlace& place) {
  const std::string& resource = problem.database.resources[place.resource].name;
  if (!place.segment) return resource;
  return fmt::format("{} of {}", resource, segment_name(problem, *place.segment));
}

}  // namespace plat::sequences
