#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tiles/reconfiguration_internal.h"
#include "tiles/tile_destination_internal.h"
#include "tiles/tile_substitution_internal.h"

namespace plat::tiles {
namespace {

/// A group that is put down piece by piece.
class Paste {
 public:
  Paste(const TileLayout& layout, const ReconfigurationOptions& options)
      : layout_(layout), measure_(detail::measure_of(options)) {}

  std::optional<Failure> put_down(const detail::Piece& piece, const Affine& to);
  /// Links between pieces.
  void link(const TileLayout& group);

  [[nodiscard]] const TileLayout& layout() const { return layout_; }
  [[nodiscard]] std::vector<std::uint32_t> pasted() const;
  [[nodiscard]] const std::vector<Box>& around() const { return around_; }

 private:
  TileLayout layout_;
  similarity::AnyShapeSimilarity measure_;
  std::map<std::uint32_t, TileId> id_of_;  ///< per tile of the group
  std::map<std::uint32_t, std::size_t> piece_of_;
  std::vector<TileId> ids_;  ///< of pasted tiles, ascending
  std::vector<Box> around_;
  std::size_t pieces_ = 0;
};

std::optional<Failure> Paste::put_down(const detail::Piece& piece, const Affine& to) {
  auto destination = detail::find_destination(layout_, piece, to, measure_, ids_);
  if (!destination) return destination.error();
  for (const Box& box : detail::boxes_of(layout_, destination->replaced, {}))
    around_.push_back(box);
  auto result = detail::substituted(layout_, {.piece = &piece.layout,
                                              .replaced = std::move(destination->replaced),
                                              .comparison = std::move(destination->comparison),
                                              .as_placed = to});
  if (!result) return result.error();
  layout_ = std::move(result->layout);
  for (std::size_t k = 0; k < result->tiles.size(); ++k) {
    const Tile& tile = layout_.tiles[result->tiles[k]];
    id_of_.emplace(piece.members[k], tile.id);
    piece_of_.emplace(piece.members[k], pieces_);
    ids_.push_back(tile.id);
  }
  ++pieces_;
  return std::nullopt;
}

void Paste::link(const TileLayout& group) {
  for (StreetLink link : group.links) {
    if (piece_of_.at(link.a) == piece_of_.at(link.b)) continue;  // came with the piece
    link.a = *find_tile(layout_, id_of_.at(link.a));
    link.b = *find_tile(layout_, id_of_.at(link.b));
    layout_.links.push_back(link);
  }
}

std::vector<std::uint32_t> Paste::pasted() const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < layout_.tiles.size(); ++i) {
    if (std::ranges::binary_search(ids_, layout_.tiles[i].id)) out.push_back(i);
  }
  return out;
}

}  // namespace

Expected<Reconfiguration> paste_tiles(const TileLayout& layout, const TileGroup& group,
                                      const Affine& to, const ReconfigurationOptions& options) {
  if (group.tiles.tiles.empty())
    return fail(FailureCode::kUnknownEntity, "there is no tile to paste");
  if (!to.is_finite() || to.determinant() <= 0.0)
    return fail(FailureCode::kOutOfRange,
                fmt::format("a place with determinant {}: it must be finite and above 0",
                            to.determinant()));
  const auto pieces = detail::pieces_of(group);
  if (!pieces) return tl::unexpected(pieces.error());
  Paste paste(layout, options);
  for (const detail::Piece& piece : *pieces) {
    if (auto failure = paste.put_down(piece, to)) return tl::unexpected(*std::move(failure));
  }
  paste.link(group.tiles);

  const TileLayout& changed = paste.layout();
  detail::Targets targets;
  const std::vector<std::uint32_t> pasted = paste.pasted();
  for (const std::uint32_t i : pasted) targets.emplace(i, changed.tiles[i].placement);
  std::vector<Box> around = paste.around();
  for (const Box& box : detail::boxes_of(changed, pasted, targets)) around.push_back(box);
  detail::Targets held = detail::held_tiles(changed, {}, around, options.reach_m);
  if (options.pasted == PastedTiles::kHeld) held.merge(targets);
  held = detail::held_or_farthest(changed, std::move(held), around);
  return detail::reconfigured(layout, changed, held, options);
}

}  // namespace plat::tiles
