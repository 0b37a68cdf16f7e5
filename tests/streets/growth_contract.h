#pragma once

#include <cstdint>
#include <string>

#include "core/rng.h"
#include "streets/street_grower.h"

namespace plat::testing {

/// What of the contract options may switch off.
enum class NewNodes {
  kNone,     ///< grown streets meet at points and existing nodes only
  kAllowed,  ///< and where they cross
};

/// What a growth breaks of the contract of `StreetGrower`, in words, or an empty string. Exact, by
/// whole numbers of grid steps, and without any code that grows.
std::string why_not_grown(const streets::GrowthSite& site, const streets::Growth& growth,
                          NewNodes new_nodes = NewNodes::kNone);

/// Whether two growths are the same bit for bit.
bool are_same(const streets::Growth& a, const streets::Growth& b);

/// The same for a grower: it grows the site twice, once from a copy.
template <streets::StreetGrower Grower>
std::string why_not_in_contract(const Grower& grower, const streets::GrowthSite& site,
                                std::uint64_t seed, NewNodes new_nodes = NewNodes::kNone) {
  Rng first(seed);
  const auto growth = grower.grow(site, first);
  if (!growth) return "is not grown: " + growth.error().message;
  const streets::GrowthSite copy = site;
  Rng second(seed);
  const auto again = grower.grow(copy, second);
  if (!again || !are_same(*growth, *again)) return "the same site and stream give another network";
  return why_not_grown(site, *growth, new_nodes);
}

}  // namespace plat::testing
