#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "imagery/image_retrieval.h"
#include "imagery/warp_map.h"

namespace plat::imagery {

/// How likely a place takes its image from the second of two sources: the same everywhere, or
/// growing linearly from `begin_01` at the start of a ramp to `end_01` at its end, across all lines
/// perpendicular to it [AVB08, Sec. 6, Fig. 12].
struct SourceWeight {
  double begin_01 = 0.0;
  double end_01 = 0.0;
  std::optional<Segment> ramp{};  ///< nullopt: begin_01 everywhere

  [[nodiscard]] double at(Point p) const;
};

/// The parcels of one example city, each wholly covered by its image.
struct ImageExample {
  std::vector<ParcelShape> parcels;
};

/// Where one parcel's image comes from and how it gets there.
struct ParcelImage {
  std::size_t example = 0;  ///< which example city
  Match match;              ///< the parcel in it
  WarpGrid grid;
};

/// Where a city is its own example: whether a parcel may take the image of the parcel of its id.
enum class OwnImage { kAllowed, kForbidden };

struct PlanOptions {
  RetrievalOptions retrieval{};
  SourceWeight weight{};  ///< of the second example, where there are two
  OwnImage own_image = OwnImage::kAllowed;
  std::uint64_t seed = 1;
};

/// An image for every target parcel.
///
/// Guarantees: 1. the same for any thread count;  2. a parcel's draw depends on the seed and its
/// number only;  3. without an image only where the one example parcel is the parcel itself.
/// @param examples  one or two; @throws InputError where one has no parcel
std::vector<std::optional<ParcelImage>> plan_imagery(std::span<const ParcelShape> targets,
                                                     std::span<const ImageExample> examples,
                                                     const PlanOptions& options, Jobs jobs = {});

}  // namespace plat::imagery
