#include "core/picture/surface_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

namespace scantrove {
namespace {

constexpr float kNearest_m = 1e-4F;

/// A vertex as the camera sees it.
struct Projected {
  Eigen::Vector3f in_camera_m;
  Eigen::Vector2f pixel;
};

std::vector<Projected> project(const PictureSurface& surface, const PictureCamera& camera) {
  std::vector<Projected> projected;
  projected.reserve(surface.vertices.size());
  for (const PictureSurface::Vertex& vertex : surface.vertices) {
    const Eigen::Vector3f p = camera.T_camera_world * vertex.position_world_m;
    const float scale = camera.focal_px / std::max(p.z(), kNearest_m);
    projected.push_back({p, {p.x() * scale + camera.centerX(), p.y() * scale + camera.centerY()}});
  }
  return projected;
}

/// Twice the area of a triangle of the picture; positive if clockwise there, where y goes down.
float doubleArea(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Draws the rows `first` .. `end` of a picture.
class RowPainter {
 public:
  RowPainter(const PictureSurface& surface, const PictureCamera& camera,
             const std::vector<Projected>& projected, cv::Mat& image, int first, int end)
      : surface_(surface),
        camera_(camera),
        projected_(projected),
        image_(image),
        first_(first),
        end_(end),
        nearness_(static_cast<std::size_t>(end - first) * static_cast<std::size_t>(camera.width), 0.0F) {}

  void paint() {
    for (std::size_t face = 0; face < surface_.faces.size(); ++face) paintFace(face);
  }

 private:
  void paintFace(std::size_t face) {
    const auto& corners = surface_.faces[face];
    const Projected &a = projected_[corners[0]], &b = projected_[corners[1]], &c = projected_[corners[2]];
    if (std::min({a.in_camera_m.z(), b.in_camera_m.z(), c.in_camera_m.z()}) <= kNearest_m) return;
    // Counter-clockwise for the viewer: the outer side.
    const float area = -doubleArea(a.pixel, b.pixel, c.pixel);
    if (!(area > 0)) return;
    const auto least = [](float x, float y, float z) { return std::min({x, y, z}); };
    const auto most = [](float x, float y, float z) { return std::max({x, y, z}); };
    const int x0 = pixelFrom(least(a.pixel.x(), b.pixel.x(), c.pixel.x()), 0, camera_.width);
    const int x1 = pixelFrom(std::floor(most(a.pixel.x(), b.pixel.x(), c.pixel.x())) + 1, 0, camera_.width);
    const int y0 = pixelFrom(least(a.pixel.y(), b.pixel.y(), c.pixel.y()), first_, end_);
    const int y1 = pixelFrom(std::floor(most(a.pixel.y(), b.pixel.y(), c.pixel.y())) + 1, first_, end_);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const Eigen::Vector2f pixel(static_cast<float>(x), static_cast<float>(y));
        const Eigen::Vector3f inside(-doubleArea(b.pixel, c.pixel, pixel),
                                     -doubleArea(c.pixel, a.pixel, pixel),
                                     -doubleArea(a.pixel, b.pixel, pixel));
        if (inside.minCoeff() < 0) continue;
        paintPixel(face, x, y, inside / area);
      }
    }
  }

  static int pixelFrom(float position, int least, int end) {
    return static_cast<int>(
        std::clamp(std::ceil(position), static_cast<float>(least), static_cast<float>(end)));
  }

  /// `weights`: of the corners in the picture; those on the surface are divided by depth.
  void paintPixel(std::size_t face, int x, int y, const Eigen::Vector3f& weights) {
    const auto& corners = surface_.faces[face];
    Eigen::Vector3f on_surface;
    for (int i = 0; i < 3; ++i)
      on_surface[i] = weights[i] / projected_[corners[static_cast<std::size_t>(i)]].in_camera_m.z();
    const float nearness = on_surface.sum();  // 1 / depth
    float& nearest =
        nearness_[static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(camera_.width) +
                  static_cast<std::size_t>(x)];
    if (!(nearness > nearest)) return;
    nearest = nearness;
    on_surface /= nearness;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero(), color = Eigen::Vector3f::Zero(),
                    point = Eigen::Vector3f::Zero();
    for (int i = 0; i < 3; ++i) {
      const std::size_t vertex = corners[static_cast<std::size_t>(i)];
      const Rgb& rgb = surface_.vertices[vertex].color;
      normal += on_surface[i] * surface_.vertices[vertex].normal_world;
      point += on_surface[i] * projected_[vertex].in_camera_m;
      color += on_surface[i] * Eigen::Vector3f(rgb[0], rgb[1], rgb[2]);
    }
    if (!surface_.face_colors.empty()) {
      const Rgb& rgb = surface_.face_colors[face];
      color = Eigen::Vector3f(rgb[0], rgb[1], rgb[2]);
    }
    color *= light(face, normal, point);
    const auto byte = [](float value) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
    };
    image_.at<cv::Vec3b>(y, x) = {byte(color[2]), byte(color[1]), byte(color[0])};
  }

  /// The part of its color that a point shows to a lamp at the camera.
  [[nodiscard]] float light(std::size_t face, const Eigen::Vector3f& normal_world,
                            const Eigen::Vector3f& point_camera) const {
    Eigen::Vector3f normal = camera_.T_camera_world.linear() * normal_world;
    if (normal.norm() < 1e-6F) {
      const auto& corners = surface_.faces[face];
      const auto at = [&](std::size_t i) { return projected_[corners[i]].in_camera_m; };
      normal = (at(1) - at(0)).cross(at(2) - at(0));
    }
    const float cosine = -normal.normalized().dot(point_camera.normalized());
    return kAmbientLight + (1 - kAmbientLight) * std::max(cosine, 0.0F);
  }

  const PictureSurface& surface_;
  const PictureCamera& camera_;
  const std::vector<Projected>& projected_;
  cv::Mat& image_;
  int first_, end_;
  std::vector<float> nearness_;  // 1 / depth of what is drawn; 0: nothing
};

}  // namespace

cv::Mat renderSurface(const PictureSurface& surface, const PictureCamera& camera) {
  cv::Mat image(camera.height, camera.width, CV_8UC3, cv::Scalar(kPictureBackground));
  const std::vector<Projected> projected = project(surface, camera);
  const int half = camera.height / 2;
  RowPainter upper(surface, camera, projected, image, 0, half);
  RowPainter lower(surface, camera, projected, image, half, camera.height);
  {
    const std::jthread other([&lower] { lower.paint(); });
    upper.paint();
  }
  return image;
}

}  // namespace scantrove
