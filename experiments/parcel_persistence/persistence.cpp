#include "parcel_persistence/persistence.h"

#include <map>

#include "parcel_persistence/warp.h"
#include "parcels/overlap.h"

namespace plat::persistence {
namespace {

using parcels::MatchedBlock;
using parcels::Parcel;

std::vector<std::uint32_t> labels_of(const blocks::Block& block) {
  std::vector<std::uint32_t> out;
  for (const blocks::BlockEdge& edge : block.edges.front())
    out.push_back(edge.street.value_or(StreetId{~0U}).value);
  return out;
}

/// Where the old parcels would lie, had they been carried along with their block.
struct Oracle {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> ious;  ///< of (old, new)
  std::map<std::uint32_t, std::uint32_t> place;  ///< new to the old one that it lies on most
};

Oracle oracle_of(std::span<const Parcel> warped, std::span<const Parcel> now) {
  Oracle out;
  std::map<std::uint32_t, double> most_m2;
  for (const parcels::Overlap& overlap : parcels::find_overlaps(warped, now)) {
    const double both = area_m2(warped[overlap.first].shape) + area_m2(now[overlap.second].shape);
    out.ious[{overlap.first, overlap.second}] = overlap.area_m2 / (both - overlap.area_m2);
    double& most = most_m2[overlap.second];
    if (overlap.area_m2 <= most) continue;
    most = overlap.area_m2;
    out.place[overlap.second] = overlap.first;
  }
  return out;
}

Persistence measured(const std::vector<std::optional<parcels::ParcelMatch>>& matches,
                     std::size_t old_count, const Oracle& oracle) {
  Persistence out;
  out.old_parcels = static_cast<double>(old_count);
  out.new_parcels = static_cast<double>(matches.size());
  // As in an edit: of the new parcels that match an old one, the nearest has its id.
  std::map<std::uint32_t, std::uint32_t> heir;
  for (std::uint32_t i = 0; i < matches.size(); ++i) {
    if (!matches[i]) continue;
    const auto [it, is_first] = heir.emplace(matches[i]->predecessor, i);
    if (!is_first && matches[i]->distance < matches[it->second]->distance) it->second = i;
    const auto iou = oracle.ious.find({matches[i]->predecessor, i});
    if (iou != oracle.ious.end()) out.iou += iou->second;
    const auto place = oracle.place.find(i);
    if (place != oracle.place.end() && place->second == matches[i]->predecessor)
      out.transferred += 1.0;
  }
  out.kept = static_cast<double>(heir.size());
  for (const auto& [pair, iou] : oracle.ious) {
    if (iou <= kSameParcel_iou) continue;
    out.survivors += 1.0;
    const auto it = heir.find(pair.first);
    if (it != heir.end() && it->second == pair.second) out.recognised += 1.0;
  }
  return out;
}

}  // namespace

Persistence& Persistence::operator+=(const Persistence& other) {
  old_parcels += other.old_parcels;
  new_parcels += other.new_parcels;
  survivors += other.survivors;
  recognised += other.recognised;
  kept += other.kept;
  transferred += other.transferred;
  iou += other.iou;
  return *this;
}

std::optional<std::array<Persistence, kMatchings.size()>> persistence_of(
    const editing::CityBlock& before, const editing::CityBlock& after) {
  if (before.failure || after.failure) return std::nullopt;
  const std::vector<std::uint32_t> old_labels = labels_of(before.block);
  const std::vector<std::uint32_t> new_labels = labels_of(after.block);
  const MatchedBlock old_block{before.block.contour.outer, old_labels, before.parcels};
  const MatchedBlock new_block{after.block.contour.outer, new_labels, after.parcels};
  const auto corners = parcels::corresponding_corners(old_block, new_block);
  if (corners.size() < parcels::kMinMatchedCorners) return std::nullopt;
  const MeanValueWarp warp(corners);
  std::vector<Parcel> warped;
  for (const Parcel& parcel : before.parcels) warped.push_back({parcel.id, warp(parcel.shape)});
  const Oracle oracle = oracle_of(warped, after.parcels);
  std::array<Persistence, kMatchings.size()> out;
  for (std::size_t m = 0; m < kMatchings.size(); ++m) {
    out[m] = measured(parcels::match_parcels(kMatchings[m], old_block, new_block),
                      before.parcels.size(), oracle);
  }
  return out;
}

}  // namespace plat::persistence
