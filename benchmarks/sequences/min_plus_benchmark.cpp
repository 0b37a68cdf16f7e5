// How near the min-plus kernel of `layered` comes to what the processor can do, and what a whole
// search takes. One relaxation is one addition and one minimum of one value.
#include <benchmark/benchmark.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <vector>

#include "rcksp_scaling/street_database.h"
#include "sequences/compiled_problem.h"
#include "sequences/layered_search.h"
#include "sequences/min_plus.h"

namespace plat::sequences {
namespace {

/// The size of the thesis's study [Har, Fig. 6.12].
constexpr std::size_t kElements = 74;
constexpr std::uint64_t kSeed = 6;

SearchGraph street(std::int64_t length_m) {
  rcksp::CellOptions options;
  options.length_m = static_cast<double>(length_m);
  return compile(rcksp::street_problem(rcksp::street_database(options, kSeed), options)).graph;
}

/// The first argument is the instruction set; true where this processor has it.
bool select(benchmark::State& state, InstructionSet& set) {
  set = static_cast<InstructionSet>(state.range(0));
  state.SetLabel(std::string(instruction_set_name(set)));
  if (is_supported(set)) return true;
  state.SkipWithError("the processor lacks these instructions");
  return false;
}

// ---- the bounds: the same additions and minima without the kernel's loops and stores ----

/// Independent minima, enough of them to hide their latency.
constexpr std::size_t kChains = 6;
/// Less than half of the first-level cache.
constexpr std::size_t kLoadedValues = 2048;
constexpr std::uint64_t kRounds = 4096;

#if defined(__x86_64__)
template <bool kLoads>
__attribute__((target("avx2"))) std::uint64_t relax_avx2(const std::int32_t* loaded,
                                                         std::int32_t* out) {
  __m256i least[kChains];
  __m256i sum = _mm256_set1_epi32(*out);
  __m256i bases[kChains];
  for (std::size_t c = 0; c < kChains; ++c) {
    least[c] = sum;
    bases[c] = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(loaded + c * 8));
  }
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    asm volatile("" : "+x"(sum));  // as if it changed: nothing is computed once for all rounds
    for (std::size_t c = 0; c < kChains; ++c) {
      const auto* from =
          reinterpret_cast<const __m256i*>(loaded + ((round * 64) % kLoadedValues) + c * 8);
      const __m256i value = kLoads ? _mm256_loadu_si256(from) : bases[c];
      least[c] = _mm256_min_epi32(least[c], _mm256_add_epi32(sum, value));
    }
  }
  for (const auto& chain : least) sum = _mm256_add_epi32(sum, chain);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), sum);
  return kRounds * kChains * 8;
}

template <bool kLoads>
__attribute__((target("avx512f"))) std::uint64_t relax_avx512(const std::int32_t* loaded,
                                                              std::int32_t* out) {
  __m512i least[kChains];
  __m512i sum = _mm512_set1_epi32(*out);
  __m512i bases[kChains];
  for (std::size_t c = 0; c < kChains; ++c) {
    least[c] = sum;
    bases[c] = _mm512_loadu_si512(loaded + c * 16);
  }
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    asm volatile("" : "+v"(sum));
    for (std::size_t c = 0; c < kChains; ++c) {
      const __m512i value =
          kLoads ? _mm512_loadu_si512(loaded + ((round * 128) % kLoadedValues) + c * 16) : bases[c];
      const __m512i other = _mm512_add_epi32(sum, value);
      least[c] = _mm512_mask_min_epi32(least[c], 0xFFFF, least[c], other);
    }
  }
  for (const auto& chain : least) sum = _mm512_add_epi32(sum, chain);
  _mm512_storeu_si512(out, sum);
  return kRounds * kChains * 16;
}
#endif

/// Additions and minima: of registers alone, or each with a load.
template <bool kLoads>
std::uint64_t relax(InstructionSet set, const std::int32_t* loaded, std::int32_t* out) {
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx512) return relax_avx512<kLoads>(loaded, out);
  if (set == InstructionSet::kAvx2) return relax_avx2<kLoads>(loaded, out);
#endif
  return 0;
}

template <bool kLoads>
void bound(benchmark::State& state) {
  InstructionSet set{};
  if (!select(state, set)) return;
  std::vector<std::int32_t> loaded(kLoadedValues + 128, 5);
  std::vector<std::int32_t> out(16, 0);
  std::uint64_t relaxed = 0;
  for (auto _ : state) {
    relaxed += relax<kLoads>(set, loaded.data(), out.data());
    benchmark::ClobberMemory();
  }
  state.counters["relaxations"] =
      benchmark::Counter(static_cast<double>(relaxed), benchmark::Counter::kIsRate);
}

/// What is never exceeded: additions and minima of registers.
void arithmetic_bound(benchmark::State& state) { bound<false>(state); }
/// With one register loaded from the first-level cache for each: a kernel without tiles.
void load_bound(benchmark::State& state) { bound<true>(state); }

/// The kernel alone, on blocks in the first-level cache.
void product(benchmark::State& state) {
  InstructionSet set{};
  if (!select(state, set)) return;
  const auto& kernels = min_plus_kernels<std::int32_t>(set, kMaxWidth);
  constexpr std::size_t kPanels = (kElements + kPanelTails - 1) / kPanelTails;
  const std::vector<std::int32_t> panels(kPanels * kPanelTails * kElements, 7);
  std::vector<std::int32_t> values(kElements * kMaxWidth, 1000);
  std::vector<const std::int32_t*> sources;
  for (std::size_t e = 0; e < kElements; ++e) sources.push_back(values.data() + e * kMaxWidth);
  std::vector<std::int32_t> out(kElements * kMaxWidth, kInfinite<std::int32_t>);
  for (auto _ : state) {
    kernels.product(panels.data(), sources.data(), kElements, out.data(), kMaxWidth, kElements);
    benchmark::ClobberMemory();
  }
  state.counters["relaxations"] =
      benchmark::Counter(static_cast<double>(kElements * kElements * kernels.width),
                         benchmark::Counter::kIsIterationInvariantRate);
}

/// A whole search: tables, costs-to-go, and the first k paths. Arguments: set, metres of street, k.
void layered_street(benchmark::State& state) {
  InstructionSet set{};
  if (!select(state, set)) return;
  const SearchGraph graph = street(state.range(1));
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    const auto stream = LayeredSearch({.instructions = set}).search(graph);
    SequencePath path;
    for (std::int64_t k = 0; k < state.range(2); ++k)
      benchmark::DoNotOptimize((*stream)->next(path));
    bytes = std::max(bytes, (*stream)->statistics().bytes_held);
  }
  state.counters["bytes"] = static_cast<double>(bytes);
  state.counters["relaxations"] = benchmark::Counter(
      static_cast<double>(
          (*LayeredSearch({.instructions = set}).search(graph))->statistics().states_created) *
          (kElements - 1),
      benchmark::Counter::kIsIterationInvariantRate);
}

constexpr auto kScalar = static_cast<std::int64_t>(InstructionSet::kScalar);
constexpr auto kAvx2 = static_cast<std::int64_t>(InstructionSet::kAvx2);
constexpr auto kAvx512 = static_cast<std::int64_t>(InstructionSet::kAvx512);

BENCHMARK(arithmetic_bound)->Arg(kAvx2)->Arg(kAvx512);
BENCHMARK(load_bound)->Arg(kAvx2)->Arg(kAvx512);
BENCHMARK(product)->Arg(kScalar)->Arg(kAvx2)->Arg(kAvx512);
BENCHMARK(layered_street)
    ->ArgsProduct({{kScalar, kAvx2, kAvx512}, {100, 500, 2000}, {1}})
    ->Args({kAvx2, 2000, 10})
    ->Args({kAvx2, 2000, 1000})
    ->Args({kAvx512, 2000, 1000})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(layered_street)->Args({kAvx2, 2000, 1000000})->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace plat::sequences
