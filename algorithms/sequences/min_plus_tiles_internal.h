#pragma once

#include <cstddef>
#include <cstdint>

#include "sequences/min_plus.h"

// Included once per instruction set, each time with lanes of that file's own: everything here is
// local to its file, so that no code compiled for one processor is linked into another's path.
namespace plat::sequences {
namespace {

/// A tile of kRows tails x kVectors registers stays in registers over all heads: a source loaded
/// once serves kRows tails, a cost broadcast once serves kVectors registers.
template <class Lanes, std::size_t kRows, std::size_t kVectors>
inline void relax_tile(const typename Lanes::Value* panel,
                       const typename Lanes::Value* const* sources, std::size_t heads,
                       typename Lanes::Value* out, std::size_t stride) {
  using Register = typename Lanes::Register;
  Register least[kRows][kVectors];
  for (std::size_t r = 0; r < kRows; ++r)
    for (std::size_t v = 0; v < kVectors; ++v)
      least[r][v] = Lanes::load(out + r * stride + v * Lanes::kCount);
  for (std::size_t head = 0; head < heads; ++head) {
    const typename Lanes::Value* source = sources[head];
    Register values[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) values[v] = Lanes::load(source + v * Lanes::kCount);
    for (std::size_t r = 0; r < kRows; ++r) {
      const Register cost = Lanes::broadcast(panel + head * kPanelTails + r);
      for (std::size_t v = 0; v < kVectors; ++v)
        least[r][v] = Lanes::min(least[r][v], Lanes::add(cost, values[v]));
    }
  }
  for (std::size_t r = 0; r < kRows; ++r)
    for (std::size_t v = 0; v < kVectors; ++v)
      Lanes::store(out + r * stride + v * Lanes::kCount, least[r][v]);
}

template <class Lanes, std::size_t kVectors>
void product(const typename Lanes::Value* panels, const typename Lanes::Value* const* sources,
             std::size_t heads, typename Lanes::Value* out, std::size_t stride, std::size_t tails) {
  std::size_t tail = 0;
  for (; tail + kPanelTails <= tails; tail += kPanelTails)
    relax_tile<Lanes, kPanelTails, kVectors>(panels + tail * heads, sources, heads,
                                             out + tail * stride, stride);
  const auto* panel = panels + tail * heads;
  if (tails - tail == 3)
    relax_tile<Lanes, 3, kVectors>(panel, sources, heads, out + tail * stride, stride);
  if (tails - tail == 2)
    relax_tile<Lanes, 2, kVectors>(panel, sources, heads, out + tail * stride, stride);
  if (tails - tail == 1)
    relax_tile<Lanes, 1, kVectors>(panel, sources, heads, out + tail * stride, stride);
}

template <class Lanes, std::size_t kVectors>
void gather(const typename Lanes::Value* costs, const std::uint32_t* source_of,
            const typename Lanes::Value* const* sources, std::size_t arcs,
            typename Lanes::Value* out) {
  using Register = typename Lanes::Register;
  Register least[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) least[v] = Lanes::load(out + v * Lanes::kCount);
  for (std::size_t arc = 0; arc < arcs; ++arc) {
    const typename Lanes::Value* source = sources[source_of[arc]];
    const Register cost = Lanes::broadcast(costs + arc);
    for (std::size_t v = 0; v < kVectors; ++v)
      least[v] = Lanes::min(least[v], Lanes::add(cost, Lanes::load(source + v * Lanes::kCount)));
  }
  for (std::size_t v = 0; v < kVectors; ++v) Lanes::store(out + v * Lanes::kCount, least[v]);
}

template <class Lanes, std::size_t kVectors>
inline void relax_row(const typename Lanes::Value* columns, std::size_t stride,
                      const std::uint32_t* heads, const typename Lanes::Value* addends,
                      std::size_t count, typename Lanes::Value* out) {
  using Register = typename Lanes::Register;
  Register least[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) least[v] = Lanes::load(out + v * Lanes::kCount);
  for (std::size_t k = 0; k < count; ++k) {
    const typename Lanes::Value* column = columns + heads[k] * stride;
    const Register addend = Lanes::broadcast(addends + k);
    for (std::size_t v = 0; v < kVectors; ++v)
      least[v] = Lanes::min(least[v], Lanes::add(addend, Lanes::load(column + v * Lanes::kCount)));
  }
  for (std::size_t v = 0; v < kVectors; ++v) Lanes::store(out + v * Lanes::kCount, least[v]);
}

template <class Lanes>
void row(const typename Lanes::Value* columns, std::size_t stride, const std::uint32_t* heads,
         const typename Lanes::Value* addends, std::size_t count, typename Lanes::Value* out) {
  constexpr std::size_t kWide = 4;
  std::size_t tail = 0;
  for (; tail + kWide * Lanes::kCount <= stride; tail += kWide * Lanes::kCount)
    relax_row<Lanes, kWide>(columns + tail, stride, heads, addends, count, out + tail);
  for (; tail < stride; tail += Lanes::kCount)
    relax_row<Lanes, 1>(columns + tail, stride, heads, addends, count, out + tail);
}

template <class Lanes, std::size_t kVectors>
constexpr MinPlusKernels<typename Lanes::Value> kernels_of() {
  return {kVectors * Lanes::kCount, product<Lanes, kVectors>, gather<Lanes, kVectors>, row<Lanes>};
}

}  // namespace

/// One file each. Wide kernels first.
extern const MinPlusKernels<std::int32_t> kAvx2Kernels32[2];
extern const MinPlusKernels<std::int64_t> kAvx2Kernels64[2];
extern const MinPlusKernels<std::int32_t> kAvx512Kernels32[2];
extern const MinPlusKernels<std::int64_t> kAvx512Kernels64[2];

}  // namespace plat::sequences
