#pragma once

#include <span>

#include "core/rng.h"
#include "imagery/scene.h"

namespace plat::imagery {

enum class Climate {
  kTemperate,  ///< lawns and many trees
  kDry,        ///< bare ground, few trees, pools
};

enum class RoofStyle {
  kShingle,  ///< grey and brown gables, large roofs flat and light
  kClay,     ///< red tiles, large roofs flat and light
  kMixed,    ///< of each
};

/// The colours and habits of a place.
struct PictureStyle {
  Climate climate = Climate::kTemperate;
  RoofStyle roofs = RoofStyle::kShingle;

  [[nodiscard]] bool is_dry() const { return climate == Climate::kDry; }
};

/// Colours as an aerial camera sees them, a little dull, before light and texture.
namespace tints {
inline constexpr Tint kAsphalt{0.42, 0.42, 0.435};
inline constexpr Tint kOldAsphalt{0.50, 0.495, 0.49};
inline constexpr Tint kPavement{0.63, 0.615, 0.585};
inline constexpr Tint kConcrete{0.68, 0.66, 0.625};
inline constexpr Tint kGravel{0.60, 0.565, 0.50};
inline constexpr Tint kWhitePaint{0.80, 0.80, 0.78};
inline constexpr Tint kYellowPaint{0.76, 0.64, 0.33};
inline constexpr Tint kSoil{0.55, 0.475, 0.375};
inline constexpr Tint kDrySoil{0.66, 0.57, 0.45};
inline constexpr Tint kLawn{0.37, 0.43, 0.25};
inline constexpr Tint kDryLawn{0.505, 0.495, 0.36};
inline constexpr Tint kShrubs{0.29, 0.34, 0.19};
inline constexpr Tint kHedge{0.22, 0.28, 0.15};
inline constexpr Tint kFence{0.45, 0.40, 0.34};
inline constexpr Tint kWood{0.52, 0.43, 0.33};
inline constexpr Tint kWater{0.20, 0.265, 0.28};
inline constexpr Tint kPool{0.36, 0.70, 0.78};
}  // namespace tints

/// One of them, each as likely.
Tint pick(Rng& rng, std::span<const Tint> tints);
/// The tint, lighter or darker by up to `share`, a little warmer or colder.
Tint varied(Rng& rng, Tint tint, double share);

Tint pitched_roof_tint(Rng& rng, RoofStyle style);
Tint flat_roof_tint(Rng& rng, RoofStyle style);
Tint crown_tint(Rng& rng, Climate climate);
Tint car_tint(Rng& rng);

}  // namespace plat::imagery
