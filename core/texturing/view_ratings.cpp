#include "core/texturing/view_ratings.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/image/sharpness.h"
#include "core/texturing/depth_raster.h"

namespace scantrove {
namespace {

/// Occlusion is rendered at this width at most.
constexpr int kMaxWidth_px = 640;
/// Part of the image's width at each side that is not used: lenses are worst there.
constexpr float kRim = 0.015F;
/// Cosine of 80 degrees.
constexpr float kMinCosine = 0.17F;
/// A point this far behind the rendered surface is occluded: voxels are some millimetres wide, and depth
/// changes within a pixel.
constexpr float kOcclusion_m = 0.01F, kOcclusionPerMeter = 0.01F;
/// Beside surface that is this much nearer, an error of the pose shows the nearer one.
constexpr float kBeside_m = 0.05F, kBesidePerMeter = 0.02F, kBesideFactor = 0.3F;
constexpr int kBeside_px = 5;
/// Sharpness counts within these limits; images without contrast have the usual one.
constexpr float kMinSharpness = 0.01F, kMaxSharpness = 0.25F, kUsualSharpness = 0.06F;
/// Difference from the colour of the map at which the quality is halved; exposure changes it by less.
constexpr float kColorDifference = 60;
/// Pixels between the points where a large face is checked, and their most along a side.
constexpr float kCheckEvery_px = 4;
constexpr int kMaxChecks = 12;
constexpr float kNothing_m = 1e6F;

/// What a view shows, at the reduced size.
class ShownSurface {
 public:
  enum class Place : std::uint8_t { hidden, beside_nearer, clear };

  ShownSurface(const TextureSurface& surface, const TextureView& view, const cv::Mat& image)
      : surface_(surface), projection_(view, std::min(1.0, double{kMaxWidth_px} / view.K.width)) {
    const Intrinsics& K = projection_.intrinsics();
    cv::resize(image, image_, {K.width, K.height}, 0, 0, cv::INTER_AREA);
    points_.reserve(surface.positions_m.size());
    for (const Eigen::Vector3f& p : surface.positions_m) points_.push_back(projection_.inCamera(p));
    DepthRaster raster(K);
    for (const FaceCorners& face : surface.faces)
      raster.add(points_[face[0]], points_[face[1]], points_[face[2]]);
    depth_m_ = raster.depth().clone();
    depth_m_.setTo(kNothing_m, depth_m_ == 0);
    cv::erode(depth_m_, nearest_m_, cv::Mat::ones(kBeside_px, kBeside_px, CV_8UC1));
    places_.reserve(points_.size());
    for (const Eigen::Vector3f& p : points_) places_.push_back(placeOf(p));
  }

  /// The quality of the view for a face without the sharpness; 0: it does not show the face.
  [[nodiscard]] float qualityOf(const FaceCorners& face) const {
    const Place place = std::min({places_[face[0]], places_[face[1]], places_[face[2]]});
    if (place == Place::hidden) return 0;
    const Eigen::Vector3f &a = points_[face[0]], &b = points_[face[1]], &c = points_[face[2]];
    const Eigen::Vector3f normal = (b - a).cross(c - a), middle = (a + b + c) / 3;
    const float lengths = normal.norm() * middle.norm();
    const float cosine = lengths > 0 ? -normal.dot(middle) / lengths : 0;
    if (cosine < kMinCosine) return 0;
    const Eigen::Vector2f A = projection_.pixel(a), AB = projection_.pixel(b) - A,
                          AC = projection_.pixel(c) - A;
    const float area_px = std::abs(AB.x() * AC.y() - AB.y() * AC.x()) / 2;
    if (!isClearWithin(a, b, c, area_px)) return 0;
    return area_px * cosine * colorFactor(face, middle) * (place == Place::clear ? 1 : kBesideFactor);
  }

 private:
  [[nodiscard]] Place placeOf(const Eigen::Vector3f& p) const {
    if (!(p.z() > 0.01F)) return Place::hidden;
    const Eigen::Vector2f uv = projection_.pixel(p);
    const Intrinsics& K = projection_.intrinsics();
    const float rim = kRim * static_cast<float>(K.width);
    const bool is_inside = uv.x() > rim && uv.y() > rim && uv.x() < static_cast<float>(K.width - 1) - rim &&
                           uv.y() < static_cast<float>(K.height - 1) - rim;
    if (!is_inside) return Place::hidden;
    const auto x = static_cast<int>(std::lround(uv.x())), y = static_cast<int>(std::lround(uv.y()));
    if (p.z() > depth_m_.at<float>(y, x) + kOcclusion_m + kOcclusionPerMeter * p.z()) return Place::hidden;
    const bool is_beside = p.z() > nearest_m_.at<float>(y, x) + kBeside_m + kBesidePerMeter * p.z();
    return is_beside ? Place::beside_nearer : Place::clear;
  }

  /// Checks points of a face of `area_px` beside its corners.
  [[nodiscard]] bool isClearWithin(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                   const Eigen::Vector3f& c, float area_px) const {
    const int steps =
        std::min(kMaxChecks, static_cast<int>(std::ceil(std::sqrt(2 * area_px) / kCheckEvery_px)));
    for (int i = 0; i <= steps && steps > 1; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const float wb = static_cast<float>(i) / static_cast<float>(steps);
        const float wc = static_cast<float>(j) / static_cast<float>(steps);
        if (placeOf(a + wb * (b - a) + wc * (c - a)) == Place::hidden) return false;
      }
    }
    return true;
  }

  [[nodiscard]] float colorFactor(const FaceCorners& face, const Eigen::Vector3f& middle) const {
    Eigen::Vector3f of_map = Eigen::Vector3f::Zero();
    for (const std::uint32_t vertex : face) {
      const auto& rgb = surface_.colors[vertex];
      if (rgb == std::array<std::uint8_t, 3>{}) return 1;
      of_map += Eigen::Vector3f(rgb[0], rgb[1], rgb[2]) / 3;
    }
    const Eigen::Vector2f uv = projection_.pixel(middle);
    const auto& bgr =
        image_.at<cv::Vec3b>(static_cast<int>(std::lround(uv.y())), static_cast<int>(std::lround(uv.x())));
    const float difference = (of_map - Eigen::Vector3f(bgr[2], bgr[1], bgr[0])).norm() / kColorDifference;
    return 1 / (1 + difference * difference);
  }

  const TextureSurface& surface_;
  ViewProjection projection_;
  std::vector<Eigen::Vector3f> points_;  // vertices in the camera's frame
  std::vector<Place> places_;
  cv::Mat image_, depth_m_, nearest_m_;  // reduced; CV_32FC1, kNothing_m = nothing
};

}  // namespace

ViewRatings::ViewRatings(const TextureSurface& surface)
    : surface_(surface), ratings_(kMaxPerFace * surface.faces.size()), counts_(surface.faces.size()) {}

void ViewRatings::add(ViewNumber number, const TextureView& view, const cv::Mat& image) {
  const float measured = sharpnessOf(image);
  const float sharpness = measured > 0 ? std::clamp(measured, kMinSharpness, kMaxSharpness) : kUsualSharpness;
  const ShownSurface shown(surface_, view, image);
  // Areas of images that were reduced differently become comparable.
  const float reduction = std::max(1.0F, static_cast<float>(view.K.width) / static_cast<float>(kMaxWidth_px));
  const float factor = sharpness * reduction * reduction;
  for (std::uint32_t face = 0; face < surface_.faces.size(); ++face) {
    const float quality = factor * shown.qualityOf(surface_.faces[face]);
    if (quality > 0) insert(face, {quality, number});
  }
}

void ViewRatings::insert(std::uint32_t face, const Rating& rating) {
  Rating* own = ratings_.data() + kMaxPerFace * face;
  std::size_t place = counts_[face];
  if (place == kMaxPerFace) {
    if (rating.quality <= own[place - 1].quality) return;
    --place;
  } else {
    ++counts_[face];
  }
  for (; place > 0 && own[place - 1].quality < rating.quality; --place) own[place] = own[place - 1];
  own[place] = rating;
}

}  // namespace scantrove
