#pragma once

#include <optional>
#include <vector>

#include "core/failure.h"
#include "editing/change.h"
#include "editing/edit.h"

namespace plat::editing {

/// What an edit did. Lists are sorted.
struct EditReport {
  std::vector<BlockId> changed;   ///< blocks whose contour, edge labels, style or parcels differ
  std::vector<BlockId> appeared;  ///< new blocks
  std::vector<BlockId> vanished;
  std::size_t parcels_kept = 0;  ///< of the blocks above: parcels that keep their id
  std::size_t parcels_new = 0;   ///< parcels with a new id
  std::size_t parcels_lost = 0;  ///< ids that are gone
  std::optional<tiles::ReconfigurationReport> tiles;  ///< of every edit of tiles but PinTiles
  std::size_t nodes_moved = 0;                        ///< by an edit of tiles
  std::size_t streets_resized = 0;                    ///< by an edit of tiles
  /// Of these, whose fronts leave less than kMinStreetWidth_m: they stand in the street.
  std::size_t streets_too_narrow = 0;
};

/// Applies edits to a city, with undo and redo of any length.
///
/// Guarantees: 1. an edit that fails leaves the city as it is;  2. the report names exactly the
/// blocks that differ: only they are divided again, everything else is bit-identical;  3. after any
/// edit the blocks are those that extract_blocks() finds in the network;  4. undo and redo restore
/// the same bytes, by putting records back;  5. an edit of streets leaves tiles as they are, an
/// edit of tiles moves the streets beside them (street_following.h).
///
/// Failures: kUnknownEntity; kOutOfRange; kStreetCollapsed; kStreetsCross; kFaceInverted (a face
/// turned inside out, or a street jumped over another); kTilesOverlap, kNoPlace and those of
/// tiles/reconfiguration.h. A block that cannot be divided is no failure of the edit: it is a block
/// with a failure.
///
/// Paper: [VKW12, Sec. 3.2 and 5].
///
/// Deviation: moving never makes nodes, a crossing is refused (ADR 0012).
///
/// @throws InputError where a style names no strategy, or options it does not have
class Editor {
 public:
  explicit Editor(City city) : city_(std::move(city)) {}

  [[nodiscard]] const City& city() const { return city_; }

  Expected<EditReport> apply(const Edit& edit);

  [[nodiscard]] std::size_t undo_count() const { return done_.size(); }
  [[nodiscard]] std::size_t redo_count() const { return undone_.size(); }
  /// Pre: undo_count() > 0.
  void undo();
  /// Pre: redo_count() > 0.
  void redo();

 private:
  City city_;
  std::vector<Delta> done_;
  std::vector<Delta> undone_;
};

}  // namespace plat::editing
