#include "core/session/painted_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/dataset/aligned_view.h"
#include "core/dataset/registered_depth.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_files.h"
#include "core/session/mask_camera.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

using PaintedArea = PaintedSurface::Area;

/// Error of the registration between image and map: half-centimetre voxels, pose and calibration.
constexpr float kRegistration_m = 0.008F;
constexpr float kMinMargin_px = 1.5F;
/// At a width of 640 pixels.
constexpr float kMaxMargin_px = 10, kWidthOfMargin_px = 640;
/// Part of a thin mask's half width that is unclear.
constexpr float kThinMargin = 0.5F;
/// Tolerance of the depth at which a voxel of the surface is visible.
constexpr float kSurface_m = 0.015F, kSurfacePerMeter = 0.005F;
/// The image shows something in front of the map if it is this much nearer.
constexpr float kInFront_m = 0.03F, kInFrontPerMeter = 0.01F;
/// Nearer points are behind the camera or at it.
constexpr float kNearest_m = 0.05F;
/// Places of each region from which its surface is searched; fewer pixels of a region show nothing of it.
constexpr std::size_t kPlacesOfRegion = 200;
constexpr int kLeastPixels = 6;

/// The painted areas in the pixels of a view.
class PaintedView {
 public:
  PaintedView(const RenderedView& view, const cv::Mat& depth_m, const MaskCorrection& correction)
      : K_(view.K), T_camera_world_(view.T_world_camera.inverse().cast<float>()) {
    const cv::Size size(K_.width, K_.height);
    const cv::Mat z = view.depth().z_m;
    z_m_ = z.empty() ? cv::Mat::zeros(size, CV_32FC1) : z.reshape(1, size.height).clone();
    cv::Mat measured_m;
    if (!depth_m.empty()) cv::resize(depth_m, measured_m, size, 0, 0, cv::INTER_NEAREST);
    if (!measured_m.empty()) hideBehind(measured_m);
    const cv::Mat added = scaled(correction.added, size), removed = scaled(correction.removed, size);
    areas_ = cv::Mat(size, CV_8UC1, cv::Scalar::all(static_cast<double>(PaintedArea::unclear)));
    markInside(added, PaintedArea::added);
    markInside(removed & (added == 0), PaintedArea::removed);
    markAway((added | removed) == 0);
  }

  [[nodiscard]] PaintedSurface::Sight at(const Eigen::Vector3f& point_world) const {
    const Eigen::Vector3f p = T_camera_world_ * point_world;
    if (!(p.z() > kNearest_m)) return {};
    const float u = K_.fx * p.x() / p.z() + K_.cx, v = K_.fy * p.y() / p.z() + K_.cy;
    const bool is_inside = u >= -0.5F && v >= -0.5F && u < static_cast<float>(K_.width) - 0.5F &&
                           v < static_cast<float>(K_.height) - 0.5F;
    if (!is_inside) return {};
    const cv::Point pixel(static_cast<int>(std::floor(u + 0.5F)), static_cast<int>(std::floor(v + 0.5F)));
    const float z = z_m_.at<float>(pixel);
    return {areaAt(pixel), z > 0 && std::abs(p.z() - z) <= kSurface_m + kSurfacePerMeter * z};
  }
  [[nodiscard]] PaintedArea areaAt(const cv::Point& pixel) const {
    return static_cast<PaintedArea>(areas_.at<std::uint8_t>(pixel));
  }
  [[nodiscard]] bool isVisible(const cv::Point& pixel) const { return z_m_.at<float>(pixel) > 0; }
  /// The error of the registration at a pixel.
  [[nodiscard]] float marginAt(const cv::Point& pixel) const {
    const float most = kMaxMargin_px * std::max(1.0F, static_cast<float>(K_.width) / kWidthOfMargin_px);
    const float z = z_m_.at<float>(pixel);
    return z > 0 ? std::clamp(K_.fx * kRegistration_m / z, kMinMargin_px, most) : kMinMargin_px;
  }

 private:
  static cv::Mat scaled(const PaintedPixels& pixels, const cv::Size& size) {
    cv::Mat mask;
    cv::resize(pixels.mask(), mask, size, 0, 0, cv::INTER_AREA);
    return mask >= 128;
  }
  void hideBehind(const cv::Mat& measured_m) {
    for (int y = 0; y < z_m_.rows; ++y) {
      for (int x = 0; x < z_m_.cols; ++x) {
        float& z = z_m_.at<float>(y, x);
        const float measured = measured_m.at<float>(y, x);
        if (measured > 0 && measured < z - kInFront_m - kInFrontPerMeter * z) z = 0;
      }
    }
  }
  void markInside(const cv::Mat& mask, PaintedArea area) {
    if (cv::countNonZero(mask) == 0) return;
    cv::Mat distances, labels;
    cv::distanceTransform(mask, distances, cv::DIST_L2, cv::DIST_MASK_5);
    std::vector<float> half_widths(static_cast<std::size_t>(cv::connectedComponents(mask, labels, 8, CV_32S)),
                                   0);
    const auto halfWidthAt = [&](int y, int x) -> float& {
      return half_widths[static_cast<std::size_t>(labels.at<int>(y, x))];
    };
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x)
        halfWidthAt(y, x) = std::max(halfWidthAt(y, x), distances.at<float>(y, x));
    }
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        if (mask.at<std::uint8_t>(y, x) == 0) continue;
        const float margin = std::min(marginAt({x, y}), kThinMargin * halfWidthAt(y, x));
        if (distances.at<float>(y, x) > margin)
          areas_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(area);
      }
    }
  }
  void markAway(const cv::Mat& unpainted) {
    cv::Mat distances;
    cv::distanceTransform(unpainted, distances, cv::DIST_L2, cv::DIST_MASK_5);
    for (int y = 0; y < areas_.rows; ++y) {
      for (int x = 0; x < areas_.cols; ++x) {
        if (distances.at<float>(y, x) > marginAt({x, y}))
          areas_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(PaintedArea::other);
      }
    }
  }

  Intrinsics K_;
  Eigen::Isometry3f T_camera_world_;
  cv::Mat z_m_;    // of the map, 0 where it is hidden
  cv::Mat areas_;  // PaintedArea
};

/// Some of the points, evenly.
std::vector<Eigen::Vector3f> someOf(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> some;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / kPlacesOfRegion)
    some.push_back(points[i]);
  return some;
}

/// Regions other than `region` beside the pixels that are marked, most pixels first.
std::vector<RegionId> regionsBeside(const RenderedView& view, const cv::Mat& marked, float reach_px,
                                    RegionId region) {
  cv::Mat near;
  const int radius = std::max(2, cvCeil(reach_px));
  cv::dilate(marked, near, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1}));
  std::map<RegionId, int> pixels;
  for (int y = 0; y < near.rows; ++y) {
    for (int x = 0; x < near.cols; ++x) {
      const RegionId other = view.regions[view.K.indexOf(x, y)];
      if (near.at<std::uint8_t>(y, x) != 0 && other && other != region) ++pixels[other];
    }
  }
  std::vector<RegionId> regions;
  for (const auto& [other, count] : pixels) regions.push_back(other);
  std::ranges::stable_sort(regions, std::greater<>{}, [&](RegionId other) { return pixels.at(other); });
  return regions;
}

std::string sizeOfImage(const Intrinsics& K) {
  return std::to_string(K.width) + " x " + std::to_string(K.height);
}

}  // namespace

PaintedSurface paintedSurface(const RenderedView& view, const cv::Mat& depth_m, RegionId region,
                              const MaskCorrection& correction) {
  // A new region takes surface of the operation's region, too.
  if (correction.makes_region) region = {};
  const auto painted = std::make_shared<const PaintedView>(view, depth_m, correction);
  PaintedSurface surface;
  surface.sight = [painted](const Eigen::Vector3f& point) { return painted->at(point); };
  if (view.regions.empty()) return surface;
  std::map<RegionId, std::vector<Eigen::Vector3f>> added;
  std::vector<Eigen::Vector3f> removed;
  cv::Mat gone = cv::Mat::zeros(view.K.height, view.K.width, CV_8UC1);
  float margin_px = 0;
  for (int y = 0; y < gone.rows; ++y) {
    for (int x = 0; x < gone.cols; ++x) {
      const std::size_t index = view.K.indexOf(x, y);
      const RegionId shown = view.regions[index];
      const bool is_estimated = !view.is_estimated.empty() && view.is_estimated[index] != 0;
      if (!shown || is_estimated || !painted->isVisible({x, y})) continue;
      const Eigen::Vector3f point = view.vertices_world[index].head<3>();
      if (painted->areaAt({x, y}) == PaintedArea::added && shown != region) {
        added[shown].push_back(point);
      } else if (painted->areaAt({x, y}) == PaintedArea::removed && shown == region) {
        removed.push_back(point);
        gone.at<std::uint8_t>(y, x) = 255;
        margin_px = std::max(margin_px, painted->marginAt({x, y}));
      }
    }
  }
  for (const auto& [shown, points] : added) {
    if (std::ssize(points) >= kLeastPixels) surface.added_world[shown] = someOf(points);
  }
  if (std::ssize(removed) >= kLeastPixels) {
    surface.removed_world = someOf(removed);
    surface.around = regionsBeside(view, gone, 3 * margin_px, region);
  }
  return surface;
}

Result<std::optional<PaintedSurface>> paintedSurfaceOf(OpenSession& session, const Operation& paint) {
  if (!paint.correction || paint.regions.size() != 1) return std::optional<PaintedSurface>();
  const MaskCorrection& correction = *paint.correction;
  const auto key = std::ranges::find(session.keyFrames(), correction.key_frame, &SavedKeyFrame::frame);
  const SavedFrame* frame = key == session.keyFrames().end() ? nullptr : session.frameOf(*key);
  if (frame == nullptr || !frame->isUsable())
    return fail("No image of frame " + std::to_string(correction.image) + " was kept in " +
                    session.folder().string() + ".",
                "Paint in a key frame; 'scantrove export' writes their images.");
  const KeyFrameInfo info = SessionScan::infoOf(session, *key, *frame);
  const bool has_color = !info.color_file.empty();
  const Intrinsics& K = has_color ? info.K_color : info.K_depth;
  for (const PaintedPixels* pixels : {&correction.added, &correction.removed}) {
    if (pixels->width == K.width && pixels->height == K.height) continue;
    return fail("The mask has " + std::to_string(pixels->width) + " x " + std::to_string(pixels->height) +
                    " pixels, the image of frame " + std::to_string(correction.image) + " has " +
                    sizeOfImage(K) + ".",
                "Paint a mask of the image's size.");
  }
  if (correction.this_image_only || paint.kind == OperationKind::unpaint)
    return std::optional<PaintedSurface>();
  KeyFrameInfo registered = info;
  if (!has_color) {
    registered.K_color = info.K_depth;
    registered.T_color_depth.setIdentity();
  }
  // Without its depth image, only the map hides surface.
  cv::Mat depth, depth_m;
  if (const Result<RgbdFrame> images = readKeyFrame(session.folder(), *key, *frame)) {
    const bool is_of_camera =
        images->depth.cols == info.K_depth.width && images->depth.rows == info.K_depth.height;
    if (is_of_camera) depth = images->depth;
    if (is_of_camera) depth_m = registerDepth(registered, depth);
  }
  SessionScan scan(session);
  const auto T = alignedPoseOf(scan, info, depth);
  if (!T) return fail(T.error());
  const auto view =
      session.pipeline().readout().renderView(*T, scaledDown(K, session.pipeline().workingIntrinsics()));
  if (!view) return fail(view.error());
  return std::optional(paintedSurface(*view, depth_m, paint.regions.front(), correction));
}

}  // namespace scantrove
