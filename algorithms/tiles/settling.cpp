#include "tiles/settling.h"

#include <cmath>

#include "core/working_grid.h"

namespace plat::tiles {

TileLayout settled(TileLayout layout) {
  std::vector<Point> sum(layout.vertices.size());
  std::vector<std::uint32_t> count(layout.vertices.size(), 0);
  for (const Tile& tile : layout.tiles) {
    for (const auto& ring : tile.rings) {
      for (const Corner& corner : ring) {
        Point& total = sum.at(corner.vertex);
        total = total + tile.placement(corner.rest);
        ++count[corner.vertex];
      }
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (count[v] > 0) layout.vertices[v].at = snap(sum[v] / static_cast<double>(count[v]));
  }
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
