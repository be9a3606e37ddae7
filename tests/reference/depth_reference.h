#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// Depth images in metres, row by row, 0 = no reading. Computes in double precision.
struct DepthImage {
  int width = 0, height = 0;
  std::vector<float> z;
  DepthImage(int w, int h) : width(w), height(h), z(static_cast<std::size_t>(w * h), 0.0F) {}
  [[nodiscard]] float at(int u, int v) const { return z[static_cast<std::size_t>(v * width + u)]; }
  float& at(int u, int v) { return z[static_cast<std::size_t>(v * width + u)]; }
  [[nodiscard]] bool inside(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }
};

inline double depthJump(double z) { return 0.01 + 0.01 * z * z; }

/// Converts a reading from camera units to metres; 0 outside [min_m, max_m].
inline float convertDepth(std::uint16_t units, float meters_per_unit, float min_m, float max_m) {
  const float z = static_cast<float>(units) * meters_per_unit;
  return z >= min_m && z <= max_m ? z : 0.0F;
}

/// Mean of the readings of the nearest surface under each small pixel, weighted by covered area.
inline DepthImage reduceDepth(const DepthImage& large, int width, int height, double ratio_x,
                              double ratio_y) {
  DepthImage small(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      struct Sample {
        double z, area;
      };
      std::vector<Sample> samples;
      double nearest = std::numeric_limits<double>::max();
      for (int y = 0; y < large.height; ++y) {
        const double covered_y = std::min(y + 1.0, (v + 1) * ratio_y) - std::max<double>(y, v * ratio_y);
        if (covered_y <= 1e-4) continue;
        for (int x = 0; x < large.width; ++x) {
          const double covered_x = std::min(x + 1.0, (u + 1) * ratio_x) - std::max<double>(x, u * ratio_x);
          if (covered_x <= 1e-4 || large.at(x, y) <= 0) continue;
          samples.push_back({large.at(x, y), covered_x * covered_y});
          nearest = std::min<double>(nearest, large.at(x, y));
        }
      }
      double sum = 0, area = 0;
      for (const Sample& sample : samples) {
        if (sample.z - nearest >= depthJump(nearest)) continue;
        sum += sample.z * sample.area;
        area += sample.area;
      }
      if (area > 0) small.at(u, v) = static_cast<float>(sum / area);
    }
  }
  return small;
}

/// 5 x 5 edge-preserving filter over pairs of opposite neighbours, weights g(q) ((1 - (d_q/s)^2)(1 -
/// (d_-q/s)^2))^2.
inline DepthImage filterDepth(const DepthImage& input, double range_base, double range_z2) {
  DepthImage output(input.width, input.height);
  for (int v = 0; v < input.height; ++v) {
    for (int u = 0; u < input.width; ++u) {
      const double z = input.at(u, v);
      if (z <= 0) continue;
      const double s = range_base + range_z2 * z * z;
      const auto difference = [&](int du, int dv) {
        const bool valid = input.inside(u + du, v + dv) && input.at(u + du, v + dv) > 0;
        return valid ? input.at(u + du, v + dv) - z : std::numeric_limits<double>::infinity();
      };
      double sum = 0, weight = 0;
      for (int dv = -2; dv <= 2; ++dv) {
        for (int du = -2; du <= 2; ++du) {
          const double d = difference(du, dv), opposite = difference(-du, -dv);
          if (std::abs(d) >= s || std::abs(opposite) >= s) continue;
          const double k = std::exp(-(du * du + dv * dv) / (2 * 1.5 * 1.5)) *
                           std::pow((1 - d * d / (s * s)) * (1 - opposite * opposite / (s * s)), 2);
          sum += k * d;
          weight += k;
        }
      }
      output.at(u, v) = static_cast<float>(z + sum / weight);
    }
  }
  return output;
}

struct Surface {
  std::vector<Eigen::Vector4d> vertices, normals;  ///< w = 1, or all 0
};

/// Vertices by back-projection; normals by the cross product of differences that do not cross a depth jump.
inline Surface buildSurface(const DepthImage& depth, const Intrinsics& K) {
  Surface surface;
  const double fx = K.fx, fy = K.fy, cx = K.cx, cy = K.cy;
  const auto point = [&](int u, int v) {
    const double z = depth.at(u, v);
    return Eigen::Vector3d((u - cx) * z / fx, (v - cy) * z / fy, z);
  };
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      Eigen::Vector4d vertex = Eigen::Vector4d::Zero(), normal = Eigen::Vector4d::Zero();
      const double z = depth.at(u, v);
      if (z > 0) {
        vertex << point(u, v), 1;
        const auto joined = [&](int x, int y) {
          return depth.inside(x, y) && depth.at(x, y) > 0 && std::abs(depth.at(x, y) - z) < depthJump(z);
        };
        const auto difference = [&](int du, int dv) {
          const bool after = joined(u + du, v + dv), before = joined(u - du, v - dv);
          const Eigen::Vector3d a = after ? point(u + du, v + dv) : point(u, v);
          const Eigen::Vector3d b = before ? point(u - du, v - dv) : point(u, v);
          return std::pair(Eigen::Vector3d(a - b), after || before);
        };
        const auto [along_u, has_u] = difference(1, 0);
        const auto [along_v, has_v] = difference(0, 1);
        if (has_u && has_v) normal << along_v.cross(along_u).normalized(), 1;
      }
      surface.vertices.push_back(vertex);
      surface.normals.push_back(normal);
    }
  }
  return surface;
}

}  // namespace scantrove::reference
