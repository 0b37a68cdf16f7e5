#include "streets/place_tree.h"

#include "streets/made_sites.h"
#include "support/property.h"

namespace plat::streets {
namespace {

std::vector<Point> random_places(std::uint32_t number) {
  std::vector<Point> out;
  for (const IntersectionPoint& point : testing::made_site(11, number, 120).site.points)
    out.push_back(point.place);
  return out;
}

std::vector<std::uint32_t> nearest_by_sorting(const std::vector<Point>& places, std::uint32_t of,
                                              std::size_t count) {
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (i != of) all.emplace_back(squared_length(places[i] - places[of]), i);
  std::ranges::sort(all);
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < std::min(count, all.size()); ++i) out.push_back(all[i].second);
  return out;
}

TEST(PlaceTree, FindsTheNearestAsSortingDoes) {
  int ties = 0;
  for (std::uint32_t number = 0; number < static_cast<std::uint32_t>(testing::iterations(60));
       ++number) {
    const auto places = random_places(number);
    const PlaceTree tree(places);
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      const std::size_t count = (i + number) % 12;
      const auto expected = nearest_by_sorting(places, i, count);
      ASSERT_EQ(tree.nearest(i, count), expected) << "made_site(11, " << number << "), place " << i;
      for (std::size_t k = 1; k < expected.size(); ++k)
        ties +=
            distance(places[i], places[expected[k]]) == distance(places[i], places[expected[k - 1]])
                ? 1
                : 0;
    }
  }
  EXPECT_GT(ties, 1000);
}

TEST(PlaceTree, FindsAPlaceInABoxWhereThereIsOne) {
  Rng rng = testing::property_rng("PlaceTree.Any");
  int found = 0;
  int missed = 0;
  for (std::uint32_t number = 0; number < static_cast<std::uint32_t>(testing::iterations(300));
       ++number) {
    const auto places = random_places(number);
    if (places.empty()) continue;
    const PlaceTree tree(places);
    const Box all = box_of(places).expanded(10.0);
    Box box;
    for (int i = 0; i < 2; ++i)
      box.add(Point{rng.uniform(all.min.x, all.max.x), rng.uniform(all.min.y, all.max.y)});
    const bool is_there = tree.any([&](const Box& other) { return other.intersects(box); },
                                   [&](std::uint32_t i) { return box.contains(places[i]); });
    ASSERT_EQ(is_there, std::ranges::any_of(places, [&](Point p) { return box.contains(p); }));
    ++(is_there ? found : missed);
  }
  EXPECT_GT(found, 30);
  EXPECT_GT(missed, 30);
}

TEST(PlaceTree, WithoutPlacesFindsNone) {
  const PlaceTree tree({});
  EXPECT_FALSE(tree.any([](const Box&) { return true; }, [](std::uint32_t) { return true; }));
}

}  // namespace
}  // namespace plat::streets
