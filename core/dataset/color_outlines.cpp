#include "core/dataset/color_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// Error of an outline: half-centimetre voxels, pose and calibration; at the width of most depth cameras.
constexpr float kProjectionError_m = 0.008F;
constexpr int kUsualImageWidth = 640, kMinReach_px = 6, kMaxReach_px = 10;
/// Pixels are decided in squares of this side at that width, each with its own reach.
constexpr int kSquare_px = 64;
/// Variance of a colour channel (0 .. 1) that counts as noise: 2.5 of 255, squared.
constexpr float kColorNoise = 1e-4F;
/// Least part of a mask's variance that colour must explain for its outline to move.
constexpr float kMinExplained = 0.25F;

/// A pass over the undecided pixels; lengths relative to the reach.
struct ColorPass {
  float radius;  ///< of the windows
  float band;    ///< distance from an outline up to which pixels are undecided
  bool only_unmeasured;
};
/// Without depth, outlines are farther off: a structured-light camera sees no surface beside an object. Each
/// pass moves an outline by a part of its error. The finer windows of the last one follow corners.
constexpr std::array<ColorPass, 4> kPasses{
    {{2.0F, 2.5F, true}, {1.0F, 1.0F, false}, {1.0F, 1.0F, false}, {2.0F / 3, 2.0F / 3, false}}};

cv::Mat meanOfWindows(const cv::Mat& image, int radius) {
  cv::Mat mean;
  cv::boxFilter(image, mean, CV_32F, {2 * radius + 1, 2 * radius + 1}, {-1, -1}, true,
                cv::BORDER_REFLECT_101);
  return mean;
}

/// The colours of a crop in windows around each pixel.
class WindowColors {
 public:
  WindowColors(const cv::Mat& color, int radius) : radius_(radius) {
    color.convertTo(color_, CV_32F, 1.0 / 255);
    mean_ = meanOfWindows(color_, radius);
    cv::Mat products(color_.size(), CV_32FC(6));
    for (int y = 0; y < color_.rows; ++y) {
      const auto* in = color_.ptr<cv::Vec3f>(y);
      auto* out = products.ptr<Symmetric>(y);
      for (int x = 0; x < color_.cols; ++x) out[x] = squareOf(in[x]);
    }
    inverse_ = meanOfWindows(products, radius);
    for (int y = 0; y < color_.rows; ++y) {
      const auto* mean = mean_.ptr<cv::Vec3f>(y);
      auto* matrix = inverse_.ptr<Symmetric>(y);
      for (int x = 0; x < color_.cols; ++x) matrix[x] = inverseOf(matrix[x] - squareOf(mean[x]));
    }
  }

  /// How well the windows' colours predict a mask.
  struct Prediction {
    cv::Mat share;      ///< CV_32FC1, about 0 .. 1: of the mask in each pixel
    cv::Mat explained;  ///< CV_32FC1, 0 .. 1: part of the mask's variance
  };
  /// `mask`: CV_8UC1, 0 or 255, of the crop.
  [[nodiscard]] Prediction predict(const cv::Mat& mask) const {
    const cv::Mat model = meanOfWindows(modelOf(mask), radius_);
    Prediction result{cv::Mat(mask.size(), CV_32FC1), cv::Mat(mask.size(), CV_32FC1)};
    constexpr float kNoVariance = 1e-6F;
    for (int y = 0; y < mask.rows; ++y) {
      const auto* in = model.ptr<Symmetric>(y);
      const auto* color = color_.ptr<cv::Vec3f>(y);
      auto* share = result.share.ptr<float>(y);
      auto* explained = result.explained.ptr<float>(y);
      for (int x = 0; x < mask.cols; ++x) {
        share[x] = in[x][0] * color[x][0] + in[x][1] * color[x][1] + in[x][2] * color[x][2] + in[x][3];
        explained[x] = in[x][4] / std::max(in[x][5], kNoVariance);
      }
    }
    return result;
  }

 private:
  /// The upper triangle of a symmetric 3 x 3 matrix, row by row.
  using Symmetric = cv::Vec<float, 6>;

  static Symmetric squareOf(const cv::Vec3f& v) {
    return {v[0] * v[0], v[0] * v[1], v[0] * v[2], v[1] * v[1], v[1] * v[2], v[2] * v[2]};
  }
  /// Of a covariance, with noise added.
  static Symmetric inverseOf(const Symmetric& covariance) {
    const float a = covariance[0] + kColorNoise, b = covariance[1], c = covariance[2];
    const float d = covariance[3] + kColorNoise, e = covariance[4], f = covariance[5] + kColorNoise;
    const Symmetric adjugate(d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e,
                             a * d - b * b);
    return adjugate * (1 / (a * adjugate[0] + b * adjugate[1] + c * adjugate[2]));
  }

  /// CV_32FC(6), by window: the linear function of colour (three factors and the constant), the variance that
  /// it explains, and the mask's variance.
  [[nodiscard]] cv::Mat modelOf(const cv::Mat& mask) const {
    cv::Mat weighted = cv::Mat::zeros(mask.size(), CV_32FC4);
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        if (mask.at<std::uint8_t>(y, x) == 0) continue;
        const cv::Vec3f& color = color_.at<cv::Vec3f>(y, x);
        weighted.at<cv::Vec4f>(y, x) = {1, color[0], color[1], color[2]};
      }
    }
    weighted = meanOfWindows(weighted, radius_);
    cv::Mat model(mask.size(), CV_32FC(6));
    for (int y = 0; y < mask.rows; ++y) {
      const auto* sums = weighted.ptr<cv::Vec4f>(y);
      const auto* means = mean_.ptr<cv::Vec3f>(y);
      const auto* inverses = inverse_.ptr<Symmetric>(y);
      auto* out = model.ptr<Symmetric>(y);
      for (int x = 0; x < mask.cols; ++x) {
        const Symmetric& m = inverses[x];
        const float part = sums[x][0];
        const cv::Vec3f covariance = cv::Vec3f(sums[x][1], sums[x][2], sums[x][3]) - part * means[x];
        const cv::Vec3f factors(m[0] * covariance[0] + m[1] * covariance[1] + m[2] * covariance[2],
                                m[1] * covariance[0] + m[3] * covariance[1] + m[4] * covariance[2],
                                m[2] * covariance[0] + m[4] * covariance[1] + m[5] * covariance[2]);
        out[x] = {
            factors[0],       factors[1], factors[2], part - factors.dot(means[x]), factors.dot(covariance),
            part * (1 - part)};
      }
    }
    return model;
  }

  int radius_;
  cv::Mat color_, mean_, inverse_;
};

/// The regions in a crop, ascending.
std::vector<int> regionsIn(const cv::Mat& crop) {
  std::vector<int> found;
  for (int y = 0; y < crop.rows; ++y) {
    const auto* row = crop.ptr<int>(y);
    for (int x = 0; x < crop.cols; ++x) {
      if (x == 0 || row[x] != row[x - 1]) found.push_back(row[x]);
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

cv::Rect widened(const cv::Rect& box, int px) {
  return {box.x - px, box.y - px, box.width + 2 * px, box.height + 2 * px};
}

/// 1 on both sides of each outline, else 0; CV_8UC1.
cv::Mat outlinesOf(const cv::Mat& regions) {
  cv::Mat outlines = cv::Mat::zeros(regions.size(), CV_8UC1);
  for (int y = 0; y < regions.rows; ++y) {
    const auto* row = regions.ptr<int>(y);
    const auto* below = regions.ptr<int>(std::min(y + 1, regions.rows - 1));
    auto* out = outlines.ptr(y);
    auto* out_below = outlines.ptr(std::min(y + 1, regions.rows - 1));
    for (int x = 0; x < regions.cols; ++x) {
      if (x + 1 < regions.cols && row[x] != row[x + 1]) out[x] = out[x + 1] = 1;
      if (row[x] != below[x]) out[x] = out_below[x] = 1;
    }
  }
  return outlines;
}

/// One pass over an image.
class OutlinePass {
 public:
  OutlinePass(const cv::Mat& regions, const OutlineImages& images, const ColorPass& pass)
      : regions_(regions), images_(images), pass_(pass), result_(regions.clone()) {
    const int scale = std::max(1, cvRound(static_cast<float>(regions.cols) / kUsualImageWidth));
    square_px_ = kSquare_px * scale;
    min_reach_px_ = kMinReach_px * scale;
    max_reach_px_ = kMaxReach_px * scale;
    outlines_ = outlinesOf(regions);
    cv::distanceTransform(outlines_ == 0, distances_px_, cv::DIST_L2, cv::DIST_MASK_5);
  }

  cv::Mat run() {
    std::vector<cv::Rect> squares;
    for (int y = 0; y < regions_.rows; y += square_px_) {
      for (int x = 0; x < regions_.cols; x += square_px_)
        squares.push_back(cv::Rect(x, y, square_px_, square_px_) & cv::Rect({}, regions_.size()));
    }
    cv::parallel_for_({0, static_cast<int>(squares.size())}, [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i) decide(squares[static_cast<std::size_t>(i)]);
    });
    return result_;
  }

 private:
  /// The error of outlines in the square, from the nearest surface at one of them.
  [[nodiscard]] int reachIn(const cv::Rect& square) const {
    float nearest_m = 0;
    for (int y = square.y; y < square.br().y; ++y) {
      for (int x = square.x; x < square.br().x; ++x) {
        const float z = images_.z_m.at<float>(y, x);
        if (outlines_.at<std::uint8_t>(y, x) != 0 && z > 0 && (nearest_m == 0 || z < nearest_m))
          nearest_m = z;
      }
    }
    if (nearest_m == 0) return min_reach_px_;
    const float reach_px = std::min(images_.focal_px * kProjectionError_m / nearest_m, 1000.0F);
    return std::clamp(cvRound(reach_px), min_reach_px_, max_reach_px_);
  }

  /// Decides the square's undecided pixels; other squares are not touched.
  void decide(const cv::Rect& square) {
    const auto reach = static_cast<float>(reachIn(square));
    cv::Mat undecided = distances_px_(square) < pass_.band * reach;
    if (pass_.only_unmeasured) undecided &= images_.unmeasured(square) != 0;
    cv::Rect box = cv::boundingRect(undecided);
    if (box.empty()) return;
    undecided = undecided(box);
    box += square.tl();
    const int radius = std::max(2, cvRound(pass_.radius * reach));
    // A share depends on windows of windows.
    const cv::Rect crop = widened(box, 2 * radius) & cv::Rect({}, regions_.size());
    const cv::Mat around = regions_(crop);
    const std::vector<int> ids = regionsIn(regions_(widened(box, cvCeil(pass_.band * reach)) & crop));
    if (ids.size() < 2) return;
    const bool are_all = ids.size() == 2 && regionsIn(around).size() == 2;
    const WindowColors colors(images_.color(crop), radius);
    const cv::Rect inner = box - crop.tl();
    Winners winners(around(inner));
    for (const int id : ids) {
      const WindowColors::Prediction prediction = colors.predict(around == id);
      winners.add(id, prediction.share(inner), prediction.explained(inner));
      if (!are_all) continue;
      // The shares of all regions add up to 1.
      winners.add(ids.back(), 1 - prediction.share(inner), prediction.explained(inner));
      break;
    }
    winners.regions().copyTo(result_(box), undecided);
  }

  /// The region with the largest share by pixel.
  class Winners {
   public:
    explicit Winners(const cv::Mat& before)
        : before_(before),
          regions_(before.clone()),
          shares_(before.size(), CV_32FC1, cv::Scalar::all(-1e9)) {}

    void add(int region, const cv::Mat& share, const cv::Mat& explained) {
      for (int y = 0; y < shares_.rows; ++y) {
        auto* best = shares_.ptr<float>(y);
        for (int x = 0; x < shares_.cols; ++x) {
          const float here = share.at<float>(y, x);
          if (!(here > best[x])) continue;
          best[x] = here;
          regions_.at<int>(y, x) =
              explained.at<float>(y, x) >= kMinExplained ? region : before_.at<int>(y, x);
        }
      }
    }
    [[nodiscard]] const cv::Mat& regions() const { return regions_; }

   private:
    cv::Mat before_, regions_, shares_;
  };

  const cv::Mat& regions_;
  const OutlineImages& images_;
  ColorPass pass_;
  int square_px_ = 0, min_reach_px_ = 0, max_reach_px_ = 0;
  cv::Mat outlines_, distances_px_;
  cv::Mat result_;
};

}  // namespace

cv::Mat followColorEdges(const cv::Mat& regions, const OutlineImages& images) {
  const cv::Size size = regions.size();
  SCANTROVE_CHECK(regions.type() == CV_32SC1 && images.color.type() == CV_8UC3 &&
                  images.color.size() == size && images.z_m.type() == CV_32FC1 && images.z_m.size() == size &&
                  images.unmeasured.type() == CV_8UC1 && images.unmeasured.size() == size);
  cv::Mat result = regions;
  for (const ColorPass& pass : kPasses) result = OutlinePass(result, images, pass).run();
  return result;
}

}  // namespace scantrove
