#include "imagery/image_retrieval.h"

#include <algorithm>
#include <cmath>

#include "core/failure.h"

namespace plat::imagery {
namespace {

/// The zone under which all zones are searched; no zone of a layer is called so.
const std::string kAllZones{"\n"};

}  // namespace

std::string_view match_level_name(MatchLevel level) {
  switch (level) {
    case MatchLevel::kFrontAndZone:
      return "front_and_zone";
    case MatchLevel::kFront:
      return "front";
    case MatchLevel::kAny:
      return "any";
  }
  throw LogicError("a match level has no name");
}

ImageRetrieval::ImageRetrieval(std::span<const ParcelShape> examples,
                               const RetrievalOptions& options)
    : options_(options) {
  if (examples.empty()) throw InputError("no example parcel: there is no image to take");
  for (std::size_t i = 0; i < examples.size(); ++i) {
    sides_.push_back(examples[i].street_sides);
    const Entry entry = entry_of(examples[i], i);
    if (options_.zones == ZonePolicy::kSame && !examples[i].zone.empty())
      trees_[{front_of(examples[i]), examples[i].zone}].push_back(entry);
    trees_[{front_of(examples[i]), kAllZones}].push_back(entry);
    trees_[{kAnyFront, kAllZones}].push_back(entry);
  }
  for (auto& [key, tree] : trees_) build(tree, 0, tree.size(), 0);
}

int ImageRetrieval::front_of(const ParcelShape& shape) const {
  return shape.street_sides ? front_class(*shape.street_sides, options_.mirroring) : kUnknownFront;
}

ImageRetrieval::Entry ImageRetrieval::entry_of(const ParcelShape& shape, std::size_t index) const {
  return {similarity::box_coordinates(shape.box, {options_.area_weight, options_.aspect_weight}),
          index};
}

void ImageRetrieval::build(Tree& tree, std::size_t begin, std::size_t end, int depth) {
  if (end - begin < 2) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return tree.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](const Entry& a, const Entry& b) {
    const double x = depth % 2 == 0 ? a.box.area : a.box.aspect;
    const double y = depth % 2 == 0 ? b.box.area : b.box.aspect;
    return x != y ? x < y : a.example < b.example;
  });
  build(tree, begin, middle, depth + 1);
  build(tree, middle + 1, end, depth + 1);
}

void ImageRetrieval::search(const Tree& tree, std::size_t begin, std::size_t end, int depth,
                            Query& query) {
  if (begin >= end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const Entry& root = tree[middle];
  if (root.example != query.excluded) {
    const Candidate candidate{squared_distance(query.at.box, root.box), root.example};
    auto& found = query.found;
    if (found.size() < query.count || candidate < found.back()) {
      found.insert(std::upper_bound(found.begin(), found.end(), candidate), candidate);
      if (found.size() > query.count) found.pop_back();
    }
  }
  const double d =
      depth % 2 == 0 ? query.at.box.area - root.box.area : query.at.box.aspect - root.box.aspect;
  const auto visit = [&](bool before) {
    if (before) {
      search(tree, begin, middle, depth + 1, query);
    } else {
      search(tree, middle + 1, end, depth + 1, query);
    }
  };
  visit(d < 0.0);
  // Equal distance across the cut still counts: the lower index wins.
  if (query.found.size() < query.count || d * d <= query.found.back().squared) visit(!(d < 0.0));
}

Symmetry ImageRetrieval::symmetry_of(std::size_t example, const ParcelShape& target) const {
  if (!sides_[example] || !target.street_sides) return Symmetry::kKept;
  return symmetry_between(*sides_[example], *target.street_sides, options_.mirroring)
      .value_or(Symmetry::kKept);
}

std::optional<Match> ImageRetrieval::nearest(const ParcelShape& target, Rng& rng,
                                             std::optional<std::size_t> excluded) const {
  const int front = front_of(target);
  const bool wants_zone = options_.zones == ZonePolicy::kSame && !target.zone.empty();
  const std::array<std::pair<Key, MatchLevel>, 3> wishes{
      {{{front, wants_zone ? target.zone : kAllZones}, MatchLevel::kFrontAndZone},
       {{front, kAllZones}, MatchLevel::kFront},
       {{kAnyFront, kAllZones}, MatchLevel::kAny}}};
  for (const auto& [key, level] : wishes) {
    const auto tree = trees_.find(key);
    if (tree == trees_.end()) continue;
    Query query{entry_of(target, 0), static_cast<std::size_t>(options_.variety), excluded, {}};
    search(tree->second, 0, tree->second.size(), 0, query);
    if (query.found.empty()) continue;
    const Candidate& chosen =
        query.found[query.found.size() == 1 ? 0 : rng.index(query.found.size())];
    return Match{chosen.example, std::sqrt(chosen.squared), level,
                 symmetry_of(chosen.example, target)};
  }
  return std::nullopt;
}

std::size_t drawn_source(double weight_01, Rng& rng) {
  return rng.uniform_01() < weight_01 ? 1 : 0;
}

}  // namespace plat::imagery
