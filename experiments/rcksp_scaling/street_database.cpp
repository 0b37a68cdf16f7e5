#include "rcksp_scaling/street_database.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/rng.h"

namespace plat::rcksp {
namespace {

using sequences::Amount;
using sequences::Bounds;
using sequences::Cost;

/// Quanta of length: 5 m and 19 m. No sum of lengths gives the 24 amounts below the shortest, and
/// the mean is 60: of every building 60 + 2 * 24 = 108 levels are out of reach, which is what the
/// thesis's counts lack of 74 nodes a level.
constexpr Amount kShortest = 25;
constexpr Amount kLongest = 95;

constexpr std::array<const char*, kMostResources - 1> kOtherResources{"doors", "balconies",
                                                                      "solar_panels"};
/// By other resource: uses are 0 to below this; doors begin with one.
constexpr std::array<std::uint64_t, kMostResources - 1> kUseCounts{2, 4, 4};

Building building(int index, int count, std::uint64_t seed) {
  constexpr double kStorey_m = 3.0;
  constexpr double kDecimetre_m = 0.1;
  Rng rng(derive_seed(seed, {seed_key("building"), static_cast<std::uint64_t>(index)}));
  Building out;
  out.length = kShortest + static_cast<Amount>(index * (kLongest - kShortest + 1) / count);
  out.height_m = kStorey_m * static_cast<double>(2 + rng.index(5)) +
                 kDecimetre_m * static_cast<double>(rng.index(15));
  out.depth_m = 9.0 + kDecimetre_m * static_cast<double>(rng.index(60));
  for (std::size_t r = 0; r < out.others.size(); ++r)
    out.others[r] = static_cast<Amount>(rng.index(kUseCounts[r])) + (r == 0 ? 1 : 0);
  return out;
}

/// The area that one of two cross sections covers and the other does not: both stand on the ground
/// and begin at the street.
double disagreement_m2(const Building& a, const Building& b) {
  return a.height_m * a.depth_m + b.height_m * b.depth_m -
         2.0 * std::min(a.height_m, b.height_m) * std::min(a.depth_m, b.depth_m);
}

double mean_disagreement_m2(const std::vector<Building>& buildings) {
  double sum_m2 = 0.0;
  for (const Building& a : buildings)
    for (const Building& b : buildings) sum_m2 += disagreement_m2(a, b);
  const auto n = static_cast<double>(buildings.size());
  return sum_m2 / (n * (n - 1.0));
}

void add_transitions(StreetDatabase& street, const CellOptions& options, std::uint64_t seed) {
  const double mean_m2 = mean_disagreement_m2(street.buildings);
  const auto count = static_cast<std::uint32_t>(street.buildings.size());
  for (std::uint32_t from = 0; from < count; ++from) {
    for (std::uint32_t to = 0; to < count; ++to) {
      if (from == to) continue;
      Rng rng(derive_seed(seed, {seed_key("transition"), from, to}));
      const bool exists = rng.uniform_01() < options.density_01;
      const bool is_free = rng.uniform_01() < options.zero_cost_share_01;
      if (!exists) continue;
      const double own_m2 = disagreement_m2(street.buildings[from], street.buildings[to]);
      const double cost_m2 = mean_m2 + options.cost_spread_01 * (own_m2 - mean_m2);
      const auto cost = is_free ? Cost{0} : static_cast<Cost>(std::llround(cost_m2 / kCostStep_m2));
      street.database.transitions.push_back({.from = from, .to = to, .cost = cost});
    }
  }
}

}  // namespace

StreetDatabase street_database(const CellOptions& options, std::uint64_t seed) {
  StreetDatabase street;
  const auto others = static_cast<std::size_t>(options.resources) - 1;
  street.database.cost_step = kCostStep_m2;
  street.database.resources.push_back({"length_m", kLengthStep_m});
  for (std::size_t r = 0; r < others; ++r)
    street.database.resources.push_back({kOtherResources[r], 1.0});
  for (int i = 0; i < options.elements; ++i) {
    const Building made = building(i, options.elements, seed);
    sequences::Element element{.name = fmt::format("building_{:03}", i), .uses = {made.length}};
    for (std::size_t r = 0; r < others; ++r) element.uses.push_back(made.others[r]);
    street.buildings.push_back(made);
    street.database.elements.push_back(std::move(element));
  }
  add_transitions(street, options, seed);
  return street;
}

sequences::SequenceProblem street_problem(const StreetDatabase& street,
                                          const CellOptions& options) {
  const auto quanta = [](double metres) {
    return static_cast<Amount>(std::llround(metres / kLengthStep_m));
  };
  const Amount length = quanta(options.length_m);
  std::vector<Bounds> bounds{{std::max(0, length - quanta(options.length_slack_m)), length}};
  std::vector<double> sums(street.database.resources.size(), 0.0);
  for (const sequences::Element& element : street.database.elements)
    for (std::size_t r = 0; r < sums.size(); ++r) sums[r] += element.uses[r];
  for (std::size_t r = 1; r < sums.size(); ++r) {
    const auto amount = static_cast<Amount>(std::llround(length * sums[r] / sums[0]));
    bounds.push_back({amount, amount});
  }
  return sequences::plain_sequence(street.database, std::move(bounds));
}

}  // namespace plat::rcksp
