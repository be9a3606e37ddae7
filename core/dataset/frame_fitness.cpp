#include "core/dataset/frame_fitness.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "core/image/sharpness.h"

namespace scantrove {
namespace {

constexpr int kSquaresAcross = 20, kMinSquare_px = 16;
/// Surface within such a cell is compared.
constexpr float kCell_m = 0.15F;
/// Views from distances up to this ratio show the same detail.
constexpr float kSimilarDistance = 1.5F;
/// Least number of squares for a judgement.
constexpr std::size_t kMinSquares = 10;
/// Below this part of the sharpness of others, an image is blurred over seven pixels or more.
constexpr float kBlurred = 0.25F;
/// Frames before and after a frame that it is compared with.
constexpr std::ptrdiff_t kNeighbors = 5;
/// Distance of depth and colour edges in an image 640 wide.
constexpr float kMaxShift_px = 4;
/// Fewer frames do not show what is usual.
constexpr std::size_t kMinFramesForUsual = 5;

/// `values` must not be empty.
float medianOf(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The point on the surface nearest to the centre of each square of the colour image: CV_32FC4, x, y, z in
/// the world and the depth in the colour camera; 0 = none.
cv::Mat placesOf(const KeyFrameInfo& frame, const cv::Mat& depth, const cv::Size& squares, int side_px) {
  cv::Mat places = cv::Mat::zeros(squares, CV_32FC4);
  cv::Mat distances(squares, CV_32FC1, cv::Scalar::all(std::numeric_limits<float>::max()));
  const int step = std::max(1, depth.cols / (4 * kSquaresAcross));
  const Intrinsics& K = frame.K_color;
  for (int v = step / 2; v < depth.rows; v += step) {
    for (int u = step / 2; u < depth.cols; u += step) {
      const float z = frame.meters_per_unit * static_cast<float>(depth.at<std::uint16_t>(v, u));
      if (!(z > 0)) continue;
      const Eigen::Vector3d p =
          frame.K_depth.backProject(static_cast<float>(u), static_cast<float>(v), z).cast<double>();
      const Eigen::Vector3f in_color = (frame.T_color_depth * p).cast<float>();
      if (!(in_color.z() > 0)) continue;
      const cv::Point2f pixel(K.fx * in_color.x() / in_color.z() + K.cx,
                              K.fy * in_color.y() / in_color.z() + K.cy);
      const auto side = static_cast<float>(side_px);
      const cv::Rect2f all(0, 0, side * static_cast<float>(squares.width),
                           side * static_cast<float>(squares.height));
      if (!all.contains(pixel)) continue;
      const cv::Point square(static_cast<int>(pixel.x / side), static_cast<int>(pixel.y / side));
      const cv::Point2f center((static_cast<float>(square.x) + 0.5F) * side,
                               (static_cast<float>(square.y) + 0.5F) * side);
      const auto distance = static_cast<float>(cv::norm(pixel - center));
      if (distance >= distances.at<float>(square)) continue;
      distances.at<float>(square) = distance;
      const Eigen::Vector3f in_world = (frame.T_world_depth * p).cast<float>();
      places.at<cv::Vec4f>(square) = {in_world.x(), in_world.y(), in_world.z(), in_color.z()};
    }
  }
  return places;
}

}  // namespace

void FrameFitness::add(const KeyFrameInfo& frame, const cv::Mat& depth, const cv::Mat& color) {
  frames_.push_back({frame.index, squaresOf(frame, depth, color), DepthShift(frame, depth, color)});
}

std::vector<FrameFitness::Square> FrameFitness::squaresOf(const KeyFrameInfo& frame, const cv::Mat& depth,
                                                          const cv::Mat& color) {
  const int side_px = std::max(kMinSquare_px, color.cols / kSquaresAcross);
  if (color.cols < side_px || color.rows < side_px) return {};
  const cv::Mat sharpness = sharpnessOfSquares(color, side_px);
  const cv::Mat places = placesOf(frame, depth, sharpness.size(), side_px);
  std::vector<Square> squares;
  for (int y = 0; y < sharpness.rows; ++y) {
    for (int x = 0; x < sharpness.cols; ++x) {
      if (sharpness.at<float>(y, x) == 0) continue;
      const auto& place = places.at<cv::Vec4f>(y, x);
      Square square{{}, place[3], sharpness.at<float>(y, x)};
      for (int i = 0; i < 3; ++i)
        square.cell[static_cast<std::size_t>(i)] = static_cast<int>(std::floor(place[i] / kCell_m));
      squares.push_back(square);
    }
  }
  return squares;
}

std::vector<std::optional<float>> FrameFitness::sharpnessOnSurface() const {
  struct View {
    std::size_t frame;
    float z_m, sharpness;
  };
  std::map<std::array<int, 3>, std::vector<View>> views;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    for (const Square& square : frames_[i].squares) {
      if (square.z_m > 0) views[square.cell].push_back({i, square.z_m, square.sharpness});
    }
  }
  std::vector<std::optional<float>> relative(frames_.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    std::vector<float> ratios;
    for (const Square& square : frames_[i].squares) {
      if (!(square.z_m > 0)) continue;
      float sharpest = 0;
      for (const View& view : views.at(square.cell)) {
        const float ratio = view.z_m / square.z_m;
        if (view.frame != i && ratio < kSimilarDistance && ratio > 1 / kSimilarDistance)
          sharpest = std::max(sharpest, view.sharpness);
      }
      if (sharpest > 0) ratios.push_back(square.sharpness / std::max(sharpest, square.sharpness));
    }
    if (ratios.size() >= kMinSquares) relative[i] = medianOf(std::move(ratios));
  }
  return relative;
}

std::vector<std::optional<float>> FrameFitness::sharpnessAmongNeighbors() const {
  std::vector<float> own;  // 0: unknown
  for (const Frame& frame : frames_) {
    std::vector<float> all;
    for (const Square& square : frame.squares) all.push_back(square.sharpness);
    own.push_back(all.size() < kMinSquares ? 0 : medianOf(std::move(all)));
  }
  std::vector<std::optional<float>> relative(frames_.size());
  const auto count = static_cast<std::ptrdiff_t>(own.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    std::vector<float> around(own.begin() + std::max<std::ptrdiff_t>(0, i - kNeighbors),
                              own.begin() + std::min(count, i + kNeighbors + 1));
    std::erase(around, 0.0F);
    const float here = own[static_cast<std::size_t>(i)];
    if (here > 0) relative[static_cast<std::size_t>(i)] = here / medianOf(std::move(around));
  }
  return relative;
}

cv::Point2f FrameFitness::usualShift() const {
  std::vector<float> across, down;
  for (const Frame& frame : frames_) {
    const std::optional<cv::Point2f> shift = frame.shift.best();
    if (!shift) continue;
    across.push_back(shift->x);
    down.push_back(shift->y);
  }
  if (across.size() < kMinFramesForUsual) return {};
  cv::Point2f usual(medianOf(std::move(across)), medianOf(std::move(down)));
  const auto length = static_cast<float>(cv::norm(usual));
  if (length > kMaxShift_px) usual *= kMaxShift_px / length;
  return usual;
}

std::map<int, std::string> FrameFitness::unfit() const {
  const std::vector<std::optional<float>> on_surface = sharpnessOnSurface();
  const std::vector<std::optional<float>> among_neighbors = sharpnessAmongNeighbors();
  const cv::Point2f usual = usualShift();
  std::map<int, std::string> reasons;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const std::optional<float> sharpness = on_surface[i] ? on_surface[i] : among_neighbors[i];
    const std::optional<cv::Point2f> shift = frames_[i].shift.best();
    const double apart = shift ? cv::norm(*shift - usual) : 0;
    if (sharpness && *sharpness < kBlurred) {
      reasons[frames_[i].index] =
          fmt::format("it is blurred, {:.0f} % as sharp as other frames", 100 * *sharpness);
    } else if (apart > kMaxShift_px && frames_[i].shift.isBetterThan(usual)) {
      reasons[frames_[i].index] =
          fmt::format("its depth and colour do not fit, their edges are {:.0f} pixels apart", apart);
    }
  }
  return reasons;
}

}  // namespace scantrove
