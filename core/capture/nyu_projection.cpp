#include "core/capture/nyu_projection.h"

#include <array>
#include <cmath>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr float kNearestReading_m = 0.35F, kFarthestReading_m = 10;

/// z of each raw value, 11 bits.
std::array<float, 2048> rawDepths() {
  std::array<float, 2048> depths{};
  for (std::size_t raw = 0; raw < depths.size(); ++raw) {
    const double z = 351.3 / (1092.5 - static_cast<double>(raw));
    if (z >= kNearestReading_m && z <= kFarthestReading_m) depths[raw] = static_cast<float>(z);
  }
  return depths;
}

/// The toolbox maps a point p of the depth camera to -R^T p + t, with the rotation R and the t below, and
/// then divides by z: signs cancel, so this is R^T p - t.
Eigen::Isometry3d toolboxTransform() {
  Eigen::Matrix3d R;
  R << 9.9997798940829263e-01, 5.0518419386157446e-03, 4.3011152014118693e-03,   //
      -5.0359919480810989e-03, 9.9998051861143999e-01, -3.6879781309514218e-03,  //
      -4.3196624923060242e-03, 3.6662365748484798e-03, 9.9998394948385538e-01;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
  T_color_depth.linear() = R.transpose();
  T_color_depth.translation() =
      -Eigen::Vector3d(2.5031875059141302e-02, -2.9342312935846411e-04, 6.6238747008330102e-04);
  return T_color_depth;
}

}  // namespace

NyuCameras nyuCameras(const cv::Size& size) {
  constexpr double kFirstPixel = 1;
  const auto camera = [&](double fx, double fy, double cx, double cy) {
    const Intrinsics K{static_cast<float>(fx),
                       static_cast<float>(fy),
                       static_cast<float>(cx - kFirstPixel),
                       static_cast<float>(cy - kFirstPixel),
                       640,
                       480};
    return K.resizedTo(size.width, size.height);
  };
  NyuCameras cameras;
  cameras.depth =
      camera(5.8262448167737955e+02, 5.8269103270988637e+02, 3.1304475870804731e+02, 2.3844389626620386e+02);
  cameras.color =
      camera(5.1885790117450188e+02, 5.1946961112127485e+02, 3.2558244941119034e+02, 2.5373616633400465e+02);
  cameras.depth_lens = {-9.9897236553084481e-02, 3.9065324602765344e-01, 1.9290592870229277e-03,
                        -1.9422022475975055e-03, -5.1031725053400578e-01};
  cameras.color_lens = {2.0796615318809061e-01, -5.8613825163911781e-01, 7.2231363135888329e-04,
                        1.0479627195765181e-03, 4.9856986684705107e-01};
  cameras.T_color_depth = toolboxTransform();
  return cameras;
}

float nyuDepth(std::uint16_t raw) {
  static const std::array<float, 2048> kDepths = rawDepths();
  return raw < kDepths.size() ? kDepths[raw] : 0;
}

NyuProjection::NyuProjection(const cv::Size& size)
    : cameras_(nyuCameras(size)),
      depth_undistorter_(cameras_.depth_lens, cameras_.depth),
      color_undistorter_(cameras_.color_lens, cameras_.color) {
  const Eigen::Matrix3f R = cameras_.T_color_depth.linear().cast<float>();
  rays_.reserve(static_cast<std::size_t>(size.area()));
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u)
      rays_.push_back(R * cameras_.depth.backProject(static_cast<float>(u), static_cast<float>(v), 1));
  }
}

cv::Mat NyuProjection::depth(const cv::Mat& raw) const {
  SCANTROVE_CHECK(raw.type() == CV_16UC1 && raw.size() == size());
  const cv::Mat1w straight = depth_undistorter_.ofDepth(raw);
  const Eigen::Vector3f offset = cameras_.T_color_depth.translation().cast<float>();
  const Intrinsics& K = cameras_.color;
  cv::Mat1w seen(size(), 0);
  std::size_t pixel = 0;
  for (const std::uint16_t value : straight) {
    const Eigen::Vector3f& ray = rays_[pixel++];
    const float z = nyuDepth(value);
    if (z <= 0) continue;
    const Eigen::Vector3f point = ray * z + offset;
    if (point.z() < kNearestReading_m) continue;
    const int u = static_cast<int>(std::floor(K.fx * point.x() / point.z() + K.cx + 0.5F));
    const int v = static_cast<int>(std::floor(K.fy * point.y() / point.z() + K.cy + 0.5F));
    if (!K.isInside(u, v)) continue;
    const auto units = static_cast<std::uint16_t>(std::lround(point.z() * kNyuUnitsPerMeter));
    std::uint16_t& place = seen(v, u);
    if (place == 0 || units < place) place = units;
  }
  return seen;
}

}  // namespace scantrove
