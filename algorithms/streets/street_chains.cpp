#include "streets/street_chains.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plat::streets {
namespace {

/// Where directions are measured, metres from the node along the street: beyond rounded corners and
/// the steps of quantised coordinates (0.8 m in Cambridge), well within most blocks.
constexpr double kHeadingReach_m = 15.0;
/// Two carriageways of one name that meet turn by more than this: that is going back, not on.
constexpr double kGoingBack_rad = 0.75 * std::numbers::pi;

/// The end of a street at a node: 2 * street at `from`, one more at `to`.
using Arm = std::uint32_t;
constexpr Arm kNoArm = std::numeric_limits<Arm>::max();

constexpr Arm other_end(Arm arm) { return arm ^ 1U; }

double length_from(const Polyline& line, bool is_reversed) {
  double total_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::size_t k = is_reversed ? line.size() - i : i;
    total_m += distance(line[k - 1], line[k]);
  }
  return total_m;
}

std::uint32_t node_of(const StreetNetwork& network, Arm arm) {
  const Street& street = network.streets[arm / 2];
  return arm % 2 == 0 ? street.from : street.to;
}

/// Two arms of a node that may be one street.
struct Pair {
  Arm first = 0;
  Arm second = 0;
  bool has_name = false;  ///< both bear the same
  double turn_rad = 0.0;
  Point low;  ///< headings, lower first: an order that no numbering changes
  Point high;
};

bool goes_first(const Pair& a, const Pair& b) {
  if (a.has_name != b.has_name) return a.has_name;
  if (a.turn_rad != b.turn_rad) return a.turn_rad < b.turn_rad;
  if (a.low != b.low) return a.low < b.low;
  return a.high < b.high;
}

/// The pair of two arms, or nothing where they may not be one street.
std::optional<Pair> pair_of(const StreetNetwork& network, const ChainOptions& options, Arm first,
                            Arm second) {
  const std::string& name_a = network.streets[first / 2].attributes.name;
  const std::string& name_b = network.streets[second / 2].attributes.name;
  const Point a = heading_of(network.streets[first / 2], first % 2 == 1);
  const Point b = heading_of(network.streets[second / 2], second % 2 == 1);
  // The same bits whichever of the two comes first.
  const double turn_rad = std::atan2(std::abs(cross(a, b)), -dot(a, b));
  const bool has_name =
      options.continuity != Continuity::kDirection && !name_a.empty() && name_a == name_b;
  if (has_name ? turn_rad > kGoingBack_rad : turn_rad > options.max_turn_rad) return std::nullopt;
  if (options.continuity == Continuity::kName && !has_name && !name_a.empty() && !name_b.empty())
    return std::nullopt;
  return Pair{first, second, has_name, turn_rad, std::min(a, b), std::max(a, b)};
}

/// Per arm the one that its street goes on with at the node, or kNoArm.
std::vector<Arm> partners(const StreetNetwork& network, const ChainOptions& options) {
  std::vector<std::vector<Arm>> arms(network.nodes.size());
  for (Arm arm = 0; arm < 2 * network.streets.size(); ++arm)
    arms[node_of(network, arm)].push_back(arm);
  std::vector<Arm> partner(2 * network.streets.size(), kNoArm);
  std::vector<Pair> pairs;
  const auto join = [&](Arm first, Arm second) {
    partner[first] = second;
    partner[second] = first;
  };
  for (const std::vector<Arm>& at_node : arms) {
    // A ring that nothing else meets: cleaning puts its node at any of its corners.
    if (at_node.size() == 2 && other_end(at_node[0]) == at_node[1]) {
      join(at_node[0], at_node[1]);
      continue;
    }
    pairs.clear();
    for (std::size_t i = 0; i < at_node.size(); ++i) {
      for (std::size_t j = i + 1; j < at_node.size(); ++j) {
        if (const auto pair = pair_of(network, options, at_node[i], at_node[j]))
          pairs.push_back(*pair);
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(), goes_first);
    for (const Pair& pair : pairs) {
      if (partner[pair.first] == kNoArm && partner[pair.second] == kNoArm)
        join(pair.first, pair.second);
    }
  }
  return partner;
}

/// The chain that begins with `start`, up to its end or back to where it began.
StreetChain chain_from(const StreetNetwork& network, const std::vector<Arm>& partner, Arm start) {
  StreetChain chain;
  chain.nodes.push_back(node_of(network, start));
  for (Arm arm = start; arm != kNoArm;) {
    chain.pieces.push_back({arm / 2, arm % 2 == 1});
    chain.nodes.push_back(node_of(network, other_end(arm)));
    arm = partner[other_end(arm)];
    if (arm != start) continue;
    chain.is_closed = true;
    break;
  }
  return chain;
}

StreetChain reversed(const StreetChain& chain) {
  StreetChain out = chain;
  std::reverse(out.pieces.begin(), out.pieces.end());
  for (StreetChain::Piece& piece : out.pieces) piece.is_reversed = !piece.is_reversed;
  std::reverse(out.nodes.begin(), out.nodes.end());
  return out;
}

/// The closed chain, begun at its piece `first`.
StreetChain rotated(const StreetChain& chain, std::size_t first) {
  StreetChain out = chain;
  const auto offset = static_cast<std::ptrdiff_t>(first);
  std::rotate(out.pieces.begin(), out.pieces.begin() + offset, out.pieces.end());
  out.nodes.pop_back();
  std::rotate(out.nodes.begin(), out.nodes.begin() + offset, out.nodes.end());
  out.nodes.push_back(out.nodes.front());
  return out;
}

struct LinedChain {
  Polyline line;
  StreetChain chain;
};

/// The chain in the sense, and a closed one from the node, that comes first by its line.
LinedChain in_order(const StreetNetwork& network, const StreetChain& chain) {
  LinedChain best{line_of(network, chain), chain};
  const auto consider = [&](const StreetChain& candidate) {
    Polyline line = line_of(network, candidate);
    if (line < best.line) best = {std::move(line), candidate};
  };
  consider(reversed(chain));
  if (!chain.is_closed) return best;
  const std::uint32_t lowest = *std::min_element(
      chain.nodes.begin(), chain.nodes.end(),
      [&](std::uint32_t a, std::uint32_t b) { return network.nodes[a] < network.nodes[b]; });
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    if (chain.nodes[i] != lowest) continue;
    const StreetChain candidate = rotated(chain, i);
    consider(candidate);
    consider(reversed(candidate));
  }
  return best;
}

}  // namespace

std::vector<StreetChain> chains_of(const StreetNetwork& network, const ChainOptions& options) {
  const std::vector<Arm> partner = partners(network, options);
  std::vector<bool> is_taken(network.streets.size(), false);
  std::vector<LinedChain> found;
  const auto take = [&](Arm start) {
    if (is_taken[start / 2]) return;
    const StreetChain chain = chain_from(network, partner, start);
    for (const StreetChain::Piece& piece : chain.pieces) is_taken[piece.street] = true;
    found.push_back(in_order(network, chain));
  };
  for (Arm arm = 0; arm < partner.size(); ++arm) {
    if (partner[arm] == kNoArm) take(arm);
  }
  for (Arm arm = 0; arm < partner.size(); arm += 2) take(arm);  // what is left has no end
  std::stable_sort(found.begin(), found.end(),
                   [](const LinedChain& a, const LinedChain& b) { return a.line < b.line; });
  std::vector<StreetChain> chains;
  chains.reserve(found.size());
  for (LinedChain& lined : found) chains.push_back(std::move(lined.chain));
  return chains;
}

Polyline line_of(const StreetNetwork& network, const StreetChain& chain) {
  Polyline line;
  for (const StreetChain::Piece& piece : chain.pieces) {
    const Polyline& part = network.streets[piece.street].line;
    if (!line.empty()) line.pop_back();  // the node, which the next piece has too
    if (piece.is_reversed)
      line.insert(line.end(), part.rbegin(), part.rend());
    else
      line.insert(line.end(), part.begin(), part.end());
  }
  return line;
}

double length_m(const StreetNetwork& network, StreetChain::Piece piece) {
  return length_from(network.streets[piece.street].line, piece.is_reversed);
}

double length_m(const StreetNetwork& network, const StreetChain& chain) {
  double total_m = 0.0;
  for (const StreetChain::Piece piece : chain.pieces) total_m += length_m(network, piece);
  return total_m;
}

double width_m(const StreetNetwork& network, const StreetChain& chain) {
  double total_m = 0.0;
  double area_m2 = 0.0;
  for (const StreetChain::Piece& piece : chain.pieces) {
    const double piece_m = length_m(network, piece);
    total_m += piece_m;
    area_m2 += piece_m * network.streets[piece.street].width_m;
  }
  return total_m > 0.0 ? area_m2 / total_m : 0.0;
}

Point heading_of(const Street& street, bool is_reversed) {
  const Polyline& line = street.line;
  const auto at = [&](std::size_t i) { return line[is_reversed ? line.size() - 1 - i : i]; };
  // No further than half way: a loop would come back.
  double left_m = std::min(kHeadingReach_m, length_from(line, is_reversed) / 2.0);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step_m = distance(at(i - 1), at(i));
    if (step_m >= left_m) return normalized(lerp(at(i - 1), at(i), left_m / step_m) - at(0));
    left_m -= step_m;
  }
  return normalized(at(line.size() - 1) - at(0));
}

}  // namespace plat::streets
