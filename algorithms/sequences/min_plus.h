#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace plat::sequences {

/// Costs that no path has: large, and two of them may still be added.
template <class Value>
inline constexpr Value kInfinite = std::numeric_limits<Value>::max() / 2;

/// What the kernels may use of the processor. The results are the same, bit for bit.
enum class InstructionSet { kAuto, kScalar, kAvx2, kAvx512 };

/// Whether this processor has it. kAuto and kScalar always are.
bool is_supported(InstructionSet set);
/// The best that this processor has, for kAuto; else `set`.
/// @throws InputError where the processor lacks it
InstructionSet resolved(InstructionSet set);
std::string_view instruction_set_name(InstructionSet set);

/// How many tails `product` treats together; the layout of its `panels`.
inline constexpr std::size_t kPanelTails = 4;

/// Matrix products in the (min, +) algebra, where kInfinite stands for what is not there. Sums of
/// a finite cost and a finite value must stay below kInfinite.
template <class Value>
struct MinPlusKernels {
  /// Neighbouring layers that one call of `product` or `gather` computes.
  std::size_t width = 0;
  /// out[tail * stride + l] = min(itself, min over heads of cost(tail, head) + sources[head][l])
  /// for l in 0 .. width - 1. `panels`: by panel of kPanelTails tails, by head, by tail in it;
  /// tails beyond the last are there and ignored.
  void (*product)(const Value* panels, const Value* const* sources, std::size_t heads, Value* out,
                  std::size_t stride, std::size_t tails) = nullptr;
  /// out[l] = min(itself, min over arcs of costs[arc] + sources[source_of[arc]][l]): one tail with
  /// few arcs.
  void (*gather)(const Value* costs, const std::uint32_t* source_of, const Value* const* sources,
                 std::size_t arcs, Value* out) = nullptr;
  /// out[tail] = min(itself, min over k of columns[heads[k] * stride + tail] + addends[k]): one
  /// layer. `stride` is a multiple of kRowMultiple.
  void (*row)(const Value* columns, std::size_t stride, const std::uint32_t* heads,
              const Value* addends, std::size_t count, Value* out) = nullptr;
};
inline constexpr std::size_t kRowMultiple = 16;
/// No kernel is wider.
inline constexpr std::size_t kMaxWidth = 32;

/// The kernels of a resolved instruction set: the widest of at most `layers`, or the narrowest.
template <class Value>
const MinPlusKernels<Value>& min_plus_kernels(InstructionSet set, std::size_t layers);

}  // namespace plat::sequences
