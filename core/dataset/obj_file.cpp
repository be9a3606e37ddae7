#include "core/dataset/obj_file.h"

#include <spdlog/fmt/fmt.h>

#include <iterator>

#include "core/dataset/export_text.h"

namespace scantrove {

std::string encodeObj(const LabeledMesh& mesh, const std::string& name, const Eigen::Vector3d& origin) {
  std::string text = "# metres\no " + onOneLine(name) + "\n";
  const auto out = std::back_inserter(text);
  const bool is_near = origin.isZero(0);
  for (const SurfacePoint& vertex : mesh.vertices) {  // fmt ignores the locale: no decimal commas
    const Eigen::Vector3d p = vertex.position_world_m.cast<double>() + origin;
    if (is_near) {
      fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}", p.x(), p.y(), p.z());
    } else {
      fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}", p.x(), p.y(), p.z());
    }
    fmt::format_to(out, " {:.4g} {:.4g} {:.4g}\n", vertex.rgb[0] / 255.0, vertex.rgb[1] / 255.0,
                   vertex.rgb[2] / 255.0);
  }
  for (const SurfacePoint& vertex : mesh.vertices) {
    const Eigen::Vector3f& n = vertex.normal_world;
    fmt::format_to(out, "vn {:.5g} {:.5g} {:.5g}\n", n.x(), n.y(), n.z());
  }
  for (const auto& face : mesh.faces) {
    fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", face[0] + 1, face[1] + 1, face[2] + 1);
  }
  return text;
}

}  // namespace scantrove
