#pragma once

#include <compare>
#include <cstdint>

namespace plat {

/// An index that cannot be mixed up with another kind of index.
template <class Tag>
struct Id {
  std::uint32_t value = 0;

  friend auto operator<=>(const Id&, const Id&) = default;
};

using StreetId = Id<struct StreetTag>;
using BlockId = Id<struct BlockTag>;
using ParcelId = Id<struct ParcelTag>;

}  // namespace plat
