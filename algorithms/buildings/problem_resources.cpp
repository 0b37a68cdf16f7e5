#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "buildings/problem_resources_internal.h"
#include "core/failure.h"
#include "core/rng.h"

namespace plat::buildings {

double step_of(const AttributeSteps& steps, const std::string& attribute) {
  if (attribute == detail::kLength) return kLengthQuantum_m;
  if (const auto at = steps.find(attribute); at != steps.end()) return at->second;
  return attribute.ends_with("_m") ? kLengthQuantum_m : kFloorAreaQuantum_m2;
}

}  // namespace plat::buildings

namespace plat::buildings::detail {

using sequences::Amount;
using sequences::Bounds;

namespace {

/// What rounding of the division leaves of a whole number: far above it, far below a quantum.
constexpr double kWholeNumberTolerance = 1e-6;

}  // namespace

Amount amount_of(double value, double step) {
  return static_cast<Amount>(std::llround(value / step));
}

std::size_t Resources::index_of(const std::string& attribute) {
  const auto at = std::ranges::find(resources_, attribute, &sequences::Resource::name);
  if (at != resources_.end()) return static_cast<std::size_t>(at - resources_.begin());
  const bool is_known = std::ranges::any_of(
      database_.parts(), [&](const Part& part) { return part.attributes.contains(attribute); });
  if (!is_known && attribute != kLength) {
    throw InputError(fmt::format("no part of \"{}\" has the attribute \"{}\"; there are: {}",
                                 database_.info().name, attribute, known_attributes()));
  }
  resources_.push_back({attribute, step_of(steps_, attribute)});
  return resources_.size() - 1;
}

void Resources::add_all(const std::vector<AttributeBound>& bounds) {
  for (const AttributeBound& bound : bounds) index_of(bound.attribute);
}

std::vector<Bounds> Resources::bounds_of(const std::vector<AttributeBound>& bounds) {
  std::vector<Bounds> out(resources_.size());
  for (const AttributeBound& bound : bounds) {
    const std::size_t at = index_of(bound.attribute);
    const double step = resources_[at].step;
    const Amount min = static_cast<Amount>(std::ceil(bound.min / step - kWholeNumberTolerance));
    const Amount max =
        bound.max ? static_cast<Amount>(std::floor(*bound.max / step + kWholeNumberTolerance))
                  : sequences::kUnbounded;
    if (min > max || min < 0) {
      throw InputError(fmt::format("{}: {} to {} holds no multiple of {} from 0 on",
                                   bound.attribute, bound.min, bound.max.value_or(bound.min),
                                   step));
    }
    out[at] = {std::max(out[at].min, min), std::min(out[at].max, max)};
    if (out[at].min > out[at].max)
      throw InputError(fmt::format("{}: its bounds contradict each other", bound.attribute));
  }
  return out;
}

std::vector<Amount> Resources::uses_of(const Part& part) const {
  std::vector<Amount> uses;
  for (const auto& [name, step] : resources_) {
    const double value = name == kLength
                             ? part.shape.left_m + part.shape.right_m + part.shape.stem_m
                             : attribute(part, name);
    uses.push_back(amount_of(value, step));
  }
  return uses;
}

std::string Resources::known_attributes() const {
  std::set<std::string> names;
  for (const Part& part : database_.parts()) {
    for (const auto& [name, value] : part.attributes) names.insert(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

sequences::Cost ExtraCost::between(const std::string& from, const std::string& to) const {
  double extra = preferences_.part_m2;
  if (preferences_.variety_m2 > 0.0) {
    Rng rng(derive_seed(preferences_.seed, {seed_key(from), seed_key(to)}));
    extra += rng.uniform(0.0, preferences_.variety_m2);
  }
  return std::llround(extra / kCostStep_m2);
}

}  // namespace plat::buildings::detail
