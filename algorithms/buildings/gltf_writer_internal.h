#pragma once

#include <string>

#include "buildings/mesh.h"

namespace plat::buildings::detail {

/// The bytes of a .glb; see write_building().
std::string glb_of(const Mesh& mesh, const std::string& name);

}  // namespace plat::buildings::detail
