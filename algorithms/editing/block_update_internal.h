#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "blocks/face_blocks.h"
#include "editing/change.h"
#include "editing/editor.h"
#include "editing/network_edit_internal.h"

namespace plat::editing::detail {

/// The boundary of a face as blocks_of_face() wants it, started where extract_blocks() starts it,
/// so that both give the same bytes. `network` gets the face's streets, `ids` their ids.
blocks::FaceBoundary boundary_of(const City& city, const Walk& face,
                                 streets::StreetNetwork& network, std::vector<StreetId>& ids);

/// The blocks of a face, their edges naming streets of the city.
blocks::FaceBlocks blocks_in(const City& city, WalkId face);

/// A block that is to be divided, with those whose parcels its own may take the place of.
struct Division {
  BlockId id;
  blocks::Block block;
  Style style;
  std::uint64_t seed = 0;
  std::vector<const CityBlock*> parents;
};

/// Brings blocks and parcels up to date: which blocks there are now, which of the old ones each
/// continues, and their division.
class BlockUpdate {
 public:
  explicit BlockUpdate(Change& change) : change_(change) {}

  void update_faces(const NetworkOutcome& outcome);
  void set_style(std::span<const BlockId> blocks, const Style& style);
  /// Blocks of a new city: `style_of` says how each is divided.
  void make(std::span<const WalkId> faces, const StyleOf& style_of);

  /// Divides what has to be, matches parcels, and says what became of blocks and parcels.
  EditReport finish(const std::map<StreetId, StreetId>& split_from = {});

 private:
  [[nodiscard]] const City& city() const { return change_.city(); }
  struct Found {
    WalkId face;
    blocks::Block block;
    std::optional<BlockId> id;
    std::vector<BlockId> parents;
  };
  void pair_by_overlap(std::vector<Found*>& open, std::set<BlockId> old);
  void file(Found found);

  Change& change_;
  std::vector<Division> divisions_;
  EditReport report_;
};

}  // namespace plat::editing::detail
