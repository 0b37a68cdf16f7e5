#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "geodata/dataset_catalogue.h"
#include "streets/repair.h"
#include "streets/street_network.h"

namespace plat::harness {

/// The streets of an observed place, whether or not its plots are known.
struct ObservedStreets {
  geodata::LocalFrame frame;
  streets::StreetNetwork network;  ///< cleaned; every street has a width
  std::vector<Polygon> parcels;    ///< of a cadastre, on the working grid; empty where none is
  std::vector<streets::Repair> repairs;
};

/// Reads the street layer of a data set of the catalogue and cleans it. Where parcels are observed,
/// widths are measured between them and the frame is the parcels'.
/// @throws InputError for a data set without streets, one that is not in `folder`, and for files
///         that cannot be read
ObservedStreets load_streets(const geodata::Dataset& dataset, Jobs jobs = {},
                             const std::filesystem::path& folder = geodata::data_dir());

/// The layer that a mapping names. @param frame  to reproject into; chosen from the data if none
geodata::Layer read_mapped(const geodata::LayerMapping& mapping,
                           const std::filesystem::path& folder, geodata::GeometryKind kind,
                           const std::optional<geodata::LocalFrame>& frame);

/// The streets of a mapped layer, cleaned; widths are not assigned, parcels not read.
ObservedStreets read_streets(const geodata::LayerMapping& mapping,
                             const std::filesystem::path& folder,
                             const std::optional<geodata::LocalFrame>& frame);

/// What a mapping calls a field in the file; empty where it does not name it.
std::string mapped_field(const geodata::LayerMapping& mapping, std::string_view name);

}  // namespace plat::harness
