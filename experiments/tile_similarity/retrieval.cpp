#include "tile_similarity/retrieval.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "core/rng.h"
#include "similarity/prepared_shapes.h"
#include "tile_similarity/perturbation.h"

namespace plat::tile_similarity {
namespace {

using similarity::AnyPreparedShape;
using similarity::AnyShapeSimilarity;
using similarity::LabelledShape;
using similarity::PreparedShapes;

struct Ranked {
  double distance = 0.0;
  bool is_relevant = false;
};

QueryPrecision precision_of(std::vector<Ranked> candidates) {
  const auto relevant = std::ranges::count_if(candidates, &Ranked::is_relevant);
  if (relevant == 0) return {};
  std::ranges::stable_sort(candidates, {}, &Ranked::distance);
  const auto share = [&](std::size_t first) {
    const std::size_t n = std::min(first, candidates.size());
    return static_cast<double>(std::ranges::count_if(
               candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(n),
               &Ranked::is_relevant)) /
           static_cast<double>(n);
  };
  return {share(1), share(10),
          static_cast<double>(relevant) / static_cast<double>(candidates.size())};
}

/// What all tasks of a place and a measure share.
struct Session {
  const TileGallery& gallery;
  const AnyShapeSimilarity& measure;
  const SimilarityConfig& config;
  const std::string& place;
  PreparedShapes prepared;
  Jobs jobs;

  /// The gallery without the query itself.
  template <class IsRelevant>
  [[nodiscard]] std::vector<Ranked> others(std::size_t q, const std::vector<double>& distances,
                                           IsRelevant is_relevant) const {
    std::vector<Ranked> out;
    for (std::uint32_t i = 0; i < gallery.shapes.size(); ++i) {
      if (i != gallery.queries[q] && prepared.shapes[i])
        out.push_back({distances[i], is_relevant(i)});
    }
    return out;
  }
};

std::vector<std::vector<double>> all_distances(const Session& session) {
  const auto& [gallery, measure, config, place, prepared, jobs] = session;
  std::vector<std::vector<double>> out(gallery.queries.size());
  parallel_for(gallery.queries.size(), jobs, [&](std::size_t q) {
    const auto& query = session.prepared.shapes[session.gallery.queries[q]];
    if (!query) return;
    out[q].resize(session.gallery.shapes.size(), 0.0);
    for (std::size_t i = 0; i < out[q].size(); ++i) {
      if (session.prepared.shapes[i])
        out[q][i] = session.measure.distance(*session.prepared.shapes[i], *query);
    }
  });
  return out;
}

template <class IsRelevant>
TaskResult gallery_task(const Session& session, std::string name,
                        const std::vector<std::vector<double>>& distances, IsRelevant is_relevant) {
  TaskResult out{std::move(name), {}, 0};
  for (std::size_t q = 0; q < distances.size(); ++q) {
    if (distances[q].empty()) {
      out.queries.push_back({});
      continue;
    }
    const std::uint32_t query = session.gallery.queries[q];
    out.queries.push_back(precision_of(
        session.others(q, distances[q], [&](std::uint32_t i) { return is_relevant(i, query); })));
  }
  return out;
}

/// The copies among the gallery; among equal distances the gallery comes first.
TaskResult copies_task(const Session& session, const Perturbation& how,
                       const std::vector<std::vector<double>>& distances) {
  TaskResult out{"copies_" + std::string(how.name), {}, 0};
  out.queries.resize(distances.size());
  std::vector<std::size_t> failures(distances.size(), 0);
  parallel_for(distances.size(), session.jobs, [&](std::size_t q) {
    if (distances[q].empty()) return;
    const std::uint32_t query = session.gallery.queries[q];
    Rng rng(derive_seed(session.config.seed, {seed_key(session.place), seed_key(how.name), query}));
    std::vector<Ranked> candidates =
        session.others(q, distances[q], [](std::uint32_t) { return false; });
    for (int copy = 0; copy < session.config.copies; ++copy) {
      const auto shape = perturbed(session.gallery.shapes[query], how, rng);
      const auto prepared = shape ? session.measure.prepare(*shape)
                                  : fail(FailureCode::kNotSimple, "no valid copy was drawn");
      if (!prepared) {
        ++failures[q];
        continue;
      }
      candidates.push_back(
          {session.measure.distance(*prepared, *session.prepared.shapes[query]), true});
    }
    out.queries[q] = precision_of(std::move(candidates));
  });
  out.failures = std::accumulate(failures.begin(), failures.end(), std::size_t{0});
  return out;
}

double microseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
      .count();
}

constexpr int kRounds = 5;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

MeasureResult run_retrieval(const TileGallery& gallery, const AnyShapeSimilarity& measure,
                            const SimilarityConfig& config, const std::string& place, Jobs jobs) {
  const Session session{
      gallery, measure, config, place, similarity::prepare_all(gallery.shapes, measure, jobs),
      jobs};
  MeasureResult out{
      std::string(measure.name()), {}, all_distances(session), session.prepared.failures.size()};
  const auto zone = [&](std::uint32_t i) -> const std::string& { return gallery.shapes[i].zone; };
  out.tasks.push_back(gallery_task(
      session, "same_zone", out.distances,
      [&](std::uint32_t i, std::uint32_t q) { return !zone(q).empty() && zone(i) == zone(q); }));
  out.tasks.push_back(gallery_task(
      session, "same_block", out.distances,
      [&](std::uint32_t i, std::uint32_t q) { return gallery.blocks[i] == gallery.blocks[q]; }));
  for (const Perturbation& how : perturbations())
    out.tasks.push_back(copies_task(session, how, out.distances));
  return out;
}

PairTime time_pairs(const TileGallery& gallery, const AnyShapeSimilarity& measure,
                    const SimilarityConfig& config, const std::string& place) {
  Rng rng(derive_seed(config.seed, {seed_key(place), seed_key("time")}));
  const PreparedShapes prepared = similarity::prepare_all(gallery.shapes, measure, Jobs{1});
  std::vector<std::pair<const AnyPreparedShape*, const AnyPreparedShape*>> pairs;
  for (int tries = 0; tries < config.timed_pairs; ++tries) {
    const auto& a = prepared.shapes[rng.index(prepared.shapes.size())];
    const auto& b = prepared.shapes[rng.index(prepared.shapes.size())];
    if (a && b) pairs.emplace_back(&*a, &*b);
  }
  PairTime out;
  out.pairs = pairs.size();
  if (pairs.empty()) return out;
  std::vector<double> pair_us;
  std::vector<double> prepare_us;
  double sum = 0.0;  // used below, so that nothing is optimised away
  for (int round = 0; round < kRounds; ++round) {
    auto start = std::chrono::steady_clock::now();
    for (const auto& [a, b] : pairs) sum += measure.distance(*a, *b);
    pair_us.push_back(microseconds_since(start) / static_cast<double>(pairs.size()));
    start = std::chrono::steady_clock::now();
    for (const LabelledShape& shape : gallery.shapes) sum += measure.prepare(shape) ? 1.0 : 0.0;
    prepare_us.push_back(microseconds_since(start) / static_cast<double>(gallery.shapes.size()));
  }
  expects(sum >= 0.0, "distances are not negative");
  out.pair_us = median(pair_us);
  out.prepare_us = median(prepare_us);
  return out;
}

}  // namespace plat::tile_similarity
