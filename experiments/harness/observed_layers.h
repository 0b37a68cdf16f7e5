#pragma once

#include <string>
#include <vector>

#include "blocks/blocks_from_parcels.h"
#include "geodata/layer.h"

namespace plat::harness {

/// The value as text; empty where the feature has none.
std::string text_of(const geodata::Attribute& value);

/// One parcel per polygon of each feature. Its id is the value of `id_field` (the feature's id
/// where the field is not given or empty), with "#2", "#3", ... for further parts. A feature
/// without a polygon gives a parcel without points, which is refused later by its id.
/// @throws InputError for a layer that holds no polygons, or has no such field
std::vector<blocks::ObservedParcel> parcels_of(const geodata::Layer& layer,
                                               const std::string& id_field = {});

}  // namespace plat::harness
