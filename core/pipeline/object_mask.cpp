#include "core/pipeline/object_mask.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/pipeline/standing_plane.h"

namespace scantrove {
namespace {

// Finding the object.
constexpr int kGridWidth = 160;            // columns of pixels in which it is sought
constexpr double kMiddlePart = 0.16;       // of the image's width and height, around the point
constexpr double kNearPart = 0.2;          // of the readings there that are nearer than a held object
constexpr double kSought_m = 0.3;          // it is within this distance of the point
constexpr double kNearPoint_m = 0.1;       // of several things the one near the point is meant
constexpr std::size_t kFewestPixels = 40;  // of the grid
constexpr double kGridStep_m = 0.03;       // neighbours in the grid that belong together
constexpr double kHeldBox_m = 0.3;         // size of the box around a held object
constexpr std::size_t kBoxOutliers = 3;    // of the grid, on each side
// Selecting its pixels.
constexpr double kAbove_m = 0.005;    // at up to 0.8 m: nearer to the plane is the plane's noise
constexpr double kAboveFrom_m = 0.8;  // from there on it grows with the depth squared
constexpr double kSlack_m = 0.012;    // the box is known so well
constexpr double kReach_m = 0.04;     // what is connected may reach so far out of the box
constexpr double kStep_m = 0.015;     // neighbouring pixels that belong together, at up to 1 m
constexpr double kSmallPart = 0.05;   // of the largest piece: smaller pieces are left out
// Its surroundings in the colour image.
constexpr int kColorCell_px = 4;
constexpr int kColorRim_cells = 3;

enum class Pixel : std::uint8_t { outside, near, inside };

/// Every few pixels of a depth image as points of the camera's frame; z = 0: no reading.
struct PointGrid {
  int width = 0, height = 0, stride = 1;
  std::vector<Eigen::Vector3d> points;

  [[nodiscard]] static bool isPoint(const Eigen::Vector3d& p) { return p.z() > 0; }
};

Eigen::Vector3d pointAt(int u, int v, double z_m, const Intrinsics& K) {
  return {(u - static_cast<double>(K.cx)) / static_cast<double>(K.fx) * z_m,
          (v - static_cast<double>(K.cy)) / static_cast<double>(K.fy) * z_m, z_m};
}

double depthAt(const RgbdFrame& frame, int u, int v) {
  return static_cast<double>(frame.meters_per_unit) * frame.depth.at<std::uint16_t>(v, u);
}

PointGrid gridOf(const RgbdFrame& frame, const Intrinsics& K) {
  PointGrid grid;
  grid.stride = std::max(1, frame.depth.cols / kGridWidth);
  grid.width = frame.depth.cols / grid.stride;
  grid.height = frame.depth.rows / grid.stride;
  grid.points.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const int u = column * grid.stride, v = row * grid.stride;
      grid.points.push_back(pointAt(u, v, depthAt(frame, u, v), K));
    }
  }
  return grid;
}

/// The point that a part of the readings in the window around `at_px` is nearer than. None: no readings.
std::optional<Eigen::Vector3d> pointNear(const PointGrid& grid, const Eigen::Vector2d& at_px, double part,
                                         const Intrinsics& K) {
  const double half_u = kMiddlePart / 2 * grid.width, half_v = kMiddlePart / 2 * grid.height;
  const double column = at_px.x() / grid.stride, row = at_px.y() / grid.stride;
  std::vector<double> depths_m;
  for (int r = 0; r < grid.height; ++r) {
    for (int c = 0; c < grid.width; ++c) {
      if (std::abs(c - column) > half_u || std::abs(r - row) > half_v) continue;
      const Eigen::Vector3d& point = grid.points[static_cast<std::size_t>(r * grid.width + c)];
      if (PointGrid::isPoint(point)) depths_m.push_back(point.z());
    }
  }
  if (depths_m.empty()) return std::nullopt;
  const auto nth =
      depths_m.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(depths_m.size()));
  std::nth_element(depths_m.begin(), nth, depths_m.end());
  return pointAt(static_cast<int>(at_px.x()), static_cast<int>(at_px.y()), *nth, K);
}

/// The points of the thing above the plane that is near `seed`. Empty: nothing stands there.
std::vector<Eigen::Vector3d> pointsOnPlane(const PointGrid& grid, const StandingPlane& plane,
                                           const Eigen::Vector3d& seed) {
  const auto isSought = [&](const Eigen::Vector3d& point) {
    return PointGrid::isPoint(point) && (point - seed).norm() < kSought_m &&
           plane.heightOf(point) > 2 * kAbove_m;
  };
  std::vector<bool> is_taken(grid.points.size(), false);
  std::vector<Eigen::Vector3d> best;
  double best_weight = 0;
  for (std::size_t first = 0; first < grid.points.size(); ++first) {
    if (is_taken[first] || !isSought(grid.points[first])) continue;
    std::vector<std::size_t> open{first};
    std::vector<Eigen::Vector3d> thing;
    double weight = 0;
    is_taken[first] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      const Eigen::Vector3d& point = grid.points[at];
      thing.push_back(point);
      const double relative = (point - seed).norm() / kNearPoint_m;
      weight += std::exp(-0.5 * relative * relative);
      const int column = static_cast<int>(at) % grid.width, row = static_cast<int>(at) / grid.width;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        const int c = column + dx, r = row + dy;
        if (c < 0 || r < 0 || c >= grid.width || r >= grid.height) continue;
        const auto next = static_cast<std::size_t>(r * grid.width + c);
        if (is_taken[next] || !isSought(grid.points[next])) continue;
        if (std::abs(grid.points[next].z() - point.z()) > kGridStep_m) continue;
        is_taken[next] = true;
        open.push_back(next);
      }
    }
    if (thing.size() < kFewestPixels || weight <= best_weight) continue;
    best_weight = weight;
    best = std::move(thing);
  }
  return best;
}

/// Box frame to camera: x to the right, z along `up`, its origin at `origin`.
Eigen::Isometry3d frameOf(const Eigen::Vector3d& up, const Eigen::Vector3d& origin) {
  Eigen::Isometry3d T_camera_box = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d right = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  T_camera_box.linear() << right, up.cross(right), up;
  T_camera_box.translation() = origin;
  return T_camera_box;
}

/// The box around the points, in their frame, without a few outliers on each side.
Eigen::AlignedBox3d boundsOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d bounds;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [axis](const Eigen::Vector3d& p) { return p[axis]; });
    std::ranges::sort(values);
    bounds.min()[axis] = values[kBoxOutliers];
    bounds.max()[axis] = values[values.size() - 1 - kBoxOutliers];
  }
  return bounds;
}

double leastHeight(double z_m) {
  const double relative = std::max(1.0, z_m / kAboveFrom_m);
  return kAbove_m * relative * relative;
}

Pixel placeOf(const Eigen::Vector3d& in_box, double z_m, const ObjectBox& box) {
  if (box.stands && in_box.z() < leastHeight(z_m)) return Pixel::outside;
  const double off_m = box.bounds.exteriorDistance(in_box);
  if (off_m <= (box.grows ? kSlack_m : 0)) return Pixel::inside;
  return box.grows && off_m <= kReach_m ? Pixel::near : Pixel::outside;
}

/// Leaves out pieces that are small beside the largest one.
void dropSmallPieces(cv::Mat1b& mask) {
  cv::Mat1i pieces, stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask, pieces, stats, centroids, 8);
  int largest = 0;
  for (int piece = 1; piece < count; ++piece) largest = std::max(largest, stats(piece, cv::CC_STAT_AREA));
  std::vector<std::uint8_t> is_kept(static_cast<std::size_t>(count), 0);
  for (int piece = 1; piece < count; ++piece)
    is_kept[static_cast<std::size_t>(piece)] =
        stats(piece, cv::CC_STAT_AREA) >= kSmallPart * largest ? 255 : 0;
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u) mask(v, u) = is_kept[static_cast<std::size_t>(pieces(v, u))];
}

/// The part of the colour image that shows the points, with a rim, in cells of a few pixels.
cv::Mat1b shownInColor(const RgbdFrame& frame, const Intrinsics& K_depth,
                       const std::vector<Eigen::Vector3d>& points_camera) {
  if (frame.color.empty()) return {};
  const int columns = (frame.color.cols + kColorCell_px - 1) / kColorCell_px;
  const int rows = (frame.color.rows + kColorCell_px - 1) / kColorCell_px;
  const Intrinsics K = (frame.color_camera ? frame.color_camera->K : K_depth).resizedTo(columns, rows);
  const Eigen::Isometry3d T_color_depth =
      frame.color_camera ? frame.color_camera->T_color_depth : Eigen::Isometry3d::Identity();
  cv::Mat1b shown(rows, columns, static_cast<unsigned char>(0));
  for (const Eigen::Vector3d& point : points_camera) {
    const Eigen::Vector3d p = T_color_depth * point;
    if (!(p.z() > 0)) continue;
    const auto u =
        static_cast<int>(std::lround(static_cast<double>(K.fx) * p.x() / p.z() + static_cast<double>(K.cx)));
    const auto v =
        static_cast<int>(std::lround(static_cast<double>(K.fy) * p.y() / p.z() + static_cast<double>(K.cy)));
    if (u >= 0 && v >= 0 && u < columns && v < rows) shown(v, u) = 255;
  }
  constexpr int kSide = 2 * kColorRim_cells + 1;
  cv::dilate(shown, shown, cv::getStructuringElement(cv::MORPH_ELLIPSE, {kSide, kSide}));
  return shown;
}

}  // namespace

RgbdFrame ObjectMask::apply(const RgbdFrame& frame) {
  const Intrinsics K = frame.intrinsics.value_or(K_);
  if (!std::exchange(is_followed_, false)) {
    has_gap_ = true;
    before_last_.reset();  // its motion is not known
  }
  mask_ = cv::Mat1b(frame.depth.rows, frame.depth.cols, static_cast<unsigned char>(0));
  points_camera_.clear();
  if (!T_box_map_) find(frame, K);
  if (box_) select(frame, K);
  RgbdFrame masked = frame;
  masked.depth = cv::Mat(frame.depth.rows, frame.depth.cols, frame.depth.type(), cv::Scalar(0));
  frame.depth.copyTo(masked.depth, mask_);
  masked.scanned = shownInColor(frame, K, points_camera_);
  return masked;
}

void ObjectMask::find(const RgbdFrame& frame, const Intrinsics& K) {
  box_.reset();
  const PointGrid grid = gridOf(frame, K);
  const Eigen::Vector2d at_px =
      choice_.at_px.value_or(Eigen::Vector2d(frame.depth.cols / 2.0, frame.depth.rows / 2.0));
  const std::optional<Eigen::Vector3d> seed = pointNear(grid, at_px, 0.5, K);
  if (!seed) return;
  std::vector<Eigen::Vector3d> readings;
  std::ranges::copy_if(grid.points, std::back_inserter(readings), PointGrid::isPoint);
  ObjectBox box;
  if (const std::optional<StandingPlane> plane = findStandingPlane(readings, *seed)) {
    std::vector<Eigen::Vector3d> thing = pointsOnPlane(grid, *plane, *seed);
    if (thing.empty()) return;
    const Eigen::Vector3d foot = *seed - plane->heightOf(*seed) * plane->normal;
    T_box_camera_ = frameOf(plane->normal, foot).inverse();
    for (Eigen::Vector3d& point : thing) point = T_box_camera_ * point;
    box.bounds = boundsOf(thing);
    box.bounds.min().z() = 0;
    box.stands = true;
    // Its back is not seen yet; most things are about as deep as wide.
    const double width_m = box.bounds.sizes().x();
    box.bounds.max().y() = std::max(box.bounds.max().y(), box.bounds.min().y() + width_m);
    box.grows = !choice_.box_m.has_value();
    if (choice_.box_m) {
      const Eigen::Vector3d middle = box.bounds.center(), half = *choice_.box_m / 2;
      box.bounds =
          Eigen::AlignedBox3d(Eigen::Vector3d(middle.x() - half.x(), middle.y() - half.y(), 0),
                              Eigen::Vector3d(middle.x() + half.x(), middle.y() + half.y(), 2 * half.z()));
    }
  } else {
    const std::optional<Eigen::Vector3d> front = pointNear(grid, at_px, kNearPart, K);
    if (!front) return;
    const Eigen::Vector3d usual(kHeldBox_m, kHeldBox_m, kHeldBox_m);
    const Eigen::Vector3d half = choice_.box_m.value_or(usual) / 2;
    T_box_camera_ = frameOf(-Eigen::Vector3d::UnitY(), *front).inverse();
    // The front is what is seen; a quarter of the box is before it.
    box.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(-half.x(), -half.y() / 2, -half.z()),
                                     Eigen::Vector3d(half.x(), 1.5 * half.y(), half.z()));
  }
  box_ = box;
}

Eigen::Isometry3d ObjectMask::expectedPose() const {
  if (!T_box_map_) return T_box_camera_;
  if (!before_last_) return *T_box_map_ * *last_;
  return *T_box_map_ * (*last_ * (before_last_->inverse() * *last_));
}

void ObjectMask::select(const RgbdFrame& frame, const Intrinsics& K) {
  const Eigen::Isometry3d T_box_camera = expectedPose();
  const int width = frame.depth.cols, height = frame.depth.rows;
  cv::Mat1b place(height, width, static_cast<unsigned char>(Pixel::outside));
  std::vector<cv::Point> open;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double z_m = depthAt(frame, u, v);
      if (!(z_m > 0)) continue;
      const Pixel pixel = placeOf(T_box_camera * pointAt(u, v, z_m, K), z_m, *box_);
      place(v, u) = static_cast<unsigned char>(pixel);
      if (pixel != Pixel::inside) continue;
      mask_(v, u) = 255;
      open.emplace_back(u, v);
    }
  }
  while (!open.empty()) {  // what is connected with the pixels inside
    const cv::Point at = open.back();
    open.pop_back();
    const double z_m = depthAt(frame, at.x, at.y);
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point next = at + step;
      if (next.x < 0 || next.y < 0 || next.x >= width || next.y >= height || mask_(next) != 0) continue;
      if (place(next) != static_cast<unsigned char>(Pixel::near)) continue;
      if (std::abs(depthAt(frame, next.x, next.y) - z_m) > kStep_m * std::max(1.0, z_m)) continue;
      mask_(next) = 255;
      open.push_back(next);
    }
  }
  dropSmallPieces(mask_);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      if (mask_(v, u) != 0) points_camera_.push_back(pointAt(u, v, depthAt(frame, u, v), K));
}

void ObjectMask::follow(const Eigen::Isometry3d& T_map_camera) {
  if (!box_) return;
  if (!T_box_map_) T_box_map_ = T_box_camera_ * T_map_camera.inverse();
  before_last_ = std::exchange(has_gap_, false) ? std::nullopt : last_;
  last_ = T_map_camera;
  is_followed_ = true;
  const Eigen::Isometry3d T_box_camera = *T_box_map_ * T_map_camera;
  std::vector<Eigen::Vector3d> in_box;
  in_box.reserve(points_camera_.size());
  for (const Eigen::Vector3d& point : points_camera_) in_box.push_back(T_box_camera * point);
  box_->growTo(in_box);
}

void ObjectMask::restart() {
  box_.reset();
  T_box_map_.reset();
  last_.reset();
  before_last_.reset();
  is_followed_ = true;
  has_gap_ = false;
}

}  // namespace scantrove
