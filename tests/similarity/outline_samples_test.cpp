#include "similarity/outline_samples.h"

#include "similarity/made_shapes.h"
#include "similarity/similarity_contract.h"
#include "support/property.h"

namespace plat::similarity {
namespace {

using plat::testing::begun_elsewhere;
using plat::testing::centred;
using plat::testing::image_of;
using plat::testing::iterations;
using plat::testing::made_shape;
using plat::testing::place_on;
using plat::testing::property_rng;
using plat::testing::with_more_vertices;

constexpr double kRounding_m = 1e-8;

TEST(OutlineSamples, FollowEachOtherAtEqualDistancesAlongTheOutline) {
  Rng rng = property_rng("OutlineSamples.Equal");
  for (int i = 0; i < iterations(300); ++i) {
    const LabelledShape shape = centred(made_shape(rng));
    const Ring& ring = shape.polygon.outer;
    const std::size_t count = 3 + rng.index(200);
    const OutlineSamples samples = outline_samples(ring, count);
    ASSERT_EQ(samples.places.size(), count);
    const double length = perimeter_m(std::span<const Point>(ring));
    const double first = place_on(ring, samples.origin + samples.places[0]).first;
    for (std::size_t k = 0; k < count; ++k) {
      const auto [place, away] = place_on(ring, samples.origin + samples.places[k]);
      ASSERT_LT(away, kRounding_m);
      const double wanted = first + static_cast<double>(k) * length / static_cast<double>(count);
      const double off = std::abs(std::remainder(place - wanted, length));
      ASSERT_LT(off, kRounding_m) << k;
    }
  }
}

/// Distances between all samples: what does not change when the outline is moved and turned.
std::vector<double> distances(const OutlineSamples& samples) {
  std::vector<double> out;
  for (const Point p : samples.places)
    for (const Point q : samples.places) out.push_back(distance(p, q));
  return out;
}

void expect_same(const OutlineSamples& a, const OutlineSamples& b) {
  const std::vector<double> one = distances(a);
  const std::vector<double> other = distances(b);
  double largest = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k)
    largest = std::max(largest, std::abs(one[k] - other[k]));
  // A tie is decided to a hundred-millionth of the outline's length, 20 km at most.
  EXPECT_LT(largest, 1e-3);
}

TEST(OutlineSamples, AreTheSameOfAnOutlineTurnedOrToldOtherwise) {
  Rng rng = property_rng("OutlineSamples.Same");
  for (int i = 0; i < iterations(300); ++i) {
    const LabelledShape shape = centred(made_shape(rng));
    const std::size_t count = 3 + rng.index(60);
    const OutlineSamples samples = outline_samples(shape.polygon.outer, count);
    const Affine turn = Affine::rotation(rng.uniform(0.0, 6.3));
    expect_same(samples, outline_samples(begun_elsewhere(rng, shape).polygon.outer, count));
    expect_same(samples, outline_samples(with_more_vertices(rng, shape).polygon.outer, count));
    expect_same(samples, outline_samples(image_of(turn, shape).polygon.outer, count));
  }
}

/// Four samples lie at the same distances from the middle whichever corner is the first; from
/// neighbouring corners they are mirror images.
TEST(OutlineSamples, MirrorImagesAreToldApart) {
  const Ring ring{{0, 0}, {6, 0}, {6, 2}, {0, 2}};
  for (std::ptrdiff_t by = 0; by < 4; ++by) {
    Ring begun = ring;
    std::ranges::rotate(begun, begun.begin() + by);
    const OutlineSamples samples = outline_samples(begun, 4);
    EXPECT_DOUBLE_EQ(distance(samples.places[0], samples.places[1]), std::sqrt(8.0)) << by;
  }
}

/// Of a square's corners that with the smallest coordinates, wherever the ring begins: seven
/// samples begun at another corner are other points.
TEST(OutlineSamples, CornersThatARotationExchangesAreToldApartByPlace) {
  for (std::ptrdiff_t by = 0; by < 4; ++by) {
    Ring begun{{10, 10}, {20, 10}, {20, 20}, {10, 20}};
    std::ranges::rotate(begun, begun.begin() + by);
    const OutlineSamples samples = outline_samples(begun, 7);
    EXPECT_EQ(samples.origin + samples.places[0], (Point{10, 10})) << by;
  }
}

TEST(OutlineSamples, BeginAtTheFarthestVertexThatIsFollowedByTheFarthestSamples) {
  // All corners of a rectangle are as far from its middle; behind two of them runs a short side, at
  // the end of which one is as far again.
  const Ring ring{{0, 0}, {6, 0}, {6, 2}, {0, 2}};
  const OutlineSamples samples = outline_samples(ring, 8);
  EXPECT_EQ(samples.origin + samples.places[0], (Point{0, 2}));
  EXPECT_EQ(samples.origin + samples.places[1], (Point{0, 0}));
  EXPECT_EQ(samples.origin + samples.places[2], (Point{2, 0}));
  EXPECT_EQ(samples.centroid, (Point{3, 1}));
}

}  // namespace
}  // namespace plat::similarity
