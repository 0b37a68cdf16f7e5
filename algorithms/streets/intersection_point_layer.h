#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "geodata/layer.h"
#include "geodata/layer_io.h"
#include "streets/intersection_point.h"

namespace plat::streets {

/// What the layer is called in files that Plat writes.
inline constexpr std::string_view kPointLayerName = "points";

/// Intersection points as a layer that a person can open and edit: one point feature each, numbered
/// from 1 in their order, every attribute a column (docs/intersection_points.md).
geodata::Layer intersection_point_layer(std::span<const IntersectionPoint> points,
                                        const geodata::LocalFrame& frame);

/// The points of a layer, in its order; columns that are not ours are ignored. A point whose street
/// b is of a higher order than its street a has the two exchanged, so that editing a level needs no
/// more.
///
/// Guarantees: 1. points that were written are read back to the last bit;  2. places lie on the
/// working grid.
/// @param file  named in messages
/// @throws InputError with file, layer, feature, field, value and what is allowed: a layer of
///         another kind, a missing column, a feature that is not one point, a value that is
///         missing, not a number or out of range
std::vector<IntersectionPoint> intersection_points_of(const geodata::Layer& layer,
                                                      std::string_view file);

struct ReadPoints {
  geodata::LocalFrame frame;
  std::vector<IntersectionPoint> points;
};

/// Reads the points of a file; where no layer is named, its layer "points" if it has one.
/// @param frame  reproject into this one; chosen from the data if not given
/// @throws InputError as intersection_points_of() and geodata::read_layer()
ReadPoints read_intersection_points(const geodata::LayerSource& source,
                                    const std::optional<geodata::LocalFrame>& frame = {});

}  // namespace plat::streets
