#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/options.h"
#include "core/polygon.h"
#include "geodata/layer_io.h"
#include "streets/exemplar.h"
#include "streets/street_import.h"
#include "synthesis/city_expansion.h"
#include "synthesis/point_blend.h"
#include "synthesis/point_placement.h"

namespace plat::harness {

/// A place of a script: metres in a CRS, or metres east and north of the layout's anchor.
struct ScriptPlace {
  Point value;
  bool is_offset = false;
};

/// An area of a script: a ring of places, or the polygons of a layer.
struct ScriptRegion {
  std::string path;  ///< in the script, for messages: "boundary"
  std::vector<ScriptPlace> ring;
  std::optional<geodata::LayerSource> layer;
};

/// Where streets, or points that were taken from streets, come from. One of `dataset`, `streets`
/// and `points` is given.
struct ScriptSource {
  std::string path;
  std::optional<std::string> dataset;
  std::optional<geodata::LayerSource> streets;
  std::optional<geodata::LayerSource> parcels;  ///< beside `streets`
  std::optional<geodata::LayerSource> points;   ///< as plat exemplar writes them
  streets::StreetFields fields;
  std::optional<ScriptRegion> region;  ///< what lies in it; all where none is given
  streets::ExemplarOptions exemplar;
};

struct ScriptExample {
  std::string name;
  ScriptSource source;
};

/// A copy of an example's points.
struct ScriptCopy {
  std::string path;
  std::size_t example = 0;        ///< of SynthesisScript::examples
  std::optional<ScriptPlace> at;  ///< of the copy's centre; none: where the example lies
  synthesis::Mirroring mirroring = synthesis::Mirroring::kNone;
  double scale = 1.0;
  double rotation_rad = 0.0;
};

/// `place` and `join`: copies side by side.
struct JoinOperation {
  std::vector<ScriptCopy> copies;
  synthesis::Spacing spacing;
};

/// The ramp across the overlap of the copies.
struct AcrossOverlap {};
struct ScriptRamp {
  ScriptPlace from;  ///< here the style of the first
  ScriptPlace to;    ///< here that of the second
};
struct BlendOperation {
  ScriptCopy first;
  ScriptCopy second;
  std::variant<AcrossOverlap, double, ScriptRamp> weight;
  synthesis::BlendOptions options;
};

struct ExpandOperation {
  ScriptCopy copy;
  synthesis::ExpansionOptions options;
};

/// One step: points are added to those of the steps before.
struct ScriptOperation {
  std::string path;  ///< "operations[2]"
  std::string name;  ///< "blend"
  std::variant<JoinOperation, BlendOperation, ExpandOperation> what;
  std::optional<ScriptRegion> region;  ///< points outside are left out
};

struct StrategyChoice {
  std::string name;
  OptionMap options;
};

/// What plat synthesize does, as written by a person (docs/synthesis_script.md).
struct SynthesisScript {
  std::string source;  ///< names the script in messages
  std::uint64_t seed = 1;
  std::vector<ScriptExample> examples;
  std::optional<ScriptSource> city;  ///< whose streets stay
  std::vector<ScriptOperation> operations;
  std::optional<ScriptRegion> boundary;
  std::vector<ScriptRegion> obstacles;
  std::optional<StrategyChoice> grower;
  std::optional<StrategyChoice> subdivider;
};

/// Every key, name, option and range is checked before anything is read.
/// @throws InputError with the path in the script: "city.json: operations[2].weight: ..."
SynthesisScript parse_synthesis_script(const nlohmann::json& script, const std::string& source);
SynthesisScript read_synthesis_script(const std::string& file);

}  // namespace plat::harness
