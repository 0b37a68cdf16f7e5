#pragma once

#include <filesystem>
#include <string>

#include "buildings/mesh.h"

namespace plat::buildings {

/// Whether write_building() knows the file's ending.
bool is_building_file(const std::filesystem::path& file);

/// Writes a mesh with its materials, by the file's ending, to a part file that is renamed when it
/// is whole:
///   .obj  z up, materials in a .mtl beside it
///   .ply  z up, binary, a colour per face
///   .glb  glTF 2.0, binary, y up as the format asks; a primitive per material; the node moves the
///         building from its own origin to its place, so that single precision is enough
/// Same mesh, same bytes.
/// @throws InputError with the file and the reason
void write_building(const std::filesystem::path& file, const Mesh& mesh, const std::string& name);

}  // namespace plat::buildings
