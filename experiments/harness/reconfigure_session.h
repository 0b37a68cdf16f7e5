#pragma once

#include <map>
#include <optional>
#include <string>

#include "editing/editor.h"
#include "geodata/layer.h"
#include "harness/city_file.h"
#include "harness/reconfigure_script.h"

namespace plat::harness {

/// What one step of a script did.
struct StepReport {
  std::size_t named = 0;  ///< tiles that the step names
  editing::EditReport edit;
  /// Errors of the layout before the step, measured as those after it (edit.tiles).
  std::optional<tiles::LayoutSolution> before;
};

/// A city under reconfiguration, with the groups of tiles that can be pasted.
///
/// Guarantees: a step that fails changes nothing, groups included.
class ReconfigureSession {
 public:
  explicit ReconfigureSession(PlacedCity placed)
      : editor_(std::move(placed.city)), frame_(placed.frame) {}

  [[nodiscard]] const editing::City& city() const { return editor_.city(); }
  [[nodiscard]] const geodata::LocalFrame& frame() const { return frame_; }

  /// Failures: those of Editor::apply(); kUnknownEntity where no tile is selected, or there is
  /// nothing to undo or redo.
  Expected<StepReport> run(const ReconfigureStep& step);

 private:
  class Runner;

  editing::Editor editor_;
  geodata::LocalFrame frame_;
  std::map<std::string, std::shared_ptr<const tiles::TileGroup>> groups_;
};

/// The tiles that a selection names, by id, each once.
/// Failures: kUnknownEntity where it names an id that no tile has, or selects nothing.
Expected<std::vector<tiles::TileId>> selected_tiles(const ScriptTiles& selection,
                                                    const tiles::TileLayout& layout,
                                                    const geodata::LocalFrame& frame);

}  // namespace plat::harness
