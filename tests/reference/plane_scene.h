#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/compute/opencl.h"

namespace scantrove::reference {

inline Eigen::Vector3d toEigen(const cl_float4& v) { return {v.s[0], v.s[1], v.s[2]}; }

/// A face: points p of the camera frame with normal . p = offset and inside(p).
struct Face {
  Eigen::Vector3d normal;  ///< unit, towards the camera
  double offset;
  bool (*inside)(const Eigen::Vector3d& p);
};

struct RenderedFaces {
  std::vector<cl_float4> vertices;  ///< camera frame, as SurfaceMaps
  std::vector<cl_float4> normals;
  std::vector<int> faces;  ///< index of the visible face, -1 if none
};

/// Vertices and normals of the nearest face along the ray of each pixel, exact up to float rounding.
inline RenderedFaces render(const std::vector<Face>& faces, const Intrinsics& K) {
  RenderedFaces result;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const Eigen::Vector3d ray =
          K.backProject(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>();
      double nearest = std::numeric_limits<double>::infinity();
      int seen = -1;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const double z = faces[f].offset / faces[f].normal.dot(ray);
        if (z > 0 && z < nearest && faces[f].inside(ray * z)) {
          nearest = z;
          seen = static_cast<int>(f);
        }
      }
      cl_float4 vertex = {{0, 0, 0, 0}};
      cl_float4 normal = {{0, 0, 0, 0}};
      if (seen >= 0) {
        const Eigen::Vector3f p = (ray * nearest).cast<float>();
        const Eigen::Vector3f n = faces[static_cast<std::size_t>(seen)].normal.cast<float>();
        vertex = {{p.x(), p.y(), p.z(), 1}};
        normal = {{n.x(), n.y(), n.z(), 1}};
      }
      result.vertices.push_back(vertex);
      result.normals.push_back(normal);
      result.faces.push_back(seen);
    }
  }
  return result;
}

/// Two faces that meet in a vertical or horizontal (`level`) line through (0, 0, 1) at an angle of
/// `turn_rad`: a ridge towards the camera (convex) or a valley (concave). They cover all pixels.
inline std::vector<Face> wedge(bool convex, double turn_rad, bool level = false) {
  const double across = (convex ? -1 : 1) * std::sin(turn_rad / 2);  // of the first face's normal
  const double towards = -std::cos(turn_rad / 2);
  if (level) {
    return {{{0, across, towards}, towards, [](const Eigen::Vector3d& p) { return p.y() < 0; }},
            {{0, -across, towards}, towards, [](const Eigen::Vector3d& p) { return p.y() >= 0; }}};
  }
  return {{{across, 0, towards}, towards, [](const Eigen::Vector3d& p) { return p.x() < 0; }},
          {{-across, 0, towards}, towards, [](const Eigen::Vector3d& p) { return p.x() >= 0; }}};
}

}  // namespace scantrove::reference
