#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geodata/layer.h"
#include "imagery/imagery_plan.h"

namespace plat::imagery {

/// What became of one parcel, for those who judge an image: how like its source is, how far it is
/// stretched, how often the source is seen again.
struct ImageryRow {
  double area_log_difference = 0.0;    ///< log of the target's box area by the source's
  double aspect_log_difference = 0.0;  ///< log of the target's aspect ratio by the source's
  bool is_target_monotone = false;     ///< along the main axis, as [AVB08, Sec. 3.2] asks
  bool is_source_monotone = false;
  double stretch_median = 1.0;  ///< larger by smaller singular value, over the target's area
  double stretch_max = 1.0;     ///< over samples; tips themselves, where it has no bound, excluded
  double area_ratio = 1.0;      ///< of the target parcel by the source parcel
  double outside_01 = 0.0;      ///< share of the target that shows land beyond the source's contour
  std::uint32_t uses = 0;       ///< how many parcels show this source
  /// To the nearest other parcel that shows it, between the boxes' centres; nullopt where none
  /// does.
  std::optional<double> repeat_m;
};

/// One row per target; nullopt where it got no image.
std::vector<std::optional<ImageryRow>> imagery_rows(
    std::span<const ParcelShape> targets, std::span<const ImageExample> examples,
    std::span<const std::optional<ParcelImage>> plan, Jobs jobs = {});

/// The rows as a layer `imagery` of the target parcels: parcel, example (its name), source_parcel,
/// match, symmetry, warp, distance and all of ImageryRow.
geodata::Layer imagery_layer(const geodata::LocalFrame& frame, std::span<const ParcelShape> targets,
                             std::span<const ImageExample> examples,
                             std::span<const std::string> example_names,
                             std::span<const std::optional<ParcelImage>> plan,
                             std::span<const std::optional<ImageryRow>> rows);

/// The s x n points of each pair of parcels that correspond [AVB08, Fig. 7], in the target: layer
/// `target_grid`, points with parcel, line and sample.
geodata::Layer target_grid_layer(const geodata::LocalFrame& frame,
                                 std::span<const ParcelShape> targets,
                                 std::span<const std::optional<ParcelImage>> plan,
                                 std::size_t lines, std::size_t samples);

/// The same points in the sources of example `example`, in its frame: layer `source_grid`, or
/// `source_grid2` of the second example; `parcel` is the target.
geodata::Layer source_grid_layer(const geodata::LocalFrame& frame,
                                 std::span<const ParcelShape> targets,
                                 std::span<const std::optional<ParcelImage>> plan,
                                 std::size_t example, std::size_t lines, std::size_t samples);

std::string_view symmetry_name(Symmetry symmetry);

}  // namespace plat::imagery
