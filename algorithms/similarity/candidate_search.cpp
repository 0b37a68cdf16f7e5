#include "similarity/candidate_search.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace plat::similarity {

struct CandidateSearch::Query {
  AnyPreparedShape place;
  std::optional<std::string> zone;      // none: any
  std::vector<std::uint32_t> excluded;  // sorted
};

CandidateSearch::CandidateSearch(std::span<const LabelledShape> shapes, const Clusters& clusters,
                                 AnyShapeSimilarity measure, Jobs jobs)
    : measure_(std::move(measure)),
      prepared_(prepare_all(shapes, measure_, jobs)),
      members_(clusters.members.size()) {
  expects(clusters.cluster_of.size() == shapes.size(), "a cluster per shape");
  for (const LabelledShape& shape : shapes) zones_.push_back(shape.zone);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    for (const std::uint32_t i : clusters.members[k]) {
      if (prepared_.shapes[i]) members_[k].push_back(i);
    }
  }
}

bool CandidateSearch::is_allowed(std::uint32_t shape, const Query& query) const {
  return (!query.zone || zones_[shape] == *query.zone) &&
         !std::binary_search(query.excluded.begin(), query.excluded.end(), shape);
}

Expected<std::vector<Candidate>> CandidateSearch::most_similar(
    const LabelledShape& place, const CandidateOptions& options,
    std::span<const std::uint32_t> excluded) const {
  auto prepared = measure_.prepare(place);
  if (!prepared) return tl::unexpected(std::move(prepared.error()));
  Query query{std::move(*prepared), std::nullopt, {excluded.begin(), excluded.end()}};
  std::sort(query.excluded.begin(), query.excluded.end());
  if (options.zones == ZoneRule::kSame && !place.zone.empty()) query.zone = place.zone;

  const auto distance_to = [&](std::uint32_t shape) {
    return measure_.distance(*prepared_.shapes[shape], query.place);
  };
  std::vector<Candidate> order;  // clusters, by their representatives
  for (std::uint32_t k = 0; k < members_.size(); ++k) {
    const auto& members = members_[k];
    if (std::any_of(members.begin(), members.end(),
                    [&](std::uint32_t i) { return is_allowed(i, query); }))
      order.push_back({k, distance_to(members.front())});
  }
  std::sort(order.begin(), order.end(), is_nearer);

  const auto wanted = static_cast<std::size_t>(options.count);
  std::vector<Candidate> found;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    if (rank >= static_cast<std::size_t>(options.clusters) && found.size() >= wanted) break;
    for (const std::uint32_t i : members_[order[rank].shape]) {
      if (is_allowed(i, query)) found.push_back({i, distance_to(i)});
    }
  }
  std::sort(found.begin(), found.end(), is_nearer);
  if (found.size() > wanted) found.resize(wanted);
  return found;
}

}  // namespace plat::similarity
