#pragma once

#include <vector>

#include "core/rng.h"
#include "core/working_grid.h"
#include "similarity/labelled_shape.h"

namespace plat::testing {

/// A cell of a grid of 10 m, without labels.
inline similarity::LabelledShape cell(int column, int row) {
  const double x = 10.0 * column;
  const double y = 10.0 * row;
  return {{{{x, y}, {x + 10, y}, {x + 10, y + 10}, {x, y + 10}}, {}}, {}, ""};
}

/// Columns x rows tiles of about 20 x 30 m that share their vertices, on the working grid, row by
/// row; streets around them.
inline std::vector<similarity::LabelledShape> made_tiles(Rng& rng, std::size_t columns,
                                                         std::size_t rows) {
  using similarity::EdgeLabel;
  std::vector<Ring> lines(rows + 1);
  for (std::size_t j = 0; j <= rows; ++j) {
    for (std::size_t i = 0; i <= columns; ++i) {
      lines[j].push_back(snap(Point{20.0 * static_cast<double>(i) + rng.uniform(-6, 6),
                                    30.0 * static_cast<double>(j) + rng.uniform(-9, 9)}));
    }
  }
  std::vector<similarity::LabelledShape> tiles;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const auto label = [](bool is_outer) {
        return is_outer ? EdgeLabel::kStreet : EdgeLabel::kProperty;
      };
      tiles.push_back(
          {{{lines[j][i], lines[j][i + 1], lines[j + 1][i + 1], lines[j + 1][i]}, {}},
           {label(j == 0), label(i + 1 == columns), label(j + 1 == rows), label(i == 0)},
           rng.index(2) == 0 ? "residential" : "mixed"});
    }
  }
  return tiles;
}

}  // namespace plat::testing
