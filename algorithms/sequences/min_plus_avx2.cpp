#include "sequences/min_plus_tiles_internal.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace plat::sequences {
namespace {

struct Lanes32 {
  using Value = std::int32_t;
  using Register = __m256i;
  static constexpr std::size_t kCount = 8;
  static Register load(const Value* from) {
    return _mm256_loadu_si256(reinterpret_cast<const Register*>(from));
  }
  static void store(Value* to, Register values) {
    _mm256_storeu_si256(reinterpret_cast<Register*>(to), values);
  }
  static Register broadcast(const Value* from) { return _mm256_set1_epi32(*from); }
  static Register add(Register a, Register b) { return _mm256_add_epi32(a, b); }
  static Register min(Register a, Register b) { return _mm256_min_epi32(a, b); }
};

struct Lanes64 {
  using Value = std::int64_t;
  using Register = __m256i;
  static constexpr std::size_t kCount = 4;
  static Register load(const Value* from) {
    return _mm256_loadu_si256(reinterpret_cast<const Register*>(from));
  }
  static void store(Value* to, Register values) {
    _mm256_storeu_si256(reinterpret_cast<Register*>(to), values);
  }
  static Register broadcast(const Value* from) { return _mm256_set1_epi64x(*from); }
  static Register add(Register a, Register b) { return _mm256_add_epi64(a, b); }
  static Register min(Register a, Register b) {
    return _mm256_blendv_epi8(a, b, _mm256_cmpgt_epi64(a, b));
  }
};

}  // namespace

const MinPlusKernels<std::int32_t> kAvx2Kernels32[2] = {kernels_of<Lanes32, 2>(),
                                                        kernels_of<Lanes32, 1>()};
const MinPlusKernels<std::int64_t> kAvx2Kernels64[2] = {kernels_of<Lanes64, 2>(),
                                                        kernels_of<Lanes64, 1>()};

}  // namespace plat::sequences
#endif
