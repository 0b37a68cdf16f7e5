#include <algorithm>

#include "core/parallel.h"
#include "editing/block_update_internal.h"
#include "parcels/block_subdivider.h"
#include "parcels/coverage.h"
#include "parcels/overlap.h"

namespace plat::editing::detail {
namespace {

/// Less common area than this is rounding of the streets between blocks, not inheritance.
constexpr double kInherits_m2 = 1.0;

bool is_same(const blocks::Block& a, const blocks::Block& b) {
  return a.contour == b.contour && a.edges == b.edges;
}

/// A block's parcels, with the old parcel whose place each takes.
struct Divided {
  std::vector<parcels::Parcel> parcels;
  std::optional<Failure> failure;
  struct Claim {
    const CityBlock* block = nullptr;
    std::uint32_t parcel = 0;
    double distance = 0.0;
  };
  std::vector<std::optional<Claim>> claims;  ///< one per parcel
};

Divided divide(const Division& task) {
  Divided out;
  Rng rng(task.seed);
  auto parcels = parcels::block_subdividers()
                     .make(task.style.strategy, task.style.options)
                     .subdivide(task.block, rng);
  if (!parcels) {
    out.failure = std::move(parcels.error());
    return out;
  }
  out.failure =
      parcels::find_coverage_defect(task.block.contour, *parcels, parcels::kContourTolerance_m);
  if (!out.failure) out.parcels = *std::move(parcels);
  return out;
}

/// What each edge of the outer contour faces, a split-off street counting as the one it was.
std::vector<std::uint32_t> labels_of(const blocks::Block& block,
                                     const std::map<StreetId, StreetId>& split_from) {
  std::vector<std::uint32_t> labels;
  for (const blocks::BlockEdge& edge : block.edges.front()) {
    StreetId street = edge.street.value_or(StreetId{~0U});
    for (auto it = split_from.find(street); it != split_from.end(); it = split_from.find(street))
      street = it->second;
    labels.push_back(street.value);
  }
  return labels;
}

void match(const Division& task, const std::map<StreetId, StreetId>& split_from,
           parcels::ParcelMatching matching, Divided& divided) {
  divided.claims.resize(divided.parcels.size());
  const std::vector<std::uint32_t> labels = labels_of(task.block, split_from);
  const parcels::MatchedBlock after{task.block.contour.outer, labels, divided.parcels};
  std::vector<std::vector<std::uint32_t>> old_labels;
  for (const CityBlock* parent : task.parents) old_labels.push_back(labels_of(parent->block, {}));
  const auto before = [&](std::size_t p) {
    const CityBlock& parent = *task.parents[p];
    return parcels::MatchedBlock{parent.block.contour.outer, old_labels[p], parent.parcels};
  };
  // Relative distances and metres cannot be compared: one kind for all parents.
  for (std::size_t p = 0; p < task.parents.size() && task.parents.size() > 1; ++p) {
    if (matching == parcels::ParcelMatching::kRelativeDistances &&
        parcels::corresponding_corners(before(p), after).size() < parcels::kMinMatchedCorners)
      matching = parcels::ParcelMatching::kNearestCentroid;
  }
  for (std::size_t p = 0; p < task.parents.size(); ++p) {
    const CityBlock* parent = task.parents[p];
    const auto matches = parcels::match_parcels(matching, before(p), after);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      std::optional<Divided::Claim>& best = divided.claims[i];
      if (matches[i] && (!best || matches[i]->distance < best->distance))
        best = Divided::Claim{parent, matches[i]->predecessor, matches[i]->distance};
    }
  }
}

}  // namespace

void BlockUpdate::file(Found found) {
  const CityBlock* old = found.id ? city().blocks().find(*found.id) : nullptr;
  if (old && is_same(old->block, found.block)) return;
  Division task;
  task.id = found.id ? *found.id : change_.new_block();
  found.block.id = task.id;
  task.block = std::move(found.block);
  const CityBlock* heir = old;
  if (!heir && !found.parents.empty()) heir = &city().blocks().at(found.parents.front());
  task.style = heir ? heir->style : city().options().style;
  task.seed = old ? old->seed : derive_seed(city().options().seed, {task.id.value});
  if (old) task.parents.push_back(old);
  for (const BlockId parent : found.parents) {
    if (parent != task.id) task.parents.push_back(&city().blocks().at(parent));
  }
  (old ? report_.changed : report_.appeared).push_back(task.id);
  divisions_.push_back(std::move(task));
}

/// New blocks continue the old ones that they overlap most, one to one; the others inherit.
void BlockUpdate::pair_by_overlap(std::vector<Found*>& open, std::set<BlockId> old) {
  std::vector<parcels::Parcel> before;
  std::vector<parcels::Parcel> after;
  for (const BlockId id : old)
    before.push_back({ParcelId{id.value}, city().blocks().at(id).block.contour});
  for (const Found* found : open) after.push_back({ParcelId{}, found->block.contour});
  std::vector<parcels::Overlap> overlaps = parcels::find_overlaps(before, after);
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const auto& a, const auto& b) { return a.area_m2 > b.area_m2; });
  for (const parcels::Overlap& overlap : overlaps) {
    if (overlap.area_m2 < kInherits_m2) break;
    const BlockId id{before[overlap.first].id.value};
    Found& found = *open[overlap.second];
    found.parents.push_back(id);
    if (found.id || !old.contains(id)) continue;
    found.id = id;
    old.erase(id);
  }
  report_.vanished.insert(report_.vanished.end(), old.begin(), old.end());
}

void BlockUpdate::update_faces(const NetworkOutcome& outcome) {
  const std::vector<WalkId>& faces = outcome.faces;
  auto results =
      parallel_map<blocks::FaceBlocks>(faces.size(), city().options().jobs,
                                       [&](std::size_t i) { return blocks_in(city(), faces[i]); });
  std::vector<std::vector<Found>> found(faces.size());
  std::vector<Found*> open;
  std::set<BlockId> old(outcome.orphans.begin(), outcome.orphans.end());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::vector<BlockId>& before = city().walks().at(faces[i]).blocks;
    std::set<BlockId> left(before.begin(), before.end());
    for (blocks::Block& block : results[i].blocks)
      found[i].push_back({faces[i], std::move(block), {}, {}});
    const bool is_plain = before.size() == 1 && found[i].size() == 1;
    for (Found& each : found[i]) {
      for (const BlockId id : left) {
        if (!is_plain && !is_same(city().blocks().at(id).block, each.block)) continue;
        each.id = id;
        left.erase(id);
        break;
      }
      if (!each.id) open.push_back(&each);
    }
    old.insert(left.begin(), left.end());
  }
  if (!open.empty() || !old.empty()) pair_by_overlap(open, std::move(old));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Walk face = city().walks().at(faces[i]);
    face.refused = std::move(results[i].refused);
    std::vector<BlockId> ids;
    for (Found& each : found[i]) {
      const std::optional<BlockId> id = each.id;
      const std::size_t count = divisions_.size();
      file(std::move(each));
      ids.push_back(divisions_.size() > count ? divisions_.back().id : *id);
    }
    std::sort(ids.begin(), ids.end());
    face.blocks = std::move(ids);
    change_.set(faces[i], std::move(face));
  }
}

void BlockUpdate::set_style(std::span<const BlockId> blocks, const Style& style) {
  for (const BlockId id : blocks) {
    const CityBlock& old = city().blocks().at(id);
    if (old.style == style) continue;
    divisions_.push_back({id, old.block, style, old.seed, {&old}});
    report_.changed.push_back(id);
  }
}

EditReport BlockUpdate::finish(const std::map<StreetId, StreetId>& split_from) {
  const City& city = change_.city();
  const auto matching = city.options().matching;
  auto divided = parallel_map<Divided>(divisions_.size(), city.options().jobs, [&](std::size_t i) {
    if (city.tiles()) return Divided{};  // the tiles are the land
    Divided out = divide(divisions_[i]);
    match(divisions_[i], split_from, matching, out);
    return out;
  });
  // An old id goes to the parcel that is nearest to it.
  struct Best {
    double distance;
    std::size_t block;
    std::size_t parcel;
  };
  std::map<ParcelId, Best> heirs;
  for (std::size_t b = 0; b < divided.size(); ++b) {
    for (std::size_t i = 0; i < divided[b].parcels.size(); ++i) {
      const auto& claim = divided[b].claims[i];
      if (!claim) continue;
      const ParcelId id = claim->block->parcels[claim->parcel].id;
      const auto [it, is_first] = heirs.emplace(id, Best{claim->distance, b, i});
      if (!is_first && claim->distance < it->second.distance) it->second = {claim->distance, b, i};
    }
  }
  std::size_t old_parcels = 0;
  for (const auto* list : {&report_.changed, &report_.vanished}) {
    for (const BlockId id : *list) old_parcels += city.blocks().at(id).parcels.size();
  }
  std::vector<CityBlock> done;
  for (std::size_t b = 0; b < divided.size(); ++b) {
    Division& task = divisions_[b];
    CityBlock block{std::move(task.block),
                    std::move(task.style),
                    task.seed,
                    std::move(divided[b].parcels),
                    {},
                    std::move(divided[b].failure)};
    for (std::size_t i = 0; i < block.parcels.size(); ++i) {
      ParcelRecord record;
      std::optional<ParcelId> own;
      if (const auto& claim = divided[b].claims[i]) {
        record.predecessor = claim->block->parcels[claim->parcel].id;
        record.attributes = claim->block->records[claim->parcel].attributes;
        const Best& best = heirs.at(*record.predecessor);
        if (best.block == b && best.parcel == i) own = record.predecessor;
      }
      (own ? report_.parcels_kept : report_.parcels_new) += 1;
      block.parcels[i].id = own ? *own : change_.new_parcel();
      block.records.push_back(std::move(record));
    }
    done.push_back(std::move(block));
  }
  // Only now: until here divisions look at the blocks as they were.
  for (CityBlock& block : done) {
    const BlockId id = block.block.id;
    change_.set(id, std::move(block));
  }
  for (const BlockId id : report_.vanished) change_.erase(id);
  report_.parcels_lost = old_parcels - report_.parcels_kept;
  std::sort(report_.changed.begin(), report_.changed.end());
  std::sort(report_.appeared.begin(), report_.appeared.end());
  std::sort(report_.vanished.begin(), report_.vanished.end());
  return std::move(report_);
}

void BlockUpdate::make(std::span<const WalkId> faces, const StyleOf& style_of) {
  NetworkOutcome all;
  all.faces.assign(faces.begin(), faces.end());
  update_faces(all);
  if (!style_of) return;
  for (Division& task : divisions_) {
    if (auto style = style_of(task.block)) task.style = *std::move(style);
  }
}

}  // namespace plat::editing::detail
