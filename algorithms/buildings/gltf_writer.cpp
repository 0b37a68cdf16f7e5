#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include "buildings/gltf_writer_internal.h"
#include "core/failure.h"

namespace plat::buildings::detail {
namespace {

template <class T>
void append_bytes(std::vector<unsigned char>& data, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
  data.insert(data.end(), bytes.begin(), bytes.end());
}

/// The middle of the footprint in whole metres: what single precision need not hold.
Point3 origin_of(const Mesh& mesh) {
  const auto [west, east] = std::ranges::minmax(mesh.vertices, {}, &Point3::x);
  const auto [south, north] = std::ranges::minmax(mesh.vertices, {}, &Point3::y);
  return {std::round(0.5 * (west.x + east.x)), std::round(0.5 * (south.y + north.y)), 0.0};
}

/// sRGB to the linear colours of glTF.
double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Appends a view and an accessor over the last `length` bytes of the buffer.
int add_accessor(tinygltf::Model& model, std::size_t length, int target, int component, int type,
                 std::size_t count) {
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = model.buffers[0].data.size() - length;
  view.byteLength = length;
  view.target = target;
  model.bufferViews.push_back(view);
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size() - 1);
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size() - 1);
}

int add_positions(tinygltf::Model& model, const Mesh& mesh, Point3 origin) {
  constexpr double kFar = std::numeric_limits<double>::max();
  std::vector<double> low(3, kFar);
  std::vector<double> high(3, -kFar);
  for (const Point3& vertex : mesh.vertices) {
    const Point3 v = vertex - origin;
    const std::array<double, 3> y_up{v.x, v.z, -v.y};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto coordinate = static_cast<float>(y_up[i]);
      append_bytes(model.buffers[0].data, coordinate);
      low[i] = std::min(low[i], double{coordinate});
      high[i] = std::max(high[i], double{coordinate});
    }
  }
  const int accessor =
      add_accessor(model, 12 * mesh.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER,
                   TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, mesh.vertices.size());
  model.accessors.back().minValues = low;
  model.accessors.back().maxValues = high;
  return accessor;
}

void add_primitives(tinygltf::Model& model, const Mesh& mesh, int positions) {
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    std::size_t count = 0;
    for (const Face& face : mesh.faces) {
      if (face.material != m) continue;
      for (const std::uint32_t vertex : face.vertices) append_bytes(model.buffers[0].data, vertex);
      count += 3;
    }
    if (count == 0) continue;
    tinygltf::Material material;
    material.name = mesh.materials[m].name;
    material.pbrMetallicRoughness.baseColorFactor = {linear(mesh.materials[m].rgb[0]),
                                                     linear(mesh.materials[m].rgb[1]),
                                                     linear(mesh.materials[m].rgb[2]), 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    model.materials.push_back(material);
    tinygltf::Primitive primitive;
    primitive.attributes["POSITION"] = positions;
    primitive.indices =
        add_accessor(model, 4 * count, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, count);
    primitive.material = static_cast<int>(model.materials.size() - 1);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    model.meshes[0].primitives.push_back(primitive);
  }
}

}  // namespace

std::string glb_of(const Mesh& mesh, const std::string& name) {
  expects(!mesh.vertices.empty() && !mesh.faces.empty(), "a mesh with faces");
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "Plat";
  model.buffers.emplace_back();
  model.meshes.emplace_back();
  model.meshes[0].name = name;
  const Point3 origin = origin_of(mesh);
  add_primitives(model, mesh, add_positions(model, mesh, origin));
  tinygltf::Node node;
  node.name = name;
  node.mesh = 0;
  node.translation = {origin.x, 0.0, -origin.y};
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, stream, false, true))
    throw LogicError("tinygltf could not write the building");
  return stream.str();
}

}  // namespace plat::buildings::detail
