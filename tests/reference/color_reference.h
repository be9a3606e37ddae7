#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// The colour of points near a surface in a colour image, in double precision; see rate_pixels.cl.
class ColorView {
 public:
  Intrinsics K;  ///< of the depth camera
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> vertices, normals, readings;  ///< by its pixel: world, world, camera
  std::vector<bool> is_surface, has_normal, has_reading, is_hidden;
  Intrinsics K_color;
  Eigen::Isometry3d T_world_color = Eigen::Isometry3d::Identity();
  cv::Mat image;  ///< BGR
  double voxel_size_m = 0;
  double depth_noise_m = 0;

  struct Seen {
    Eigen::Vector3d rgb;
    double weight = 0;
  };
  struct Answer {
    std::optional<Seen> seen;
    bool decided = true;  ///< false if rounding decides
  };

  [[nodiscard]] Answer at(const Eigen::Vector3d& p_world) const {
    Answer answer;
    const auto holdsWithin = [&](double margin, double more, double less) {
      if (std::abs(more - less) < margin) answer.decided = false;
      return more >= less;
    };
    const auto holds = [&](double more, double less) {
      return holdsWithin(1e-4 * std::max(1.0, std::abs(less)), more, less);
    };
    const std::optional<Eigen::Vector2i> pixel = pixelOf(K, T_world_camera.inverse() * p_world, holds);
    if (!pixel) return answer;
    const int u = pixel->x() / 2 * 2;  // the first pixel represents each 2 x 2 pixels
    const int v = pixel->y() / 2 * 2;
    const std::size_t i = index(u, v);
    if (!is_surface[i] || !has_normal[i] || !has_reading[i] || is_hidden[i]) return answer;

    const double z = (T_world_camera.inverse() * vertices[i]).z();
    const double apart = 2 * voxel_size_m + 3 * depth_noise_m * z * z;
    if (!holds(apart / voxel_size_m, std::abs(readings[i].z() - z) / voxel_size_m)) return answer;
    const double cosine = cosineTo(T_world_camera.translation(), i);
    const double color_cosine = cosineTo(T_world_color.translation(), i);
    if (!holds(cosine, 0.15) || !holds(color_cosine, 0.15)) return answer;

    // An outline: a reading two or three pixels away is hidden or off the plane, or it is missing, as is the
    // map's surface twice as far away.
    const Eigen::Vector3d n = T_world_camera.linear().transpose() * normals[i];
    for (const int dv : {-2, 0, 3}) {
      for (const int du : {-2, 0, 3}) {
        if (u + du < 0 || v + dv < 0 || u + du >= K.width || v + dv >= K.height) continue;
        const std::size_t beside = index(u + du, v + dv);
        if (is_hidden[beside]) return answer;
        Eigen::Vector3d there = readings[beside];
        if (!has_reading[beside]) {
          const Eigen::Vector2i twice(u + 2 * du, v + 2 * dv);
          if (twice.minCoeff() < 0 || twice.x() >= K.width || twice.y() >= K.height) return answer;
          const std::size_t beyond = index(twice.x(), twice.y());
          if (!is_surface[beyond]) return answer;
          there = T_world_camera.inverse() * vertices[beyond];
        }
        const double off = std::abs(n.dot(there - readings[i]));
        if (!holds(apart / voxel_size_m, off / voxel_size_m)) return answer;
      }
    }
    // Two voxels across the surface, plus the slope of the surface over 1.5 pixels.
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double reach = (2 * voxel_size_m + 1.5 * z / K.fx * sine) / cosine;
    const double behind = std::abs((T_world_camera.inverse() * p_world).z() - z);
    if (!holdsWithin(1e-4, reach, behind)) return answer;  // stored in sixteenths of a millimetre

    const std::optional<Eigen::Vector2i> place = pixelOf(K_color, T_world_color.inverse() * p_world, holds);
    if (!place) return answer;
    const cv::Vec3b bgr = image.at<cv::Vec3b>(place->y(), place->x());
    const double distance = (T_world_color.translation() - vertices[i]).norm();
    const double weight = 32 * color_cosine / (distance * distance);
    if (std::abs(weight - std::floor(weight) - 0.5) < 1e-3) answer.decided = false;
    answer.seen = Seen{Eigen::Vector3d(bgr[2], bgr[1], bgr[0]), std::clamp(std::round(weight), 1.0, 64.0)};
    return answer;
  }

 private:
  [[nodiscard]] std::size_t index(int u, int v) const { return static_cast<std::size_t>(v * K.width + u); }

  [[nodiscard]] double cosineTo(const Eigen::Vector3d& eye, std::size_t i) const {
    return normals[i].dot((eye - vertices[i]).normalized());
  }

  template <class Holds>
  static std::optional<Eigen::Vector2i> pixelOf(const Intrinsics& K, const Eigen::Vector3d& p,
                                                const Holds& holds) {
    if (p.z() <= 0) return std::nullopt;
    const double u = K.fx * p.x() / p.z() + K.cx + 0.5;
    const double v = K.fy * p.y() / p.z() + K.cy + 0.5;
    for (const double x : {u, v}) (void)holds(std::abs(x - std::round(x)), 0.0);  // near a pixel border
    if (!(u >= 0 && v >= 0 && u < K.width && v < K.height)) return std::nullopt;
    return Eigen::Vector2i(static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)));
  }
};

/// The running mean of one voxel's colour, weights up to 255.
struct ColorMean {
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
  double weight = 0;

  /// `observations` of the voxel's distance, this one included. Below four, earlier colour weighs at most as
  /// much as that many views like this one.
  void add(const ColorView::Seen& seen, double observations) {
    const double before = observations < 4 ? std::min(weight, observations * seen.weight) : weight;
    rgb += (seen.rgb - rgb) * seen.weight / (before + seen.weight);
    weight = std::min(before + seen.weight, 255.0);
  }
};

}  // namespace scantrove::reference
