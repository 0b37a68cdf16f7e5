#include "tiles/settling.h"

#include <cmath>

#include "core/working_grid.h"

namespace plat::tiles {

namespace {

/// Points of which a vertex becomes the mean.
class Means {
 public:
  explicit Means(std::size_t vertices) : sum_(vertices), count_(vertices, 0) {}
  void add(std::uint32_t vertex, Point at) {
    sum_.at(vertex) = sum_.at(vertex) + at;
    ++count_[vertex];
  }
  /// Of vertices that are joints or of the others; those without points stay.
  void apply(TileLayout& layout, bool to_joints) const {
    for (std::size_t v = 0; v < sum_.size(); ++v) {
      if (count_[v] > 0 && layout.vertices[v].is_joint == to_joints)
        layout.vertices[v].at = snap(sum_[v] / static_cast<double>(count_[v]));
    }
  }

 private:
  std::vector<Point> sum_;
  std::vector<std::uint32_t> count_;
};

/// What is between two joints of a ring goes with them: shares of how far each joint went from
/// where the tile has it, by the way along the ring.
void add_between_joints(const TileLayout& layout, const Tile& tile, const std::vector<Corner>& ring,
                        Means& means) {
  const auto is_joint = [&](std::size_t i) { return layout.vertices[ring[i].vertex].is_joint; };
  const auto gone = [&](std::size_t i) {
    return layout.vertices[ring[i].vertex].at - tile.placement(ring[i].rest);
  };
  const std::size_t n = ring.size();
  std::size_t first = 0;
  while (first < n && !is_joint(first)) ++first;
  if (first == n) {
    for (const Corner& corner : ring) means.add(corner.vertex, tile.placement(corner.rest));
    return;
  }
  for (std::size_t done = 0; done < n;) {
    const std::size_t from = (first + done) % n;
    std::vector<double> way{0.0};
    do {
      const std::size_t i = (first + done) % n;
      ++done;
      way.push_back(way.back() + distance(ring[i].rest, ring[(i + 1) % n].rest));
    } while (!is_joint((first + done) % n));
    const Point start = gone(from);
    const Point end = gone((first + done) % n);
    for (std::size_t k = 1; k + 1 < way.size(); ++k) {
      const Corner& corner = ring[(from + k) % n];
      const double share = way.back() > 0.0 ? way[k] / way.back() : 0.5;
      means.add(corner.vertex, tile.placement(corner.rest) + lerp(start, end, share));
    }
  }
}

}  // namespace

TileLayout settled(TileLayout layout) {
  Means joints(layout.vertices.size());
  for (const Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) joints.add(corner.vertex, tile.placement(corner.rest));
    }
  }
  joints.apply(layout, true);
  Means others(layout.vertices.size());
  for (const Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) add_between_joints(layout, tile, ring, others);
  }
  others.apply(layout, false);
  return layout;
}

std::vector<double> closing_residuals_m(const TileLayout& layout) {
  std::vector<double> out;
  out.reserve(layout.tiles.size());
  for (const Tile& tile : layout.tiles) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) {
        sum += squared_length(layout.vertices.at(corner.vertex).at - tile.placement(corner.rest));
        ++count;
      }
    }
    out.push_back(count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count)));
  }
  return out;
}

}  // namespace plat::tiles
