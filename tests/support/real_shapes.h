#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "harness/city.h"
#include "similarity/labelled_shape.h"
#include "support/data_folder.h"

namespace plat::testing {

/// Shapes of an observed city, each n-th so that there are at most `count` of each kind.
struct RealShapes {
  std::vector<similarity::LabelledShape> parcels;  ///< edges unknown
  std::vector<similarity::LabelledShape> blocks;   ///< edges labelled
};

inline similarity::LabelledShape shape_of(const blocks::Block& block) {
  similarity::LabelledShape shape{block.contour, {}, ""};
  for (const blocks::BlockEdge& edge : block.edges.front())
    shape.edges.push_back(edge.is_street() ? similarity::EdgeLabel::kStreet
                                           : similarity::EdgeLabel::kProperty);
  return shape;
}

/// Empty where the data set is not here.
inline RealShapes real_shapes(const std::string& dataset, std::size_t count) {
  RealShapes out;
  if (!data_file(dataset + "/" + dataset + ".gpkg")) return out;
  std::vector<similarity::LabelledShape> parcels;
  std::vector<similarity::LabelledShape> blocks;
  for (const harness::ObservedBlock& observed :
       harness::load_city(geodata::dataset(dataset)).blocks) {
    blocks.push_back(shape_of(observed.block));
    for (const Polygon& parcel : observed.parcels) parcels.push_back({parcel, {}, ""});
  }
  const auto thin = [&](std::vector<similarity::LabelledShape>& shapes) {
    const std::size_t stride = std::max<std::size_t>(1, shapes.size() / count);
    std::vector<similarity::LabelledShape> kept;
    for (std::size_t i = 0; i < shapes.size() && kept.size() < count; i += stride)
      kept.push_back(std::move(shapes[i]));
    return kept;
  };
  out.parcels = thin(parcels);
  out.blocks = thin(blocks);
  return out;
}

}  // namespace plat::testing
