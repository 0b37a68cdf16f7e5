#pragma once

#include <string>
#include <vector>

#include "geodata/layer.h"
#include "streets/raw_street.h"
#include "streets/repair.h"

namespace plat::streets {

/// Which field of a layer says what; empty where none does. Where a field is empty the
/// OpenStreetMap names are looked for ("name", "highway" or "class", "width", "lanes", "layer",
/// "bridge", "tunnel", "structure"), as fields or in an `other_tags` field
/// ("\"lanes\"=>\"2\",..."). A layer with a `highway` field holds other lines too (rivers, walls):
/// a feature without a value there is left out, by a row.
struct StreetFields {
  std::string name{};
  std::string street_class{};
  std::string width{};  ///< metres; "7.5", "7.5 m" or "24'" are understood
  std::string lanes{};
  std::string level{};      ///< whole number, 0 = ground
  std::string structure{};  ///< "bridge", "tunnel" or none
  /// Put before the value of `street_class`, to name numbers, e.g. "major_" for Cambridge's
  /// MajorRoad.
  std::string class_prefix{};
  std::string default_class{};  ///< where the class is missing, e.g. "local"
};

struct RawStreets {
  std::vector<RawStreet> streets;  ///< one per line of each feature
  std::vector<Repair> repairs;     ///< values that could not be read, features without a line
};

/// The lines of a layer as streets. @throws InputError for a layer that does not hold lines, or a
/// field named in `fields` that the layer has neither as a field nor `other_tags` to look for it
/// in.
RawStreets import_streets(const geodata::Layer& layer, const StreetFields& fields = {});

}  // namespace plat::streets
