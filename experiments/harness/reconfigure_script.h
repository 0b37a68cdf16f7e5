#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/point.h"
#include "core/polygon.h"
#include "tiles/reconfiguration.h"

namespace plat::harness {

struct ScriptCircle {
  Point center;  ///< in the city's CRS
  double radius_m = 0.0;
};

/// Which tiles an operation is about: those that every given criterion names. Places are in the
/// city's CRS; a tile lies in an area where its centroid does.
struct ScriptTiles {
  std::string path;  ///< in the script, for messages
  std::vector<tiles::TileId> ids;
  std::vector<std::string> source_ids;
  std::vector<Point> points;  ///< tiles that hold one of them
  std::optional<Ring> area;   ///< of a polygon or a window
  std::optional<ScriptCircle> circle;
  std::optional<std::string> zone;
};

/// A rigid motion: a turn about a point, then a shift.
struct ScriptMotion {
  double angle_rad = 0.0;
  std::optional<Point> about;  ///< none: the centre of what is moved
  Point by;                    ///< metres east and north
  std::optional<Point> to;     ///< where the centre goes, instead of `by`
};

struct MoveStep {
  ScriptTiles tiles;
  ScriptMotion motion;
};
struct CopyStep {
  ScriptTiles tiles;
  std::string name;  ///< of the group that paste puts down
};
struct CutStep {
  ScriptTiles tiles;
  std::optional<std::string> name;  ///< cut tiles can be pasted
  tiles::VacatedLand land = tiles::VacatedLand::kVacant;
};
struct PasteStep {
  std::string name;
  ScriptMotion motion;
};
struct PinStep {
  ScriptTiles tiles;
};
struct UnpinStep {
  ScriptTiles tiles;
};
struct ReplaceStep {
  tiles::ReplacementOptions replacement;
};
struct RelaxStep {};
struct UndoStep {};
struct RedoStep {};

struct ReconfigureStep {
  std::string path;  ///< "operations[2]"
  std::string name;  ///< "paste"
  std::variant<MoveStep, CopyStep, CutStep, PasteStep, PinStep, UnpinStep, ReplaceStep, RelaxStep,
               UndoStep, RedoStep>
      what;
  tiles::ReconfigurationOptions options;
};

/// What plat reconfigure does, as written by a person (docs/reconfigure_script.md).
struct ReconfigureScript {
  std::string source;  ///< names the script in messages
  std::vector<ReconfigureStep> steps;
};

/// Every key, name, option and range is checked before anything runs; a group must have been copied
/// or cut before it is pasted.
/// @throws InputError with the path in the script: "city.json: operations[2].by: ..."
ReconfigureScript parse_reconfigure_script(const nlohmann::json& script, const std::string& source);
ReconfigureScript read_reconfigure_script(const std::string& file);

}  // namespace plat::harness
