#include "core/dataset/glb_file.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "core/dataset/mesh_parts.h"
#include "core/dataset/texture_corners.h"

namespace scantrove {
namespace {

// Khronos glTF 2.0 specification, sections 3.6 (buffers, accessors), 3.7 (meshes) and 4 (GLB).
constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2, kJsonChunk = 0x4E4F534A,
                        kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kLinear = 9729, kLinearMipmaps = 9987, kClampToEdge = 33071;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr std::size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;
static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// sRGB of 8 bits to linear of 16 (IEC 61966-2-1).
std::uint16_t linearColor(std::uint8_t value) {
  static const std::array<std::uint16_t, 256> kTable = [] {
    std::array<std::uint16_t, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255;
      const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      table[i] = static_cast<std::uint16_t>(std::lround(65535 * linear));
    }
    return table;
  }();
  return kTable[value];
}

/// A file under construction: its tables, and the buffer that they refer to.
class GlbBuilder {
 public:
  GlbBuilder() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Scantrove"}};
    json_["scene"] = 0;
    json_["scenes"] = ExportJson::array({{{"nodes", ExportJson::array()}}});
    for (const char* table : {"nodes", "meshes"}) json_[table] = ExportJson::array();
    json_["materials"] =
        ExportJson::array({{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
                            {"doubleSided", true}}});
    for (const char* table : {"accessors", "bufferViews"}) json_[table] = ExportJson::array();
  }

  void add(const GlbPart& part) {
    if (part.mesh.faces.empty()) return;  // glTF has no empty meshes
    const ExportJson primitive =
        part.textures.empty() ? coloredPrimitive(part.mesh) : texturedPrimitive(part.mesh, part.textures);
    const std::size_t number = json_["meshes"].size();
    json_["meshes"].push_back({{"name", part.name}, {"primitives", ExportJson::array({primitive})}});
    ExportJson node = {{"name", part.name}, {"mesh", number}};
    if (!part.extras.is_null()) node["extras"] = part.extras;
    const Eigen::Vector3d& moved = part.translation;
    if (!moved.isZero(0)) node["translation"] = {moved.x(), moved.y(), moved.z()};
    json_["nodes"].push_back(std::move(node));
    json_["scenes"][0]["nodes"].push_back(number);
  }

  /// Embeds the image of the material.
  void addTexture(const std::string& png) {
    const std::size_t start = binary_.size();
    binary_ += png;
    json_["images"] =
        ExportJson::array({{{"mimeType", "image/png"}, {"bufferView", json_["bufferViews"].size()}}});
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", png.size()}});
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json_["samplers"] = ExportJson::array({{{"magFilter", kLinear},
                                            {"minFilter", kLinearMipmaps},
                                            {"wrapS", kClampToEdge},
                                            {"wrapT", kClampToEdge}}});
    json_["textures"] = ExportJson::array({{{"sampler", 0}, {"source", 0}}});
    json_["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  }

  Result<std::string> finish() {
    if (binary_.empty()) {  // empty tables are not allowed
      for (const char* table : {"nodes", "meshes", "accessors", "bufferViews", "materials"})
        json_.erase(table);
      json_["scenes"][0].erase("nodes");
    } else {
      json_["buffers"] = ExportJson::array({{{"byteLength", binary_.size()}}});
    }
    std::string json = json_.dump(-1, ' ', false, ExportJson::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t total = kGlbHeaderBytes + kChunkHeaderBytes + json.size() +
                              (binary_.empty() ? 0 : kChunkHeaderBytes + binary_.size());
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      return fail("The surface is too large for a GLB file, which holds at most 4 GB.",
                  "Export the labelled cloud (ply) instead, or scan with larger voxels.");
    }
    std::string bytes;
    bytes.reserve(total);
    for (const std::uint32_t word : {kGlbMagic, kGlbVersion, static_cast<std::uint32_t>(total),
                                     static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
      append(bytes, word);
    }
    bytes += json;
    if (!binary_.empty()) {
      append(bytes, static_cast<std::uint32_t>(binary_.size()));
      append(bytes, kBinaryChunk);
      bytes += binary_;
    }
    return bytes;
  }

 private:
  /// Describes the data from `start` on; elements have lengths that are multiples of four.
  int describe(std::size_t start, int target, ExportJson accessor) {
    accessor["bufferView"] = json_["bufferViews"].size();
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", start}, {"byteLength", binary_.size() - start}, {"target", target}});
    json_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  ExportJson coloredPrimitive(const LabeledMesh& mesh) {
    const int positions = addPositions(mesh), normals = addNormals(mesh), colors = addColors(mesh),
              indices = addIndices(mesh);
    return {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"COLOR_0", colors}}},
            {"indices", indices},
            {"material", 0}};
  }

  /// glTF has one index for all attributes, so vertices at seams are repeated.
  ExportJson texturedPrimitive(const LabeledMesh& mesh, std::span<const FaceTexture> textures) {
    TextureCorners texture = textureCornersOf(mesh, textures);
    LabeledMesh repeated;
    repeated.vertices.reserve(texture.corners.size());
    for (const TextureCorners::Corner& corner : texture.corners)
      repeated.vertices.push_back(mesh.vertices[corner.vertex]);
    repeated.faces = std::move(texture.faces);
    const int positions = addPositions(repeated), normals = addNormals(repeated),
              places = addPlaces(texture.corners), indices = addIndices(repeated);
    return {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", places}}},
            {"indices", indices},
            {"material", 0}};
  }

  int addPlaces(std::span<const TextureCorners::Corner> corners) {
    const std::size_t start = binary_.size();
    for (const TextureCorners::Corner& corner : corners) {
      append(binary_, corner.place.x());
      append(binary_, corner.place.y());
    }
    return describe(start, kVertexTarget,
                    {{"componentType", kFloat}, {"count", corners.size()}, {"type", "VEC2"}});
  }

  int addPositions(const LabeledMesh& mesh) {
    const std::size_t start = binary_.size();
    for (const SurfacePoint& vertex : mesh.vertices) {
      for (int i = 0; i < 3; ++i) append(binary_, vertex.position_world_m[i]);
    }
    const Eigen::AlignedBox3f box = boxOf(mesh);
    return describe(start, kVertexTarget,
                    {{"componentType", kFloat},
                     {"count", mesh.vertices.size()},
                     {"type", "VEC3"},
                     {"min", {box.min().x(), box.min().y(), box.min().z()}},
                     {"max", {box.max().x(), box.max().y(), box.max().z()}}});
  }

  int addNormals(const LabeledMesh& mesh) {
    const std::size_t start = binary_.size();
    for (const SurfacePoint& vertex : mesh.vertices) {
      const float length = vertex.normal_world.norm();  // must be 1
      const Eigen::Vector3f normal =
          length > 1e-6F ? Eigen::Vector3f(vertex.normal_world / length) : Eigen::Vector3f::UnitY();
      for (int i = 0; i < 3; ++i) append(binary_, normal[i]);
    }
    return describe(start, kVertexTarget,
                    {{"componentType", kFloat}, {"count", mesh.vertices.size()}, {"type", "VEC3"}});
  }

  int addColors(const LabeledMesh& mesh) {
    const std::size_t start = binary_.size();
    for (const SurfacePoint& vertex : mesh.vertices) {
      for (const std::uint8_t value : vertex.rgb) append(binary_, linearColor(value));
      append(binary_, std::uint16_t{65535});
    }
    return describe(start, kVertexTarget,
                    {{"componentType", kUnsignedShort},
                     {"normalized", true},
                     {"count", mesh.vertices.size()},
                     {"type", "VEC4"}});
  }

  int addIndices(const LabeledMesh& mesh) {
    const std::size_t start = binary_.size();
    for (const auto& face : mesh.faces) append(binary_, face);
    return describe(start, kIndexTarget,
                    {{"componentType", kUnsignedInt}, {"count", 3 * mesh.faces.size()}, {"type", "SCALAR"}});
  }

  ExportJson json_;
  std::string binary_;
};

}  // namespace

Result<std::string> encodeGlb(std::span<const GlbPart> parts, const std::string& png) {
  GlbBuilder builder;
  for (const GlbPart& part : parts) builder.add(part);
  if (!png.empty()) builder.addTexture(png);
  return builder.finish();
}

}  // namespace scantrove
