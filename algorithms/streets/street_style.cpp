#include "streets/street_style.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plat::streets {
namespace {

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Of the sample; 0 for fewer than two values.
double variance(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double middle = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return sum / static_cast<double>(values.size() - 1);
}

/// What lies between two consecutive intersection points of a street.
struct Span {
  Point chord;
  double length_m = 0.0;
};

std::vector<Span> spans_of(const StreetNetwork& network, const StreetChain& chain,
                           std::span<const std::size_t> stops) {
  std::vector<Span> spans;
  const std::size_t count = chain.is_closed ? stops.size() : stops.size() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = stops[k];
    const std::size_t to = stops[(k + 1) % stops.size()];
    Span span{network.nodes[chain.nodes[to]] - network.nodes[chain.nodes[from]], 0.0};
    std::size_t piece = from;
    do {
      span.length_m += length_m(network, chain.pieces[piece]);
      piece = (piece + 1) % chain.pieces.size();
    } while (piece != to % chain.pieces.size());
    if (squared_length(span.chord) > 0.0) spans.push_back(span);
  }
  return spans;
}

}  // namespace

PassingStreet style_of(const StreetNetwork& network, const StreetChain& chain,
                       std::span<const std::size_t> stops) {
  PassingStreet style;
  style.hierarchy = chain.hierarchy;
  style.width_m = width_m(network, chain);
  const std::vector<Span> spans =
      stops.empty() ? std::vector<Span>{} : spans_of(network, chain, stops);
  if (spans.empty()) return style;
  std::vector<double> tortuosities;
  std::vector<double> distances_m;
  std::vector<double> angles_rad;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    distances_m.push_back(length(spans[k].chord));
    tortuosities.push_back(std::max(spans[k].length_m / distances_m.back(), 1.0));
    const bool has_next = k + 1 < spans.size() || (chain.is_closed && spans.size() > 1);
    if (!has_next) continue;
    const Point next = spans[(k + 1) % spans.size()].chord;
    angles_rad.push_back(
        std::atan2(std::abs(cross(spans[k].chord, next)), dot(spans[k].chord, next)));
  }
  style.tortuosity = std::max(mean(tortuosities), 1.0);
  style.distance_mean_m = mean(distances_m);
  style.distance_variance_m2 = variance(distances_m);
  style.angle_mean_rad = mean(angles_rad);
  style.angle_variance_rad2 = variance(angles_rad);
  return style;
}

}  // namespace plat::streets
