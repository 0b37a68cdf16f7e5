#pragma once

#include <cstdint>

#include "geodata/raster.h"

namespace plat::imagery {

/// A colour in proportion to light, 0 to 65535 a channel. Pixels are mixed in this space: half
/// black and half white sends half the light of white, whose 8-bit sRGB value is 188, not 128.
struct LinearColour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

/// sRGB's transfer curve; to_encoded(to_linear(v)) == v for all 256 values.
double to_linear(std::uint8_t encoded);
std::uint8_t to_encoded(double linear);

}  // namespace plat::imagery
