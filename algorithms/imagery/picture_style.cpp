#include "imagery/picture_style.h"

#include <algorithm>
#include <array>

namespace plat::imagery {
namespace {

constexpr std::array kShingles{Tint{0.43, 0.43, 0.44},  Tint{0.36, 0.355, 0.355},
                               Tint{0.47, 0.42, 0.375}, Tint{0.54, 0.51, 0.475},
                               Tint{0.46, 0.36, 0.315}, Tint{0.50, 0.50, 0.51},
                               Tint{0.39, 0.41, 0.42}};
constexpr std::array kClayTiles{Tint{0.66, 0.44, 0.33}, Tint{0.60, 0.395, 0.30},
                                Tint{0.69, 0.51, 0.41}, Tint{0.55, 0.375, 0.295},
                                Tint{0.64, 0.47, 0.36}};
constexpr std::array kFlatRoofs{Tint{0.78, 0.775, 0.755}, Tint{0.66, 0.64, 0.60},
                                Tint{0.56, 0.555, 0.55},  Tint{0.48, 0.475, 0.47},
                                Tint{0.72, 0.70, 0.66},   Tint{0.38, 0.375, 0.37}};
constexpr std::array kCrowns{Tint{0.275, 0.345, 0.19}, Tint{0.32, 0.39, 0.21},
                             Tint{0.24, 0.31, 0.18}, Tint{0.36, 0.405, 0.235},
                             Tint{0.295, 0.38, 0.22}};
constexpr std::array kDryCrowns{Tint{0.33, 0.355, 0.24}, Tint{0.375, 0.39, 0.275},
                                Tint{0.275, 0.315, 0.21}, Tint{0.42, 0.42, 0.31}};
constexpr std::array kCars{Tint{0.86, 0.86, 0.86}, Tint{0.70, 0.71, 0.72},  Tint{0.22, 0.22, 0.23},
                           Tint{0.14, 0.14, 0.15}, Tint{0.45, 0.455, 0.46}, Tint{0.80, 0.80, 0.79},
                           Tint{0.50, 0.16, 0.14}, Tint{0.20, 0.27, 0.42},  Tint{0.60, 0.58, 0.53}};

}  // namespace

Tint pick(Rng& rng, std::span<const Tint> tints) { return tints[rng.index(tints.size())]; }

Tint varied(Rng& rng, Tint tint, double share) {
  const double light = 1.0 + rng.uniform(-share, share);
  const double warmth = rng.uniform(-0.35, 0.35) * share;
  const auto clipped = [](double v) { return std::clamp(v, 0.0, 1.0); };
  return {clipped(tint.red * light * (1.0 + warmth)), clipped(tint.green * light),
          clipped(tint.blue * light * (1.0 - warmth))};
}

Tint pitched_roof_tint(Rng& rng, RoofStyle style) {
  const bool is_clay =
      style == RoofStyle::kClay || (style == RoofStyle::kMixed && rng.uniform_01() < 0.6);
  return varied(rng, is_clay ? pick(rng, kClayTiles) : pick(rng, kShingles), 0.10);
}

Tint flat_roof_tint(Rng& rng, RoofStyle style) {
  if (style == RoofStyle::kClay && rng.uniform_01() < 0.3)
    return varied(rng, pick(rng, kClayTiles), 0.12);
  return varied(rng, pick(rng, kFlatRoofs), 0.08);
}

Tint crown_tint(Rng& rng, Climate climate) {
  if (climate == Climate::kDry) return varied(rng, pick(rng, kDryCrowns), 0.15);
  return varied(rng, pick(rng, kCrowns), 0.15);
}

Tint car_tint(Rng& rng) { return varied(rng, pick(rng, kCars), 0.08); }

}  // namespace plat::imagery
