#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace plat::sequences {

/// Costs that no path has: large, and two of them may still be added.
template <class Value>
inline constexpr Value kInfinite = std::numeric_limits<Value>::max() / 2;

}  // namespace plat::sequences
