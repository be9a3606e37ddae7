#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/dataset/labeled_scan.h"
#include "core/image/image_file.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

// World: z up, metres. A table with a box, a ball and a block, which a user rejected.
constexpr std::uint32_t kTable = 7, kBox = 12, kBall = 40, kBlock = 55;
inline const Eigen::Vector3d kBoxLow(-0.22, -0.08, 0), kBoxHigh(-0.04, 0.08, 0.2);
inline const Eigen::Vector3d kBallCenter(0.12, 0.02, 0.09);
constexpr double kBallRadius = 0.09;
inline const Eigen::Vector3d kBlockLow(0.26, -0.1, 0), kBlockHigh(0.34, -0.04, 0.06);
inline const std::string kBoxName = "Kiste/\"groß\"\n\\ 箱 📦";

/// Errors of the map: voxel size, thickness and drift.
struct MapFaults {
  double voxel_m = 0.006;  ///< labels are by voxel
  double swollen_m = 0.002;
  Eigen::Vector3d shift_m = Eigen::Vector3d(0.003, -0.002, 0.002);
};

/// Shapes with exact images.
class Shapes {
 public:
  explicit Shapes(double swollen_m = 0) {
    const Eigen::Vector3d swell = Eigen::Vector3d::Constant(swollen_m);
    parts_.emplace_back(kTable, AnalyticScene().plane({0, 0, 0}, {0, 0, 1}));
    parts_.emplace_back(kBox, AnalyticScene().box(kBoxLow - swell, kBoxHigh + swell));
    parts_.emplace_back(kBall, AnalyticScene().sphere(kBallCenter, kBallRadius + swollen_m));
    parts_.emplace_back(kBlock, AnalyticScene().box(kBlockLow - swell, kBlockHigh + swell));
  }

  /// Region ids and depths by pixel. `only`: the only visible region (0 = all).
  [[nodiscard]] ViewOfMap renderView(const Intrinsics& K, const Eigen::Isometry3d& T,
                                     std::uint32_t only = 0) const {
    ViewOfMap view{cv::Mat::zeros(K.height, K.width, CV_32SC1), cv::Mat::zeros(K.height, K.width, CV_32FC1)};
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        for (const auto& [id, shape] : parts_) {
          if (only != 0 && id != only) continue;
          const auto hit = shape.seenBy(K, T, u, v);
          float& z = view.depth_m.at<float>(v, u);
          if (!hit || hit->t > 4 || (z > 0 && hit->t >= double{z})) continue;
          z = static_cast<float>(hit->t);
          view.regions.at<int>(v, u) = static_cast<int>(id);
        }
      }
    }
    return view;
  }

  /// The region whose surface is nearest to `p`.
  static int nearest(const Eigen::Vector3d& p) {
    const auto toBox = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
      const Eigen::Vector3d q = (p - (low + high) / 2).cwiseAbs() - (high - low) / 2;
      return std::abs(q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0));
    };
    const std::pair<double, std::uint32_t> distances[] = {
        {std::abs(p.z()), kTable},
        {toBox(kBoxLow, kBoxHigh), kBox},
        {std::abs((p - kBallCenter).norm() - kBallRadius), kBall},
        {toBox(kBlockLow, kBlockHigh), kBlock}};
    return static_cast<int>(std::min_element(std::begin(distances), std::end(distances))->second);
  }

 private:
  std::vector<std::pair<std::uint32_t, AnalyticScene>> parts_;
};

/// A scan of the shapes, in memory except for its colour images. Key frames 0, 10, 20, ... around the table.
class ScannedScene : public LabeledScan {
 public:
  Intrinsics K_depth{262.5F, 262.5F, 159.5F, 119.5F, 320, 240};
  Intrinsics K_color{530, 531, 322, 241, 640, 480};
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d(Eigen::Translation3d(-0.025, 0.001, 0.002));
  float meters_per_unit = 0.001F;
  int frames = 3;
  std::string scan_name = "kitchen table";
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of all places and poses, in the recording's world
  std::vector<LabeledRegion> labels = standardLabels();
  std::vector<ObjectClass> class_list = {};
  MapFaults faults;
  std::set<int> without_color, with_damaged_color, with_damaged_depth;
  double depth_noise_px = 0.08;
  bool map_is_damaged = false;
  std::vector<SurfacePoint> estimated;  ///< more points of the cloud
  std::uint32_t divided = 0;            ///< a region whose middle band is unlabelled, which leaves two pieces
  std::function<void(int)> on_render = [](int) {};

  static std::vector<LabeledRegion> standardLabels() {
    const auto region = [](std::uint32_t id, const char* name, const char* category) {
      LabeledRegion r;
      r.id = id;
      r.name = name;
      r.category = category;
      r.voxels = 1000;
      r.box_world_m = Eigen::AlignedBox3f(Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones());
      return r;
    };
    std::vector<LabeledRegion> all{region(kBall, "ball", ""), region(kTable, "", ""), region(kBox, "", "box"),
                                   region(kBlock, "", ""), region(90, "", "")};
    all[1].background = true;
    all[2].name = kBoxName;
    all[2].object = 3;
    all[3].rejected = true;
    return all;
  }

  [[nodiscard]] Eigen::Isometry3d poseOf(int index) const {
    const double angle = 0.5 * index / 10 - 0.6;
    return lookAt(Eigen::Vector3d(0.75 * std::sin(angle), -0.75 * std::cos(angle), 0.55), {0.0, 0.03, 0.06},
                  {0, 0, 1});
  }

  [[nodiscard]] std::string name() const override { return scan_name; }
  [[nodiscard]] Eigen::Vector3d origin() const override { return origin_m; }
  [[nodiscard]] Result<std::vector<LabeledRegion>> regions() override { return labels; }
  [[nodiscard]] std::vector<ObjectClass> classes() override { return class_list; }
  [[nodiscard]] Result<std::vector<KeyFrameInfo>> keyFrames(bool all_frames) override {
    std::vector<KeyFrameInfo> infos;
    for (int i = 0; i < frames; ++i) {
      if (!all_frames && i % 2 == 1 && frames > 3) continue;
      KeyFrameInfo info;
      info.index = 10 * i;
      info.timestamp_s = info.index / 30.0;
      info.T_world_depth = poseOf(info.index);
      info.K_depth = K_depth;
      info.meters_per_unit = meters_per_unit;
      info.K_color = K_color;
      info.T_color_depth = T_color_depth;
      if (!without_color.contains(info.index)) info.color_file = colorFile(info);
      infos.push_back(info);
    }
    return infos;
  }
  [[nodiscard]] Result<cv::Mat> color(int index) override { return readColorImage(fileOf(index)); }
  [[nodiscard]] Result<cv::Mat> depth(int index) override {
    if (with_damaged_depth.contains(index))
      return fail("depth-" + std::to_string(index) + ".png is truncated.");
    const cv::Mat exact = Shapes().renderView(K_depth, poseOf(index)).depth_m;
    std::vector<float> z(exact.begin<float>(), exact.end<float>());
    if (depth_noise_px > 0)
      addDisparityNoise(z, K_depth, 5U + static_cast<unsigned>(index), 0.15, depth_noise_px);
    cv::Mat units(exact.size(), CV_16UC1);
    std::transform(z.begin(), z.end(), units.begin<std::uint16_t>(), [this](float value) {
      return static_cast<std::uint16_t>(std::lround(value / meters_per_unit));
    });
    return units;
  }
  [[nodiscard]] Result<ViewOfMap> renderView(const Intrinsics& K,
                                             const Eigen::Isometry3d& T_world_camera) override {
    on_render(++renderings_);
    if (map_is_damaged) return fail("map/bricks-0001 is damaged.");
    const Eigen::Isometry3d T = Eigen::Translation3d(faults.shift_m) * T_world_camera;
    ViewOfMap view = Shapes(faults.swollen_m).renderView(K, T);
    for (int v = 0; v < K.height && faults.voxel_m > 0; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const float z = view.depth_m.at<float>(v, u);
        if (!(z > 0)) continue;
        const Eigen::Vector3d p =
            T * K.backProject(static_cast<float>(u), static_cast<float>(v), z).cast<double>();
        const Eigen::Vector3d voxel = (p / faults.voxel_m).array().floor() + 0.5;
        view.regions.at<int>(v, u) = Shapes::nearest(voxel * faults.voxel_m);
      }
    }
    if (divided != 0) {
      const cv::Mat mask = view.regions == static_cast<int>(divided);
      view.regions.setTo(0, mask & ~dividedMask(mask));
    }
    return view;
  }
  /// A mask without the columns in its middle.
  [[nodiscard]] static cv::Mat dividedMask(const cv::Mat& mask) {
    const cv::Rect box = cv::boundingRect(mask);
    cv::Mat pieces = mask.clone();
    pieces.colRange(box.x + box.width * 2 / 5, box.x + box.width * 3 / 5).setTo(0);
    return pieces;
  }
  [[nodiscard]] Result<LabeledMesh> mesh() override { return surface(); }
  [[nodiscard]] Result<void> forEachPoint(const std::function<void(const SurfacePoint&)>& give) override {
    for (const SurfacePoint& point : surface().vertices) give(point);
    for (const SurfacePoint& point : estimated) give(point);
    return {};
  }
  [[nodiscard]] Result<Trajectory> trajectory() override {
    Trajectory poses;
    for (int i = 0; i < 10 * frames; ++i) poses.push_back({i / 30.0, poseOf(i)});
    return poses;
  }

  /// CV_8UC1, 255 where the colour camera of a frame sees the region; `with_occluded`: also behind others.
  [[nodiscard]] cv::Mat exactMask(int index, std::uint32_t region, bool with_occluded = false) const {
    const Eigen::Isometry3d T = poseOf(index) * T_color_depth.inverse();
    return Shapes().renderView(K_color, T, with_occluded ? region : 0).regions == static_cast<int>(region);
  }
  [[nodiscard]] std::filesystem::path fileOf(int index) const {
    return folder_ / ("frame " + std::to_string(index) + ".jpg");
  }

 private:
  /// Flat colours with shading and noise; written on first use.
  std::filesystem::path colorFile(const KeyFrameInfo& info) {
    const std::filesystem::path file = fileOf(info.index);
    if (std::filesystem::exists(file)) return file;
    if (with_damaged_color.contains(info.index)) {
      folder_.write(file.filename().string(), "\xFF\xD8\xFF truncated");
      return file;
    }
    const ViewOfMap view = Shapes().renderView(K_color, info.colorCameraPose());
    cv::Mat image(view.regions.size(), CV_8UC3);
    std::mt19937 random(static_cast<unsigned>(info.index));
    std::normal_distribution<float> noise(0, 3);
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        const Eigen::Vector3f rgb = colorOf(static_cast<std::uint32_t>(view.regions.at<int>(v, u)));
        const float light = 1 - 0.1F * static_cast<float>(v) / static_cast<float>(image.rows);
        for (int i = 0; i < 3; ++i)
          image.at<cv::Vec3b>(v, u)[2 - i] = cv::saturate_cast<std::uint8_t>(light * rgb[i] + noise(random));
      }
    }
    cv::imwrite(file.string(), image, {cv::IMWRITE_JPEG_QUALITY, 92});
    return file;
  }

  static Eigen::Vector3f colorOf(std::uint32_t region) {
    switch (region) {
      case kTable:
        return {150, 120, 90};
      case kBox:
        return {60, 110, 190};
      case kBall:
        return {200, 60, 50};
      case kBlock:
        return {80, 160, 70};
      default:
        return {20, 20, 20};
    }
  }

  /// A grid over a parallelogram, seen from the side that a x b points to.
  static void addSheet(LabeledMesh& mesh, std::uint32_t region, const Eigen::Vector3d& corner,
                       const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::uint32_t cells) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Eigen::Vector3f normal = a.cross(b).normalized().cast<float>();
    for (std::uint32_t j = 0; j <= cells; ++j) {
      for (std::uint32_t i = 0; i <= cells; ++i)
        addVertex(mesh, region, (corner + a * i / cells + b * j / cells).cast<float>(), normal);
    }
    for (std::uint32_t j = 0; j < cells; ++j) {
      for (std::uint32_t i = 0; i < cells; ++i) {
        const std::uint32_t p = first + j * (cells + 1) + i, q = p + cells + 1;
        mesh.faces.push_back({p, p + 1, q});
        mesh.faces.push_back({p + 1, q + 1, q});
      }
    }
  }
  static void addVertex(LabeledMesh& mesh, std::uint32_t region, const Eigen::Vector3f& p,
                        const Eigen::Vector3f& n) {
    const Eigen::Vector3f rgb = colorOf(region);
    mesh.vertices.push_back({p,
                             n,
                             {static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]),
                              static_cast<std::uint8_t>(rgb[2])},
                             region});
  }
  static void addBox(LabeledMesh& mesh, std::uint32_t region, const Eigen::Vector3d& low,
                     const Eigen::Vector3d& high) {
    const Eigen::Vector3d size = high - low;
    const Eigen::Vector3d x = size.x() * Eigen::Vector3d::UnitX(), y = size.y() * Eigen::Vector3d::UnitY(),
                          z = size.z() * Eigen::Vector3d::UnitZ();
    constexpr std::uint32_t kCells = 6;
    addSheet(mesh, region, low, y, x, kCells);
    addSheet(mesh, region, low + z, x, y, kCells);
    addSheet(mesh, region, low, x, z, kCells);
    addSheet(mesh, region, low + y, z, x, kCells);
    addSheet(mesh, region, low, z, y, kCells);
    addSheet(mesh, region, low + x, y, z, kCells);
  }
  static LabeledMesh surface() {
    LabeledMesh mesh;
    addSheet(mesh, kTable, {-0.6, -0.6, 0}, {1.2, 0, 0}, {0, 1.2, 0}, 40);
    addBox(mesh, kBox, kBoxLow, kBoxHigh);
    addBox(mesh, kBlock, kBlockLow, kBlockHigh);
    constexpr std::uint32_t kRings = 24, kSides = 48;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t j = 0; j <= kRings; ++j) {
      for (std::uint32_t i = 0; i <= kSides; ++i) {
        const double a = std::numbers::pi * j / kRings, b = 2 * std::numbers::pi * i / kSides;
        const Eigen::Vector3d n(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
        addVertex(mesh, kBall, (kBallCenter + kBallRadius * n).cast<float>(), n.cast<float>());
      }
    }
    for (std::uint32_t j = 0; j < kRings; ++j) {
      for (std::uint32_t i = 0; i < kSides; ++i) {
        const std::uint32_t p = first + j * (kSides + 1) + i, q = p + kSides + 1;
        mesh.faces.push_back({p, q, p + 1});
        mesh.faces.push_back({p + 1, q, q + 1});
      }
    }
    return mesh;
  }

  TemporaryFolder folder_;
  int renderings_ = 0;
};

/// Intersection over union of the pixels other than 0.
inline double iou(const cv::Mat& a, const cv::Mat& b) {
  const cv::Mat both = (a != 0) & (b != 0), any = (a != 0) | (b != 0);
  return cv::countNonZero(both) / std::max(1.0, double(cv::countNonZero(any)));
}

}  // namespace scantrove::test
