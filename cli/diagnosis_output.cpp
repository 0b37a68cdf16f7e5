#include "diagnosis_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/options.h"
#include "sequence_output.h"

namespace plat::cli {

using nlohmann::ordered_json;
using sequences::BoundPlace;
using sequences::CompiledProblem;
using sequences::Diagnosis;
using sequences::NearestAmounts;
using sequences::place_name;
using sequences::Relaxation;
using sequences::SequenceProblem;

namespace {

std::string argument_name(const SequenceProblem& problem, const BoundPlace& place) {
  const std::string& resource = problem.database.resources[place.resource].name;
  return place.segment ? segment_name(problem, *place.segment) + ":" + resource : resource;
}

std::string failure_text(std::string_view what, const Failure& failure) {
  return fmt::format("{}: {}: {}", what, failure_name(failure.code), failure.message);
}

ordered_json failure_json(const Failure& failure) {
  return {{"failure", {{"code", failure_name(failure.code)}, {"message", failure.message}}}};
}

std::string cuts_text(const SequenceProblem& problem, const Diagnosis& diagnosis) {
  std::vector<std::string> sets;
  for (const auto& cut : diagnosis.cuts) {
    std::vector<std::string> names;
    for (const BoundPlace& place : cut) names.push_back(place_name(problem, place));
    sets.push_back(fmt::format("{}", fmt::join(names, " with ")));
  }
  return fmt::format("   without these bounds there are sequences{}: {}",
                     diagnosis.has_all_cuts ? "" : " (one set of many)", fmt::join(sets, "; or "));
}

std::string nearest_text(const SequenceProblem& problem, const NearestAmounts& nearest) {
  const double step = problem.database.resources[nearest.bound.place.resource].step;
  std::vector<std::string> amounts;
  if (nearest.below) amounts.push_back(in_unit(*nearest.below, step));
  if (nearest.above) amounts.push_back(in_unit(*nearest.above, step));
  if (amounts.empty()) amounts.emplace_back("none");
  return fmt::format("   {} {}: nearest attainable with all other bounds kept: {}",
                     place_name(problem, nearest.bound.place), bounds_text(problem, nearest.bound),
                     fmt::join(amounts, " and "));
}

ordered_json place_json(const SequenceProblem& problem, const BoundPlace& place) {
  ordered_json out{{"resource", problem.database.resources[place.resource].name}};
  if (place.segment) out["segment"] = segment_name(problem, *place.segment);
  return out;
}

}  // namespace

std::vector<BoundPlace> places_named(const SequenceProblem& problem,
                                     const CompiledProblem& compiled, const std::string& name) {
  std::vector<BoundPlace> places;
  std::vector<std::string> known;
  for (const auto& bound : bounds_of(compiled)) {
    const std::string full = argument_name(problem, bound.place);
    const std::string& resource = problem.database.resources[bound.place.resource].name;
    if (name == full || name == resource) places.push_back(bound.place);
    known.push_back(full);
  }
  if (!places.empty()) return places;
  throw InputError(
      fmt::format("--relax {}: no bound is called so{} (known: {})", name,
                  did_you_mean(name, std::vector<std::string_view>(known.begin(), known.end())),
                  fmt::join(known, ", ")));
}

std::string diagnosis_text(const SequenceProblem& problem, const Expected<Diagnosis>& diagnosis) {
  if (!diagnosis) return failure_text("   why could not be found out", diagnosis.error());
  if (!diagnosis->gap.empty()) return "   whatever the bounds: " + diagnosis->gap;
  std::string text = cuts_text(problem, *diagnosis);
  for (const NearestAmounts& nearest : diagnosis->nearest)
    if (nearest.below || nearest.above) text += "\n" + nearest_text(problem, nearest);
  return text;
}

ordered_json diagnosis_json(const SequenceProblem& problem, const Expected<Diagnosis>& diagnosis) {
  if (!diagnosis) return failure_json(diagnosis.error());
  if (!diagnosis->gap.empty()) return {{"gap", diagnosis->gap}};
  ordered_json out{{"cuts", ordered_json::array()}, {"has_all_cuts", diagnosis->has_all_cuts}};
  for (const auto& cut : diagnosis->cuts) {
    ordered_json set = ordered_json::array();
    for (const BoundPlace& place : cut) set.push_back(place_json(problem, place));
    out["cuts"].push_back(set);
  }
  for (const NearestAmounts& nearest : diagnosis->nearest) {
    const double step = problem.database.resources[nearest.bound.place.resource].step;
    ordered_json each = place_json(problem, nearest.bound.place);
    const auto amount = [&](const std::optional<std::int64_t>& steps) {
      return steps ? ordered_json::parse(in_unit(*steps, step)) : ordered_json(nullptr);
    };
    each["below"] = amount(nearest.below);
    each["above"] = amount(nearest.above);
    out["nearest"].push_back(each);
  }
  return out;
}

std::string relaxation_text(const CompiledProblem& compiled, const SequenceProblem& problem,
                            const Expected<std::optional<Relaxation>>& relaxation) {
  if (!relaxation) return failure_text("   no relaxation was found", relaxation.error());
  if (!*relaxation) return "   relaxing these bounds is not enough: give more of them a weight";
  return fmt::format("   relaxed by {:.12g}, the least:\n{}", (*relaxation)->distance,
                     sequence_text(compiled, problem, (*relaxation)->path, 1));
}

ordered_json relaxation_json(const CompiledProblem& compiled, const SequenceProblem& problem,
                             const Expected<std::optional<Relaxation>>& relaxation) {
  if (!relaxation) return failure_json(relaxation.error());
  if (!*relaxation) return nullptr;
  return {{"distance", (*relaxation)->distance},
          {"sequence", sequence_json(compiled, problem, (*relaxation)->path, 1)}};
}

}  // namespace plat::cli
