#include "imagery/linear_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plat::imagery {
namespace {

constexpr double kWhite = 65535.0;

double linear_of(double encoded_01) {
  return encoded_01 <= 0.04045 ? encoded_01 / 12.92 : std::pow((encoded_01 + 0.055) / 1.055, 2.4);
}

std::array<double, 256> decoding_table() {
  std::array<double, 256> table{};
  // Whole numbers: sums of them do not depend on the order.
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = std::round(kWhite * linear_of(static_cast<double>(i) / 255.0));
  return table;
}
const std::array<double, 256> kDecoded = decoding_table();

/// Per value of light, the 8-bit value nearest in light.
std::vector<std::uint8_t> encoding_table() {
  std::vector<std::uint8_t> table(static_cast<std::size_t>(kWhite) + 1);
  std::size_t value = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    while (value < 255 && 2.0 * static_cast<double>(i) > kDecoded[value] + kDecoded[value + 1])
      ++value;
    table[i] = static_cast<std::uint8_t>(value);
  }
  return table;
}
const std::vector<std::uint8_t> kEncoded = encoding_table();

}  // namespace

double to_linear(std::uint8_t encoded) { return kDecoded[encoded]; }

std::uint8_t to_encoded(double linear) {
  return kEncoded[static_cast<std::size_t>(std::clamp(linear, 0.0, kWhite) + 0.5)];
}

}  // namespace plat::imagery
