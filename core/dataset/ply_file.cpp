#include "core/dataset/ply_file.h"

#include <bit>
#include <cstring>

#include "core/dataset/export_text.h"

namespace scantrove {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

std::string plyHeader(const LabeledMesh& mesh, const PlyContent& content, const std::string& comment) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment " + onOneLine(comment) +
                       "\nelement vertex " + std::to_string(mesh.vertices.size()) + "\n";
  const std::string type = content.origin.isZero(0) ? "float" : "double";
  for (const char* axis : {"x", "y", "z"}) header += "property " + type + " " + axis + "\n";
  if (content.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (content.alpha) header += "property uchar alpha\n";
  if (content.label) header += "property uint label\n";
  if (content.estimated) header += "property uchar estimated\n";
  if (content.faces) {
    header +=
        "element face " + std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\n";
  }
  return header + "end_header\n";
}

/// The first number's lowest byte must not be a line end: assimp takes it for a part of the header and
/// reads all data one byte too early. The adjacent number is as good.
void keepOffTheHeader(std::string& bytes, std::size_t data_begin) {
  if (bytes.size() > data_begin && bytes[data_begin] == '\n') ++bytes[data_begin];
}

}  // namespace

std::string encodePly(const LabeledMesh& mesh, const PlyContent& content, const std::string& comment) {
  std::string bytes = plyHeader(mesh, content, comment);
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::size_t data_begin = bytes.size();
  const bool has_doubles = !content.origin.isZero(0);
  constexpr std::size_t kMaxVertexBytes = 48, kFaceBytes = 13;
  bytes.reserve(bytes.size() + mesh.vertices.size() * kMaxVertexBytes + mesh.faces.size() * kFaceBytes);
  for (const SurfacePoint& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      const float place = vertex.position_world_m[i];
      has_doubles ? put(place + content.origin[i]) : put(place);
    }
    for (int i = 0; content.normals && i < 3; ++i) put(vertex.normal_world[i]);
    put(vertex.rgb);
    if (content.alpha) put(std::uint8_t{255});
    if (content.label) put(vertex.region);
    if (content.estimated) put(static_cast<std::uint8_t>(vertex.is_estimated));
  }
  for (std::size_t i = 0; content.faces && i < mesh.faces.size(); ++i) {
    put(std::uint8_t{3});
    put(mesh.faces[i]);
  }
  keepOffTheHeader(bytes, data_begin);
  return bytes;
}

}  // namespace scantrove
