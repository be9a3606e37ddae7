#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// The volume of Curless and Levoy over a dense box of voxels, in double precision. Voxel (x, y, z) spans
/// [x, x + 1) * voxel_size and is sampled at its centre.
class DenseTsdf {
 public:
  struct Voxel {
    double distance = 0;    ///< in truncations
    double weight = 0;      ///< observations
    bool doubtful = false;  ///< in some frame, rounding decides to which pixel it projects
  };

  DenseTsdf(const Eigen::Vector3i& first, const Eigen::Vector3i& size, double voxel_size_m,
            double truncation_m, double max_weight)
      : first_(first),
        size_(size),
        voxel_size_m_(voxel_size_m),
        truncation_m_(truncation_m),
        max_weight_(max_weight),
        voxels_(static_cast<std::size_t>(size.prod())) {}

  void integrate(const std::vector<float>& depth_m, const Intrinsics& K,
                 const Eigen::Isometry3d& T_world_camera, double max_depth_m) {
    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    for (int z = 0; z < size_.z(); ++z) {
      for (int y = 0; y < size_.y(); ++y) {
        for (int x = 0; x < size_.x(); ++x) {
          const Eigen::Vector3i voxel = first_ + Eigen::Vector3i(x, y, z);
          const Eigen::Vector3d p =
              T_camera_world * ((voxel.cast<double>().array() + 0.5) * voxel_size_m_).matrix();
          if (p.z() <= 0) continue;
          const double u = K.fx * p.x() / p.z() + K.cx + 0.5;
          const double v = K.fy * p.y() / p.z() + K.cy + 0.5;
          Voxel& out = at(voxel);
          const double border = 1e-3;
          if (std::abs(u - std::round(u)) < border || std::abs(v - std::round(v)) < border)
            out.doubtful = true;
          const int pixel_u = static_cast<int>(std::floor(u));
          const int pixel_v = static_cast<int>(std::floor(v));
          if (pixel_u < 0 || pixel_u >= K.width || pixel_v < 0 || pixel_v >= K.height) continue;
          const double depth = depth_m[static_cast<std::size_t>(pixel_v * K.width + pixel_u)];
          if (!(depth > 0 && depth <= max_depth_m)) continue;
          const double sdf = depth - p.z();
          if (std::abs(sdf + truncation_m_) < 1e-5) out.doubtful = true;
          if (sdf <= -truncation_m_) continue;
          out.distance = (out.distance * out.weight + std::min(sdf / truncation_m_, 1.0)) / (out.weight + 1);
          out.weight = std::min(out.weight + 1, max_weight_);
        }
      }
    }
  }

  [[nodiscard]] Voxel& at(const Eigen::Vector3i& voxel) {
    const Eigen::Vector3i p = voxel - first_;
    return voxels_[static_cast<std::size_t>(p.x() + size_.x() * (p.y() + size_.y() * p.z()))];
  }

 private:
  Eigen::Vector3i first_, size_;
  double voxel_size_m_, truncation_m_, max_weight_;
  std::vector<Voxel> voxels_;
};

}  // namespace scantrove::reference
