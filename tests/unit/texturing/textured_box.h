#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/texturing/surface_texturer.h"

namespace scantrove::test {

/// A camera at `eye` that looks at `target`, with z of the world upwards in the image.
inline Eigen::Isometry3d cameraAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().col(0) = right;
  T.linear().col(1) = forward.cross(right);
  T.linear().col(2) = forward;
  T.translation() = eye;
  return T;
}

/// A box, with its sides in the directions of the axes.
struct AxisBox {
  Eigen::Vector3d low, high;

  /// The distance along a ray where it enters the box; none: it does not.
  [[nodiscard]] std::optional<double> hitBy(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) const {
    double enter = 0, leave = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double a = (low[i] - eye[i]) / ray[i], b = (high[i] - eye[i]) / ray[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter > 0 && enter < leave ? std::optional(enter) : std::nullopt;
  }
};

/// Blue, green, red of a place in the world: waves of 20 to 25 cm.
inline Eigen::Vector3d colorOfPlace(const Eigen::Vector3d& p) {
  return {128 + 80 * std::sin(30 * p.x() + 4 * p.z()), 128 + 80 * std::sin(28 * p.y() + 3),
          128 + 80 * std::sin(26 * p.z() + 5 * p.x())};
}

/// Boxes whose surface is coloured by a formula, seen by cameras whose images follow from it.
struct TexturedBoxes {
  /// Adds a box whose sides are grids of `cells` x `cells` squares, two faces each. Black vertices: unknown.
  void addBox(const AxisBox& box, std::uint32_t cells) {
    boxes.push_back(box);
    const Eigen::Vector3d size = box.high - box.low;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const bool is_high : {false, true}) {
        Eigen::Vector3d corner = box.low, along = Eigen::Vector3d::Zero(), across = Eigen::Vector3d::Zero();
        corner[axis] = is_high ? box.high[axis] : box.low[axis];
        // u x v is the axis: counter-clockwise on the high side.
        along[is_high ? u : v] = size[is_high ? u : v];
        across[is_high ? v : u] = size[is_high ? v : u];
        addSide(corner, along, across, cells);
      }
    }
  }

  /// `gain`: of the image's brightness.
  void addCamera(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double gain = 1) {
    scene.views.push_back({{400, 400, 199.5F, 149.5F, 400, 300}, cameraAt(eye, target)});
    gains.push_back(gain);
  }

  /// The image by formula; each box may have a colour of its own.
  [[nodiscard]] cv::Mat imageOf(std::size_t view) const {
    const TextureView& camera = scene.views[view];
    cv::Mat image(camera.K.height, camera.K.width, CV_8UC3, cv::Scalar::all(0));
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        const Eigen::Vector3d in_camera =
            camera.K.backProject(static_cast<float>(u), static_cast<float>(v), 1).cast<double>();
        const Eigen::Vector3d eye = camera.T_world_camera.translation();
        const Eigen::Vector3d ray = camera.T_world_camera.linear() * in_camera;
        double nearest = 1e9;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
          const auto hit = boxes[i].hitBy(eye, ray);
          if (!hit || *hit > nearest) continue;
          nearest = *hit;
          const Eigen::Vector3d bgr =
              gains[view] * (colors ? colors(i, eye + *hit * ray) : colorOfPlace(eye + *hit * ray));
          for (int k = 0; k < 3; ++k) image.at<cv::Vec3b>(v, u)[k] = cv::saturate_cast<std::uint8_t>(bgr[k]);
        }
      }
    }
    return image;
  }

  /// The whole surface as one part.
  [[nodiscard]] SurfaceTextures texture(int max_size_px = 2048) {
    TexturePart all;
    all.max_size_px = max_size_px;
    for (std::uint32_t face = 0; face < scene.surface.faces.size(); ++face) all.faces.push_back(face);
    scene.image = [this](std::size_t view) -> Result<cv::Mat> { return imageOf(view); };
    auto textures = textureSurface(scene, std::span(&all, 1));
    return textures ? std::move(*textures) : SurfaceTextures{};
  }

  TexturedScene scene;
  std::vector<AxisBox> boxes;
  std::vector<double> gains;
  std::function<Eigen::Vector3d(std::size_t box, const Eigen::Vector3d& place)> colors;

 private:
  void addSide(const Eigen::Vector3d& corner, const Eigen::Vector3d& along, const Eigen::Vector3d& across,
               std::uint32_t cells) {
    TextureSurface& surface = scene.surface;
    const auto first = static_cast<std::uint32_t>(surface.positions_m.size());
    for (std::uint32_t j = 0; j <= cells; ++j) {
      for (std::uint32_t i = 0; i <= cells; ++i) {
        const Eigen::Vector3d p = corner + along * (double{1} * i / cells) + across * (double{1} * j / cells);
        surface.positions_m.emplace_back(p.cast<float>());
        surface.colors.push_back({});
      }
    }
    for (std::uint32_t j = 0; j < cells; ++j) {
      for (std::uint32_t i = 0; i < cells; ++i) {
        const std::uint32_t p = first + j * (cells + 1) + i, q = p + cells + 1;
        surface.faces.push_back({p, p + 1, q});
        surface.faces.push_back({p + 1, q + 1, q});
      }
    }
  }
};

/// The colour of a texture at a place (as in FaceTexture), interpolated as graphics cards do.
inline Eigen::Vector3d textureColor(const cv::Mat& image, const Eigen::Vector2f& place) {
  const double x = static_cast<double>(place.x()) * image.cols - 0.5;
  const double y = static_cast<double>(place.y()) * image.rows - 0.5;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const double weight = (dx == 1 ? x - left : 1 - x + left) * (dy == 1 ? y - top : 1 - y + top);
      const auto& bgr = image.at<cv::Vec3b>(std::clamp(top + dy, 0, image.rows - 1),
                                            std::clamp(left + dx, 0, image.cols - 1));
      sum += weight * Eigen::Vector3d(bgr[0], bgr[1], bgr[2]);
    }
  }
  return sum;
}

}  // namespace scantrove::test
