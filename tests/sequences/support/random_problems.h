#pragma once

#include "core/rng.h"
#include "sequences/sequence_problem.h"

namespace plat::testing {

/// How large random problems are at most.
struct ProblemSize {
  std::uint32_t elements = 6;
  std::uint32_t resources = 4;
  sequences::Amount amount = 12;  ///< of a resource, over the whole
  sequences::Amount use = 4;      ///< of a resource, by one element
};

/// A plain sequence over a random database: equalities, intervals, only minima, only maxima and
/// open resources; elements that consume nothing; transitions with uses of their own; parallel
/// transitions; few different costs, most of them zero; targets that a walk reached and targets
/// that nothing may reach. Compiles: no circle is free.
sequences::SequenceProblem random_plain_problem(Rng& rng, const ProblemSize& size = {});

/// A search graph made by hand of several zones: tables that zones share, links that skip zones,
/// parallel links and entries, terminals anywhere, dimensions that go on or start again at some
/// zones or at all. Valid.
sequences::SearchGraph random_search_graph(Rng& rng);

}  // namespace plat::testing
