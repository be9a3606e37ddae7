#include "core/dataset/obj_file.h"

#include <spdlog/fmt/fmt.h>

#include <iterator>

#include "core/dataset/export_text.h"
#include "core/dataset/texture_corners.h"

namespace scantrove {
namespace {

constexpr const char* kMaterial = "texture";

/// fmt ignores the locale: no decimal commas.
void addPosition(std::string& text, const SurfacePoint& vertex, const Eigen::Vector3d& origin) {
  const auto out = std::back_inserter(text);
  const Eigen::Vector3d p = vertex.position_world_m.cast<double>() + origin;
  if (origin.isZero(0)) {
    fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}", p.x(), p.y(), p.z());
  } else {
    fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}", p.x(), p.y(), p.z());
  }
}

void addNormals(std::string& text, const LabeledMesh& mesh) {
  const auto out = std::back_inserter(text);
  for (const SurfacePoint& vertex : mesh.vertices) {
    const Eigen::Vector3f& n = vertex.normal_world;
    fmt::format_to(out, "vn {:.5g} {:.5g} {:.5g}\n", n.x(), n.y(), n.z());
  }
}

}  // namespace

std::string encodeObj(const LabeledMesh& mesh, const std::string& name, const Eigen::Vector3d& origin) {
  std::string text = "# metres\no " + onOneLine(name) + "\n";
  const auto out = std::back_inserter(text);
  for (const SurfacePoint& vertex : mesh.vertices) {
    addPosition(text, vertex, origin);
    fmt::format_to(out, " {:.4g} {:.4g} {:.4g}\n", vertex.rgb[0] / 255.0, vertex.rgb[1] / 255.0,
                   vertex.rgb[2] / 255.0);
  }
  addNormals(text, mesh);
  for (const auto& face : mesh.faces) {
    fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", face[0] + 1, face[1] + 1, face[2] + 1);
  }
  return text;
}

std::string encodeTexturedObj(const LabeledMesh& mesh, std::span<const FaceTexture> textures,
                              const std::string& name, const std::string& mtl_file,
                              const Eigen::Vector3d& origin) {
  std::string text = "# metres\nmtllib " + mtl_file + "\no " + onOneLine(name) + "\n";
  const auto out = std::back_inserter(text);
  for (const SurfacePoint& vertex : mesh.vertices) {
    addPosition(text, vertex, origin);
    text += '\n';
  }
  const TextureCorners texture = textureCornersOf(mesh, textures);
  for (const TextureCorners::Corner& corner : texture.corners)
    fmt::format_to(out, "vt {:.6f} {:.6f}\n", corner.place.x(), 1 - corner.place.y());
  addNormals(text, mesh);
  text += std::string("usemtl ") + kMaterial + "\n";
  for (std::size_t i = 0; i < texture.faces.size(); ++i) {
    const auto &v = mesh.faces[i], &t = texture.faces[i];
    fmt::format_to(out, "f {0}/{1}/{0} {2}/{3}/{2} {4}/{5}/{4}\n", v[0] + 1, t[0] + 1, v[1] + 1, t[1] + 1,
                   v[2] + 1, t[2] + 1);
  }
  return text;
}

std::string encodeMtl(const std::string& image_file) {
  return std::string("newmtl ") + kMaterial + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " +
         image_file + "\n";
}

}  // namespace scantrove
