#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>

#include "sequences/min_plus.h"
#include "sequences/sequence_search.h"

namespace plat::sequences {

/// Dynamic programming over layers of consumed vectors: exact costs-to-go in one table, then the
/// paths read off them. Where the table would be too large, the states that the paths need are
/// grown in its place.
///
/// Guarantees: 1. paths come by cost, and those of equal costs lexicographically by their steps;
/// 2. beside the costs-to-go, memory does not grow with the number of paths;
/// 3. the same on every instruction set.
/// @throws        InputError for `instructions` that the processor lacks
/// @returns       Failure kTooManyStates where the costs-to-go need more than `max_memory_mb`
/// Complexity:    O(layers x arcs) for all costs-to-go
/// Deviation:     no strategy of the paper; [Har, Sec. 3.3] grows the graph that is tabulated here
///                (ADR 0018)
class LayeredSearch {
 public:
  static constexpr std::string_view kName = "layered";
  static constexpr std::string_view kSummary =
      "exact dynamic programming over layers of consumed resources, all costs-to-go in one table";
  enum class Layers { kAuto, kDense, kSparse };
  struct Options {
    Layers layers = Layers::kAuto;                        ///< what holds the costs-to-go
    InstructionSet instructions = InstructionSet::kAuto;  ///< the results do not depend on it
    double max_memory_mb = 4096.0;                        ///< of the costs-to-go
    int batch_paths = 262144;                             ///< collected at a time
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, Layers, 3>{
              "layers",
              &Options::layers,
              {{"auto", Layers::kAuto}, {"dense", Layers::kDense}, {"sparse", Layers::kSparse}},
              "dense: a table of all consumed vectors; sparse: states grown as far as the paths "
              "asked for need them; auto: sparse where the table is too large or slow"},
          EnumField<Options, InstructionSet, 4>{
              "instructions",
              &Options::instructions,
              {{"auto", InstructionSet::kAuto},
               {"scalar", InstructionSet::kScalar},
               {"avx2", InstructionSet::kAvx2},
               {"avx512", InstructionSet::kAvx512}},
              "vector instructions of the kernels; auto takes the best that the processor has"},
          Field{"max_memory_mb", &Options::max_memory_mb, 0.001, 1e6,
                "memory limit of the costs-to-go, MB"},
          Field{"batch_paths", &Options::batch_paths, 1, 1 << 24,
                "how many of the k best paths are collected at a time; bounds the memory"},
      };
    }
  };

  explicit LayeredSearch(const Options& options) : options_(options) {}
  [[nodiscard]] Expected<std::unique_ptr<SequenceStream>> search(const SearchGraph& graph) const;
  [[nodiscard]] const Options& options() const { return options_; }

 private:
  Options options_;
};
static_assert(SequenceSearch<LayeredSearch> && Registrable<LayeredSearch>);

}  // namespace plat::sequences
