#pragma once

#include "core/parallel.h"
#include "geodata/layer.h"
#include "harness/synthesis_script.h"
#include "synthesis/layout.h"

namespace plat::harness {

/// What a script comes to before anything is grown.
struct ScriptedSite {
  synthesis::LayoutSite site;
  geodata::LocalFrame frame;  ///< the city's; without one that of the first example
};

/// Reads the script's sources and does its operations, in their order: the points of each are added
/// to those that are there, which stay where points come too near.
///
/// Guarantees: 1. the same script and seed give the same site;  2. without a city the site has no
/// existing street;  3. in a city, points keep a clearance from its streets.
/// @throws InputError with the path in the script
ScriptedSite scripted_site(const SynthesisScript& script, std::uint64_t seed, Jobs jobs);

}  // namespace plat::harness
