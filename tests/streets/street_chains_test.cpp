#include "streets/street_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "streets/network_cleaning.h"
#include "support/property.h"
#include "support/random_streets.h"
#include "support/street_map.h"

namespace plat::streets {
namespace {

using plat::testing::ascii_points;
using plat::testing::random_streets;
using plat::testing::streets_on;

/// The chains as the letters of their nodes, where a node has one.
std::vector<std::string> letters(const std::map<char, Point>& places, const StreetNetwork& network,
                                 const std::vector<StreetChain>& chains) {
  std::vector<std::string> out;
  for (const StreetChain& chain : chains) {
    std::string text;
    for (const std::uint32_t node : chain.nodes) {
      for (const auto& [letter, place] : places) {
        if (network.nodes[node] == place) text += letter;
      }
    }
    out.push_back(chain.is_closed ? "(" + text + ")" : text);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::string> chains_on(std::string_view drawing, const std::vector<std::string>& ways,
                                   const std::map<std::string, std::string>& names = {},
                                   const ChainOptions& options = {}) {
  const auto places = ascii_points(drawing, 50.0);
  auto raw = streets_on(places, ways);
  for (RawStreet& street : raw) {
    if (const auto it = names.find(street.source_id); it != names.end())
      street.attributes.name = it->second;
  }
  const StreetNetwork network = build_network(raw).network;
  return letters(places, network, chains_of(network, options));
}

using Texts = std::vector<std::string>;

constexpr std::string_view kCross = R"(
      D
     AXB
      C
)";

TEST(ChainsOf, StreetsGoStraightThroughACrossing) {
  EXPECT_EQ(chains_on(kCross, {"AX", "XB", "CX", "XD"}), (Texts{"AXB", "CXD"}));
}

TEST(ChainsOf, SideStreetEndsAtATee) {
  EXPECT_EQ(chains_on(kCross, {"AX", "XB", "XD"}), (Texts{"AXB", "XD"}));
}

TEST(ChainsOf, StreetDoesNotTurnACorner) {
  // Two ways of different class, so that cleaning leaves the node.
  const auto places = ascii_points(kCross, 50.0);
  auto raw = streets_on(places, {"AX", "XD"});
  raw[0].attributes.street_class = "primary";
  const StreetNetwork network = build_network(raw).network;
  EXPECT_EQ(letters(places, network, chains_of(network)), (Texts{"AX", "XD"}));
  EXPECT_EQ(letters(places, network, chains_of(network, {.max_turn_rad = 1.6})), (Texts{"AXD"}));
}

TEST(ChainsOf, NameGoesOnRoundTheCorner) {
  const std::map<std::string, std::string> names{
      {"AX", "Elm"}, {"XD", "Elm"}, {"XB", "Oak"}, {"CX", "Oak"}};
  EXPECT_EQ(chains_on(kCross, {"AX", "XB", "CX", "XD"}, names), (Texts{"AXD", "CXB"}));
}

TEST(ChainsOf, DirectionAloneDoesNotSeeNames) {
  const std::map<std::string, std::string> names{
      {"AX", "Elm"}, {"XD", "Elm"}, {"XB", "Oak"}, {"CX", "Oak"}};
  EXPECT_EQ(
      chains_on(kCross, {"AX", "XB", "CX", "XD"}, names, {.continuity = Continuity::kDirection}),
      (Texts{"AXB", "CXD"}));
}

TEST(ChainsOf, NameAloneKeepsApartWhatLiesStraight) {
  const std::map<std::string, std::string> names{{"AX", "Elm"}, {"XB", "Oak"}};
  EXPECT_EQ(chains_on(kCross, {"AX", "XB", "CX", "XD"}, names, {.continuity = Continuity::kName}),
            (Texts{"AX", "CXD", "XB"}));
  EXPECT_EQ(chains_on(kCross, {"AX", "XB", "CX", "XD"}, names), (Texts{"AXB", "CXD"}));
}

TEST(ChainsOf, NameDoesNotTurnBack) {
  // Two carriageways of one name begin at A, where a third street ends; they part by 37 degrees.
  const std::map<std::string, std::string> names{{"AB", "Rambla"}, {"AC", "Rambla"}};
  EXPECT_EQ(chains_on(R"(
       D
          B
       A
          C
  )",
                      {"AB", "AC", "DA"}, names),
            (Texts{"AB", "AC", "AD"}));
}

TEST(ChainsOf, StraightestPairIsJoinedFirst) {
  // From A, both B (27 degrees off) and C (straight on) would do.
  EXPECT_EQ(chains_on(R"(
            B

     A  X  C
  )",
                      {"AX", "XB", "XC"}),
            (Texts{"AXC", "XB"}));
}

TEST(ChainsOf, RingIsClosedAndItsStemEndsThere) {
  // A loop that leaves the stem at right angles goes on into itself.
  const auto places = ascii_points(R"(
       B C
     S A D
       F E
  )",
                                   50.0);
  const StreetNetwork network = build_network(streets_on(places, {"SA", "ABCDEFA"})).network;
  const auto chains = chains_of(network);
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(letters(places, network, chains), (Texts{"(AA)", "SA"}));
}

TEST(ChainsOf, RoundaboutOfPiecesIsOneClosedChain) {
  const auto places = ascii_points(R"(
         N
        B C
       A   D
     W       E
       H   I
        G F
         S
  )",
                                   20.0);
  auto raw = streets_on(places, {"ABCDIFGHA"});
  // Arms that meet the ring in the middle of its sides, all round.
  const auto arm = [&](char outer, Point on_ring) {
    raw.push_back({std::string(1, outer), {places.at(outer), on_ring}, raw[0].attributes});
  };
  arm('N', midpoint(places.at('B'), places.at('C')));
  arm('E', midpoint(places.at('D'), places.at('I')));
  arm('S', midpoint(places.at('F'), places.at('G')));
  arm('W', midpoint(places.at('H'), places.at('A')));
  const StreetNetwork network = build_network(raw).network;
  const auto chains = chains_of(network);
  EXPECT_EQ(chains.size(), 5U);
  const auto ring =
      std::find_if(chains.begin(), chains.end(), [](const auto& c) { return c.is_closed; });
  ASSERT_NE(ring, chains.end());
  EXPECT_EQ(ring->pieces.size(), 4U);
  EXPECT_EQ(ring->nodes.front(), ring->nodes.back());
}

TEST(ChainsOf, KinkAtACrossingDoesNotPartAStreet) {
  // The street jumps aside by a metre where it passes the crossing, 63 degrees for its first metre.
  const std::vector<RawStreet> raw{{"west", {{-100, 0}, {0, 0}}, {}},
                                   {"east", {{0, 0}, {0.5, 1}, {100, 1}}, {}},
                                   {"south", {{0, 0}, {0, -80}}, {}}};
  const StreetNetwork network = build_network(raw).network;
  const auto chains = chains_of(network);
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(network.nodes[chains[0].nodes.front()], (Point{-100, 0}));
  EXPECT_EQ(network.nodes[chains[0].nodes.back()], (Point{100, 1}));
}

TEST(ChainsOf, BridgeGoesOnAsTheStreetOnTheGround) {
  const auto places = ascii_points(R"(
        N
     A B C D
        S
  )",
                                   50.0);
  auto raw = streets_on(places, {"AB", "BC", "CD", "NS"});
  raw[1].attributes.level = 1;
  raw[1].attributes.structure = Structure::kBridge;
  const StreetNetwork network = build_network(raw).network;
  EXPECT_EQ(letters(places, network, chains_of(network)), (Texts{"ABCD", "SN"}));
}

TEST(ChainsOf, EmptyNetworkHasNone) { EXPECT_TRUE(chains_of({}).empty()); }

void expect_sound(const StreetNetwork& network, const std::vector<StreetChain>& chains) {
  std::vector<int> uses(network.streets.size(), 0);
  for (const StreetChain& chain : chains) {
    ASSERT_EQ(chain.nodes.size(), chain.pieces.size() + 1);
    for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
      const Street& street = network.streets[chain.pieces[i].street];
      ++uses[chain.pieces[i].street];
      const bool is_reversed = chain.pieces[i].is_reversed;
      EXPECT_EQ(chain.nodes[i], is_reversed ? street.to : street.from);
      EXPECT_EQ(chain.nodes[i + 1], is_reversed ? street.from : street.to);
    }
    if (chain.is_closed) {
      EXPECT_EQ(chain.nodes.front(), chain.nodes.back());
    }
    EXPECT_NEAR(length_m(network, chain), plat::length_m(line_of(network, chain)), 1e-6);
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), static_cast<std::ptrdiff_t>(uses.size()));
}

std::vector<Polyline> lines(const StreetNetwork& network, const std::vector<StreetChain>& chains) {
  std::vector<Polyline> out;
  for (const StreetChain& chain : chains) out.push_back(line_of(network, chain));
  return out;
}

class ChainsOfRandomNetwork : public ::testing::TestWithParam<Continuity> {};

TEST_P(ChainsOfRandomNetwork, HasEveryPieceInExactlyOneChain) {
  Rng rng = plat::testing::property_rng("HasEveryPieceInExactlyOneChain");
  std::size_t joined = 0;
  std::size_t closed = 0;
  for (int i = 0; i < plat::testing::iterations(60); ++i) {
    const StreetNetwork network =
        build_network(random_streets(rng, 3 + rng.index(30), 400.0)).network;
    const auto chains = chains_of(network, {.continuity = GetParam()});
    expect_sound(network, chains);
    for (const StreetChain& chain : chains) {
      joined += chain.pieces.size() > 1 ? 1 : 0;
      closed += chain.is_closed ? 1 : 0;
    }
  }
  EXPECT_GT(joined, 300U);
  EXPECT_GT(closed, 10U);
}

TEST_P(ChainsOfRandomNetwork, DoesNotDependOnTheOrderOrSenseOfStreets) {
  Rng rng = plat::testing::property_rng("DoesNotDependOnTheOrderOrSenseOfStreets");
  for (int i = 0; i < plat::testing::iterations(60); ++i) {
    const StreetNetwork network =
        build_network(random_streets(rng, 3 + rng.index(30), 400.0)).network;
    StreetNetwork twin = network;
    for (std::size_t k = twin.streets.size(); k > 1; --k)
      std::swap(twin.streets[k - 1], twin.streets[rng.index(k)]);
    for (Street& street : twin.streets) {
      if (rng.index(2) == 0) continue;
      std::swap(street.from, street.to);
      std::reverse(street.line.begin(), street.line.end());
    }
    const ChainOptions options{.continuity = GetParam()};
    EXPECT_EQ(lines(network, chains_of(network, options)), lines(twin, chains_of(twin, options)));
  }
}

TEST_P(ChainsOfRandomNetwork, DoesNotDependOnWhatNamesAreCalled) {
  Rng rng = plat::testing::property_rng("DoesNotDependOnWhatNamesAreCalled");
  for (int i = 0; i < plat::testing::iterations(40); ++i) {
    const StreetNetwork network =
        build_network(random_streets(rng, 3 + rng.index(30), 400.0)).network;
    StreetNetwork twin = network;
    for (Street& street : twin.streets) {
      if (!street.attributes.name.empty())
        street.attributes.name =
            "Rua " + std::string(1, static_cast<char>('Z' - street.attributes.name[0] + 'A'));
    }
    const ChainOptions options{.continuity = GetParam()};
    EXPECT_EQ(lines(network, chains_of(network, options)), lines(twin, chains_of(twin, options)));
  }
}

/// Which pieces are together, as sorted sets of street numbers.
std::vector<std::vector<std::uint32_t>> partition(const std::vector<StreetChain>& chains) {
  std::vector<std::vector<std::uint32_t>> out;
  for (const StreetChain& chain : chains) {
    out.emplace_back();
    for (const StreetChain::Piece& piece : chain.pieces) out.back().push_back(piece.street);
    std::sort(out.back().begin(), out.back().end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST_P(ChainsOfRandomNetwork, MovesWithTheNetwork) {
  Rng rng = plat::testing::property_rng("MovesWithTheNetwork");
  for (int i = 0; i < plat::testing::iterations(40); ++i) {
    const StreetNetwork network =
        build_network(random_streets(rng, 3 + rng.index(30), 400.0)).network;
    StreetNetwork twin = network;
    // A quarter turn and a shift by whole metres are exact.
    const auto move = [](Point& p) { p = perpendicular(p) + Point{731.0, -2048.0}; };
    for (Point& node : twin.nodes) move(node);
    for (Street& street : twin.streets) std::for_each(street.line.begin(), street.line.end(), move);
    const ChainOptions options{.continuity = GetParam()};
    EXPECT_EQ(partition(chains_of(network, options)), partition(chains_of(twin, options)));
  }
}

INSTANTIATE_TEST_SUITE_P(Continuities, ChainsOfRandomNetwork,
                         ::testing::Values(Continuity::kName, Continuity::kDirection,
                                           Continuity::kNameOrDirection));

}  // namespace
}  // namespace plat::streets
