#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "blocks/block.h"
#include "core/options.h"
#include "core/polygon.h"

namespace plat::fuzz {

/// Reads numbers from the fuzzer's bytes; zeros when they are used up.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool is_at_end() const { return at_ >= bytes_.size(); }

  template <class T>
  T take() {
    T value{};
    const std::size_t room = at_ < bytes_.size() ? bytes_.size() - at_ : 0;
    const std::size_t count = room < sizeof(T) ? room : sizeof(T);
    if (count > 0) std::memcpy(&value, bytes_.data() + at_, count);
    at_ += sizeof(T);
    return value;
  }
  std::uint8_t byte() { return take<std::uint8_t>(); }
  /// In [0, 1], 16 bits: both ends are reached.
  double share() { return static_cast<double>(take<std::uint16_t>()) / 65535.0; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// How the bytes of a coordinate are read. Most inputs should be near the edge of being valid.
enum class Coordinates : std::uint8_t {
  kCoarse,    ///< one byte, steps of 1 m: collinear, repeated and touching points are common
  kGridStep,  ///< two bytes, steps of the working grid, 64 m wide: nearly closed spikes and slivers
  kMetres,    ///< two bytes, steps of 1/256 m, 256 m wide: city blocks
  kFar,       ///< as kMetres, but 1800 km from the origin
  kRaw,       ///< eight bytes, any double: NaN, infinities, denormals
};
inline constexpr int kCoordinateModes = 5;

inline double coordinate(ByteReader& in, Coordinates mode) {
  switch (mode) {
    case Coordinates::kCoarse:
      return static_cast<double>(static_cast<std::int8_t>(in.byte()));
    case Coordinates::kGridStep:
      return static_cast<double>(in.take<std::int16_t>()) / 1024.0;
    case Coordinates::kMetres:
      return static_cast<double>(in.take<std::int16_t>()) / 256.0;
    case Coordinates::kFar:
      return 1.8e6 + static_cast<double>(in.take<std::int16_t>()) / 256.0;
    case Coordinates::kRaw:
      return std::bit_cast<double>(in.take<std::uint64_t>());
  }
  return 0.0;
}

inline Ring take_ring(ByteReader& in, Coordinates mode) {
  Ring ring;
  const int count = in.byte();
  for (int i = 0; i < count && !in.is_at_end(); ++i) {
    const double x = coordinate(in, mode);
    const double y = coordinate(in, mode);
    ring.push_back({x, y});
  }
  return ring;
}

/// A polygon with up to three holes, whatever the bytes say: nothing is repaired here.
inline Polygon take_polygon(ByteReader& in) {
  const std::uint8_t head = in.byte();
  const auto mode = static_cast<Coordinates>(head % kCoordinateModes);
  const int holes = (head / kCoordinateModes) % 4;
  Polygon polygon{take_ring(in, mode), {}};
  for (int i = 0; i < holes; ++i) polygon.holes.push_back(take_ring(in, mode));
  return polygon;
}

/// Streets on some edges: a logical street or none, and a width, per edge.
inline void label_from_bytes(blocks::Block& block, ByteReader& in) {
  const bool has_labels = !in.is_at_end();
  for (auto& ring : block.edges) {
    for (blocks::BlockEdge& edge : ring) {
      edge = {};
      if (!has_labels) continue;
      const std::uint8_t label = in.byte();
      if (label % 4 == 0) continue;
      edge.logical_street = label / 32;
      edge.street_width_m = 0.5 * (label % 64);
      edge.width_source = blocks::WidthSource::kAssumed;
    }
  }
}

/// Options anywhere within their ranges; a third of them keeps its default, a third is near the
/// lower end, where the work is.
inline OptionMap take_options(const std::vector<FieldDescription>& fields, ByteReader& in) {
  OptionMap out;
  for (const FieldDescription& field : fields) {
    const std::uint8_t how = in.byte();
    if (how % 3 == 0) continue;
    if (field.type == "choice") {
      out.emplace(field.name, field.choices[how % field.choices.size()]);
      continue;
    }
    const double share = in.share();
    const double value = how % 3 == 1 ? field.min + share * (field.max - field.min)
                                      : field.min + share * std::min(field.max - field.min, 100.0);
    out.emplace(field.name, field.type == "integer" ? std::floor(value) : value);
  }
  return out;
}

}  // namespace plat::fuzz
