#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/nyu_labeled_writer.h"

namespace scantrove::test {

/// A synthetic room before the Kinect of NYUv2: two walls, a floor and two boxes of one class, all papered
/// with squares in random shades, so that a camera can be tracked. The numbers of the cameras are those of
/// the data set's toolbox (camera_params.m), which counts pixels from 1. World frame: the depth camera of
/// frame 0. Exact but for the steps of the raw depth.
class NyuRoom {
 public:
  static constexpr double kStep_m = 0.008;  ///< the camera moves to the right between frames

  struct Hit {
    double z = std::numeric_limits<double>::infinity();  ///< in the camera that looks
    int label = 0;                                       ///< 1 wall, 2 floor, 3 box
    int instance = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< world
  };

  explicit NyuRoom(const cv::Size& size) : size_(size) {
    depth_rays_ = raysOf(
        {5.8262448167737955e+02, 5.8269103270988637e+02, 3.1304475870804731e+02, 2.3844389626620386e+02},
        {-9.9897236553084481e-02, 3.9065324602765344e-01, 1.9290592870229277e-03, -1.9422022475975055e-03,
         -5.1031725053400578e-01});
    const std::array<double, 4> color{5.1885790117450188e+02, 5.1946961112127485e+02, 3.2558244941119034e+02,
                                      2.5373616633400465e+02};
    color_rays_ = raysOf(color, {2.0796615318809061e-01, -5.8613825163911781e-01, 7.2231363135888329e-04,
                                 1.0479627195765181e-03, 4.9856986684705107e-01});
    label_rays_ = raysOf(color, {0, 0, 0, 0, 0});
    Eigen::Matrix3d R;
    R << 9.9997798940829263e-01, 5.0518419386157446e-03, 4.3011152014118693e-03, -5.0359919480810989e-03,
        9.9998051861143999e-01, -3.6879781309514218e-03, -4.3196624923060242e-03, 3.6662365748484798e-03,
        9.9998394948385538e-01;
    T_color_depth_.linear() = R.transpose();
    T_color_depth_.translation() =
        -Eigen::Vector3d(2.5031875059141302e-02, -2.9342312935846411e-04, 6.6238747008330102e-04);
  }

  /// What the pixels of the undistorted colour camera show, row by row; z in that camera.
  [[nodiscard]] std::vector<Hit> view(int frame) const {
    return cast(label_rays_, pose(frame) * T_color_depth_.inverse());
  }

  /// Raw values of the Kinect, 11 bits: z = 351.3 / (1092.5 - raw).
  [[nodiscard]] cv::Mat1w rawDepth(int frame) const {
    cv::Mat1w raw(size_);
    const std::vector<Hit> hits = cast(depth_rays_, pose(frame));
    auto hit = hits.begin();
    for (std::uint16_t& value : raw)
      value = static_cast<std::uint16_t>(std::lround(1092.5 - 351.3 / (hit++)->z));
    return raw;
  }

  [[nodiscard]] cv::Mat3b color(int frame) const {
    static const std::array<cv::Vec3b, 5> kColors{
        {{0, 0, 0}, {200, 190, 180}, {60, 90, 120}, {40, 40, 190}, {180, 60, 30}}};
    cv::Mat3b image(size_);
    const std::vector<Hit> hits = cast(color_rays_, pose(frame) * T_color_depth_.inverse());
    auto hit = hits.begin();
    for (cv::Vec3b& pixel : image) {
      pixel =
          kColors[static_cast<std::size_t>(hit->label == 3 ? 2 + hit->instance : hit->label)] * shade(*hit);
      ++hit;
    }
    return image;
  }

  /// The labelled image of a frame, with `depth_file` as its origin.
  [[nodiscard]] LabeledImage labeled(int frame, const std::string& scene,
                                     const std::string& depth_file) const {
    LabeledImage image{scene, depth_file, cv::Mat1w(size_), cv::Mat1b(size_), cv::Mat1f(size_)};
    const std::vector<Hit> hits = view(frame);
    for (int i = 0; i < size_.area(); ++i) {
      const Hit& hit = hits[static_cast<std::size_t>(i)];
      image.labels(i / size_.width, i % size_.width) = static_cast<std::uint16_t>(hit.label);
      image.instances(i / size_.width, i % size_.width) = static_cast<std::uint8_t>(hit.instance);
      image.depth_m(i / size_.width, i % size_.width) = static_cast<float>(hit.z);
    }
    return image;
  }

  [[nodiscard]] cv::Size size() const { return size_; }

 private:
  using Rays = std::vector<Eigen::Vector3d>;

  /// The direction of each pixel, z = 1, of a lens with k1, k2, p1, p2, k3.
  [[nodiscard]] Rays raysOf(const std::array<double, 4>& camera, const std::array<double, 5>& lens) const {
    const double scale = size_.width / 640.0;
    const auto middle = [&](double c) { return (c - 1 + 0.5) * scale - 0.5; };
    const cv::Matx33d K(camera[0] * scale, 0, middle(camera[2]), 0, camera[1] * scale, middle(camera[3]), 0,
                        0, 1);
    std::vector<cv::Point2d> pixels, straight;
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) pixels.emplace_back(u, v);
    }
    cv::undistortPoints(pixels, straight, K, std::vector<double>(lens.begin(), lens.end()));
    Rays rays;
    for (const cv::Point2d& point : straight) rays.emplace_back(point.x, point.y, 1);
    return rays;
  }

  /// 0.6 to 1, the same in each square of 7 cm.
  static double shade(const Hit& hit) {
    std::uint32_t hash = 0;
    for (const double m : {hit.place.x(), hit.place.y(), hit.place.z()})
      hash = (hash + static_cast<std::uint32_t>(static_cast<int>(std::floor(m / 0.07 + 0.01)))) * 2654435761U;
    return 0.6 + 0.4 * static_cast<double>(hash >> 16 & 0xFF) / 255;
  }

  static Eigen::Isometry3d pose(int frame) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().x() = kStep_m * frame;
    return T;
  }

  static std::vector<Hit> cast(const Rays& rays, const Eigen::Isometry3d& T_world_camera) {
    std::vector<Hit> hits;
    for (const Eigen::Vector3d& ray : rays)
      hits.push_back(cast(T_world_camera.translation(), T_world_camera.linear() * ray));
    return hits;
  }

  /// `direction` has z = 1 in the camera, so that the distance along it is z.
  static Hit cast(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction) {
    Hit hit;
    const auto take = [&](double z, int label, int instance) {
      if (z > 0 && z < hit.z) hit = {z, label, instance, eye + z * direction};
    };
    take((2.4 - eye.z()) / direction.z(), 1, 1);
    take((-0.8 - eye.x()) / direction.x(), 1, 2);
    take((0.6 - eye.y()) / direction.y(), 2, 1);
    take(boxDistance(eye, direction, {-0.45, 0.1, 1.3}, {-0.05, 0.6, 1.7}), 3, 1);
    take(boxDistance(eye, direction, {0.15, 0.2, 1.5}, {0.5, 0.6, 1.9}), 3, 2);
    return hit;
  }

  static double boxDistance(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction,
                            const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low[axis] - eye[axis]) / direction[axis];
      const double b = (high[axis] - eye[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave ? enter : -1;
  }

  cv::Size size_;
  Rays depth_rays_, color_rays_, label_rays_;
  Eigen::Isometry3d T_color_depth_ = Eigen::Isometry3d::Identity();
};

/// Names of the files of frame `number`: colour comes 12 ms after depth, the counters are the device's.
inline std::string nyuName(char kind, int number) {
  char name[80];
  const int microseconds = 208451 + 33333 * number + (kind == 'r' ? 12000 : 0);
  std::snprintf(name, sizeof name, "%c-%d.%06d-%d.%s", kind, 1294886360 + microseconds / 1000000,
                microseconds % 1000000, 29967700 + number,
                kind == 'd'   ? "pgm"
                : kind == 'r' ? "ppm"
                              : "dump");
  return name;
}

/// Writes a depth image as the raw data set has it. PGM stores the high byte of a value first; the data set's
/// files have them the other way round.
inline void writeSwappedPgm(const std::filesystem::path& path, const cv::Mat1w& values) {
  std::ofstream file(path, std::ios::binary);
  file << "P5 " << values.cols << ' ' << values.rows << " 65535\n";
  for (const std::uint16_t value : values) {
    file.put(static_cast<char>(value & 0xFF));
    file.put(static_cast<char>(value >> 8));
  }
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

inline void writePpm(const std::filesystem::path& path, const cv::Mat3b& bgr) {
  std::ofstream file(path, std::ios::binary);
  file << "P6 " << bgr.cols << ' ' << bgr.rows << " 255\n";
  for (const cv::Vec3b& pixel : bgr) {
    for (const int channel : {2, 1, 0}) file.put(static_cast<char>(pixel[channel]));
  }
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

/// Writes frames `first` ... `first` + `count` - 1 of the room as a raw scene of NYUv2.
inline void writeNyuScene(const std::filesystem::path& folder, const NyuRoom& room, int count,
                          int first = 0) {
  std::filesystem::create_directories(folder);
  for (int i = first; i < first + count; ++i) {
    writeSwappedPgm(folder / nyuName('d', i), room.rawDepth(i));
    writePpm(folder / nyuName('r', i), room.color(i));
    std::ofstream(folder / nyuName('a', i)) << "accelerometer";
  }
  std::ofstream(folder / "INDEX.txt") << "list of files\n";
}

}  // namespace scantrove::test
