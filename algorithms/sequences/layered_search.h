#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <tuple>

#include "sequences/min_plus.h"
#include "sequences/sequence_search.h"

namespace plat::sequences {

/// Dynamic programming over layers of consumed vectors: exact costs-to-go of all states, then the
/// paths read off them.
///
/// Guarantees: 1. paths come by cost, and those of equal costs lexicographically by their steps;
/// 2. the memory for k paths does not grow with k;
/// 3. the same on every instruction set.
/// @throws        InputError for `instructions` that the processor lacks
/// @returns       Failure kTooManyStates where the table needs more than `max_memory_mb`
/// Complexity:    O(layers x arcs) for all costs-to-go
/// Deviation:     no strategy of the paper; [Har, Sec. 3.3] grows the graph that is tabulated here
///                (ADR 0018)
class LayeredSearch {
 public:
  static constexpr std::string_view kName = "layered";
  static constexpr std::string_view kSummary =
      "exact dynamic programming over layers of consumed resources, all costs-to-go in one table";
  struct Options {
    InstructionSet instructions = InstructionSet::kAuto;  ///< the results do not depend on it
    double max_memory_mb = 4096.0;                        ///< of the table of costs-to-go
    int batch_paths = 262144;                             ///< collected at a time
    static constexpr auto fields() {
      return std::tuple{
          EnumField<Options, InstructionSet, 4>{
              "instructions",
              &Options::instructions,
              {{"auto", InstructionSet::kAuto},
               {"scalar", InstructionSet::kScalar},
               {"avx2", InstructionSet::kAvx2},
               {"avx512", InstructionSet::kAvx512}},
              "vector instructions of the kernels; auto takes the best that the processor has"},
          Field{"max_memory_mb", &Options::max_memory_mb, 0.001, 1e6,
                "memory limit of the table of costs-to-go, MB"},
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
