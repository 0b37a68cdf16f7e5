#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/box.h"
#include "core/options.h"
#include "core/parallel.h"
#include "geodata/layer.h"
#include "streets/exemplar.h"
#include "streets/repair.h"
#include "streets/street_import.h"
#include "streets/street_network.h"

namespace plat::harness {

/// Which city to take an exemplar from, and how.
struct ExemplarSource {
  std::string city;                ///< data set of the catalogue, or centrelines "FILE[:layer]"
  std::string parcels;             ///< "FILE[:layer]"; may be empty; a data set brings its own
  streets::StreetFields fields{};  ///< of a file; a data set brings its own
  bool has_all_classes = false;    ///< paths, service roads and rails are streets too
  /// Streets that are not wholly inside are left out; in the projected CRS, metres.
  std::optional<Box> window{};
  streets::ExemplarOptions options{};
};

/// A network with the exemplar that was taken from it.
struct ObservedExemplar {
  geodata::LocalFrame frame;
  streets::StreetNetwork network;
  streets::Exemplar exemplar;
  std::vector<streets::Repair> repairs;
  std::size_t parcel_count = 0;
};

/// Reads and cleans the streets, gives them widths, and takes the exemplar.
/// @throws InputError for files that cannot be read, and where no street is left
ObservedExemplar read_exemplar(const ExemplarSource& source, Jobs jobs = {});

/// Options of chains, hierarchy and surroundings from one map.
/// @throws InputError for an unknown key or a value out of range
streets::ExemplarOptions exemplar_options(const OptionMap& map);

/// Every option of exemplar_options(), for help.
std::vector<FieldDescription> exemplar_option_fields();

/// The layers that `plat exemplar` writes: points (docs/intersection_points.md, with the numbers of
/// their chains), streets (pieces, with chain and hierarchy) and chains (whole streets, with their
/// style).
std::vector<geodata::Layer> exemplar_layers(const ObservedExemplar& observed);

}  // namespace plat::harness
