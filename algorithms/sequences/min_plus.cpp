#include "sequences/min_plus.h"

#include <array>
#include <string>

#include "core/failure.h"
#include "sequences/min_plus_tiles_internal.h"

namespace plat::sequences {
namespace {

#if defined(__x86_64__)
constexpr bool kHasVectors = true;
bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
bool has_avx512() { return __builtin_cpu_supports("avx512f") != 0; }
#else
constexpr bool kHasVectors = false;
bool has_avx2() { return false; }
bool has_avx512() { return false; }
#endif

template <class Number>
struct OneLane {
  using Value = Number;
  using Register = Number;
  static constexpr std::size_t kCount = 1;
  static Register load(const Value* from) { return *from; }
  static void store(Value* to, Register value) { *to = value; }
  static Register broadcast(const Value* from) { return *from; }
  static Register add(Register a, Register b) { return a + b; }
  static Register min(Register a, Register b) { return b < a ? b : a; }
};

template <class Value>
constexpr std::array<MinPlusKernels<Value>, 2> kScalarKernels{kernels_of<OneLane<Value>, 2>(),
                                                              kernels_of<OneLane<Value>, 1>()};

template <class Value>
const MinPlusKernels<Value>* kernels(InstructionSet set) {
#if defined(__x86_64__)
  constexpr bool kIsNarrow = sizeof(Value) == sizeof(std::int32_t);
  if (set == InstructionSet::kAvx512) {
    if constexpr (kIsNarrow)
      return kAvx512Kernels32;
    else
      return kAvx512Kernels64;
  }
  if (set == InstructionSet::kAvx2) {
    if constexpr (kIsNarrow)
      return kAvx2Kernels32;
    else
      return kAvx2Kernels64;
  }
#endif
  return kScalarKernels<Value>.data();
}

}  // namespace

bool is_supported(InstructionSet set) {
  if (set == InstructionSet::kAvx512) return kHasVectors && has_avx512();
  if (set == InstructionSet::kAvx2) return kHasVectors && has_avx2();
  return true;
}

InstructionSet resolved(InstructionSet set) {
  if (!is_supported(set))
    throw InputError("instructions = " + std::string(instruction_set_name(set)) +
                     ": this processor lacks them (auto takes the best that it has)");
  if (set != InstructionSet::kAuto) return set;
  if (is_supported(InstructionSet::kAvx512)) return InstructionSet::kAvx512;
  if (is_supported(InstructionSet::kAvx2)) return InstructionSet::kAvx2;
  return InstructionSet::kScalar;
}

std::string_view instruction_set_name(InstructionSet set) {
  switch (set) {
    case InstructionSet::kAuto:
      return "auto";
    case InstructionSet::kScalar:
      return "scalar";
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
  }
  throw LogicError("an instruction set has a name");
}

template <class Value>
const MinPlusKernels<Value>& min_plus_kernels(InstructionSet set, std::size_t layers) {
  // Half a register of AVX-512 is a register of AVX2.
  if (set == InstructionSet::kAvx512 && layers < kernels<Value>(set)[1].width)
    set = InstructionSet::kAvx2;
  const MinPlusKernels<Value>* both = kernels<Value>(set);
  return both[0].width <= layers ? both[0] : both[1];
}

template const MinPlusKernels<std::int32_t>& min_plus_kernels(InstructionSet, std::size_t);
template const MinPlusKernels<std::int64_t>& min_plus_kernels(InstructionSet, std::size_t);

}  // namespace plat::sequences
