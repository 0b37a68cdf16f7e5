#include "buildings/building_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <string_view>

#include "buildings/gltf_writer_internal.h"
#include "core/failure.h"

namespace plat::buildings {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kEndings{".obj", ".ply", ".glb"};

void write_text(const fs::path& file, std::string_view text) {
  fs::path part = file;
  part += ".part";
  std::ofstream stream(part, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  std::error_code error;
  if (stream) fs::rename(part, file, error);
  if (!stream || error) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

std::string mtl_of(const Mesh& mesh) {
  std::string text;
  for (const Material& material : mesh.materials) {
    text += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nKs 0 0 0\nillum 1\n", material.name,
                        material.rgb[0] / 255.0, material.rgb[1] / 255.0, material.rgb[2] / 255.0);
  }
  return text;
}

std::string obj_of(const Mesh& mesh, const std::string& materials, const std::string& name) {
  std::string text = fmt::format("mtllib {}\no {}\n", materials, name.empty() ? "building" : name);
  auto out = std::back_inserter(text);
  for (const Point3& v : mesh.vertices)
    fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\n", v.x, v.y, v.z);
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    fmt::format_to(out, "usemtl {}\n", mesh.materials[m].name);
    for (const auto& [v, material, port] : mesh.faces) {
      if (material == m) fmt::format_to(out, "f {} {} {}\n", v[0] + 1, v[1] + 1, v[2] + 1);
    }
  }
  return text;
}

template <class T>
void append_bytes(std::string& text, T value) {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  text.append(bytes.data(), bytes.size());
}

std::string ply_of(const Mesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, z up\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement face {}\n"
      "property list uchar uint vertex_indices\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nend_header\n",
      mesh.vertices.size(), mesh.faces.size());
  for (const Point3& v : mesh.vertices) {
    for (const double coordinate : {v.x, v.y, v.z}) append_bytes(text, coordinate);
  }
  for (const Face& face : mesh.faces) {
    append_bytes(text, std::uint8_t{3});
    for (const std::uint32_t vertex : face.vertices) append_bytes(text, vertex);
    for (const std::uint8_t channel : mesh.materials[face.material].rgb)
      append_bytes(text, channel);
  }
  return text;
}

}  // namespace

bool is_building_file(const fs::path& file) {
  return std::ranges::find(kEndings, file.extension().string()) != kEndings.end();
}

void write_building(const fs::path& file, const Mesh& mesh, const std::string& name) {
  const std::string ending = file.extension().string();
  if (ending == ".obj") {
    fs::path materials = file;
    materials.replace_extension(".mtl");
    write_text(materials, mtl_of(mesh));
    write_text(file, obj_of(mesh, materials.filename().string(), name));
  } else if (ending == ".ply") {
    write_text(file, ply_of(mesh));
  } else if (ending == ".glb") {
    write_text(file, detail::glb_of(mesh, name));
  } else {
    throw InputError(fmt::format("{}: must end in {}", file.string(), fmt::join(kEndings, ", ")));
  }
}

}  // namespace plat::buildings
