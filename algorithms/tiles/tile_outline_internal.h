#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "similarity/labelled_shape.h"
#include "tiles/tile_layout.h"

namespace plat::tiles::detail {

/// Where an edge of a tile begins: tile, ring, corner.
struct EdgePlace {
  std::uint32_t tile = 0;
  std::uint32_t ring = 0;
  std::uint32_t corner = 0;
};

/// Directed edges of tiles by their vertices.
using EdgeMap = std::map<std::pair<std::uint32_t, std::uint32_t>, EdgePlace>;

EdgeMap edges_of(const TileLayout& layout, std::span<const std::uint32_t> tiles);
/// Of all tiles of a block.
EdgeMap edges_of_block(const TileLayout& layout, std::uint32_t block);

/// One vertex of the outline of a tile or a union of tiles: the edge that begins there.
struct OutlineEdge {
  std::uint32_t vertex = 0;
  EdgePlace place;
};

/// The outline of the union of tiles, edges that two of them have in common cancelled:
/// counter-clockwise, beginning with its lowest vertex. nullopt where the union is not one region
/// with one ring that visits no vertex twice, holes of single tiles aside.
std::optional<std::vector<OutlineEdge>> outline_of(const TileLayout& layout,
                                                   std::span<const std::uint32_t> tiles);

/// The outline as a shape, where it is now, edges labelled by whether a tile lies beyond.
similarity::LabelledShape shape_of(const TileLayout& layout, std::span<const OutlineEdge> outline,
                                   const EdgeMap& edges_of_block);

/// Sets of tiles that are joined by common edges, each ascending, ordered by their lowest.
std::vector<std::vector<std::uint32_t>> connected_tiles(const TileLayout& layout);

/// Lengths along a closed ring.
class ArcLength {
 public:
  explicit ArcLength(Ring ring);
  [[nodiscard]] const Ring& ring() const { return ring_; }
  [[nodiscard]] double total_m() const { return at_.back(); }
  /// Of a vertex, metres from the first.
  [[nodiscard]] double at(std::size_t vertex) const { return at_[vertex]; }
  /// The place of the nearest point of the ring, metres in [0, total).
  [[nodiscard]] double nearest(Point p) const;
  /// The edge on which a place lies, and how far along it in [0, 1].
  struct Place {
    std::size_t edge = 0;
    double along_01 = 0.0;
  };
  [[nodiscard]] Place place(double s) const;
  [[nodiscard]] Point point(double s) const;
  /// Into [0, total).
  [[nodiscard]] double wrapped(double s) const;

 private:
  Ring ring_;
  std::vector<double> at_;  ///< n + 1
};

/// Whether a corner lies on the straight line between its neighbours at rest.
bool is_straight_at_rest(const std::vector<Corner>& ring, std::size_t corner);

}  // namespace plat::tiles::detail
