#include "core/fusion/color_integrator.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/base/check.h"
#include "core/compute/kernel_types.h"
#include "core/fusion/kernels/brick_work.h"
#include "core/fusion/kernels/color_voxel.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

constexpr int kSample_px = 6;           // side of the square with one sampled pixel
constexpr float kColorBand_vox = 1.5F;  // voxels up to this far from the surface get its colour
constexpr float kAcross_vox = 2;        // largest distance of such a voxel from its pixel's surface
constexpr int kWidest_px = 1280;        // of the colour image; voxels are coarser than pixels of a larger one
constexpr unsigned kTurns = 64;         // each brick has one turn; a large view takes some turns per frame
constexpr std::size_t kGroup = 8;       // bricks per work-group, with vectors

constexpr std::size_t cells(int pixels) {
  return static_cast<std::size_t>((pixels + COLOR_CELL - 1) / COLOR_CELL);
}

/// A copy with three bytes per pixel without gaps, at most kWidest_px wide.
cv::Mat compact(const cv::Mat& color) {
  if (color.cols > kWidest_px) {
    cv::Mat small;
    const double scale = static_cast<double>(kWidest_px) / color.cols;
    cv::resize(color, small, {}, scale, scale, cv::INTER_AREA);
    return small;
  }
  return color.isContinuous() ? color : color.clone();
}

Eigen::Vector3i brickAt(const Eigen::Vector3d& point, double brick_size_m) {
  return (point / brick_size_m).array().floor().cast<int>();
}

cl_float4 pointOf(const Eigen::Isometry3d& T) {
  const Eigen::Vector3f p = T.translation().cast<float>();
  return toKernel(p.x(), p.y(), p.z(), 0);
}

}  // namespace

Result<ColorIntegrator> ColorIntegrator::create(ComputeContext& compute, const FusionParams& params) {
  ColorIntegrator result(compute, params);
  SCANTROVE_TRY(moveInto(result.rate_pixels_, compute.kernel(kernels::fusion, "rate_pixels")));
  SCANTROVE_TRY(moveInto(result.color_bricks_, compute.kernel(kernels::fusion, "color_bricks")));
  return result;
}

void ColorIntegrator::integrate(BrickMap& map, const Surface& surface, const RgbdFrame& frame) {
  if (frame.color.empty()) return;
  ++turns_.frame;
  const Intrinsics& K = surface.maps.K;
  const Eigen::Isometry3d& T_world_camera = surface.maps.T_world_camera;
  const double voxel_size_m = map.voxelSize();
  const Eigen::Vector3i first = brickAt(T_world_camera.translation(), BRICK_SIDE * voxel_size_m);
  listBricks(map, surface.view, first);
  if (host_bricks_.empty()) return;

  const cv::Mat image = compact(frame.color);
  const ColorCamera camera = frame.color_camera.value_or(ColorCamera{K, Eigen::Isometry3d::Identity()});
  const Intrinsics K_color = camera.K.resizedTo(image.cols, image.rows);
  const Eigen::Isometry3d T_world_color = T_world_camera * camera.T_color_depth.inverse();
  rate(map, surface, T_world_color);

  fit(image_, 3 * image.total() + 1);  // pixels are read four bytes at a time
  image_.write(compute_->queue(), {image.ptr<cl_uchar>(), 3 * image.total()});
  fit(bricks_, host_bricks_.size());
  bricks_.write(compute_->queue(), host_bricks_);
  const auto fromBricks = [&](const Eigen::Isometry3d& T_world) {
    Eigen::Isometry3d T = T_world.inverse();
    T.translate(Eigen::Vector3d(first.cast<double>() * (BRICK_SIDE * voxel_size_m)));
    T.linear() *= voxel_size_m;
    return toKernel(T);
  };
  const auto band =
      static_cast<cl_int>(DISTANCE_ONE * std::min(kColorBand_vox / params_.truncation_vox, 1.0F));
  const std::size_t items = BRICK_ITEMS(compute_->lanes().count());
  color_bricks_.launch(cl::NDRange(items * host_bricks_.size()), cl::NDRange(items > 1 ? items : kGroup),
                       bricks_, static_cast<cl_int>(host_bricks_.size()),
                       cl_int4{{first.x(), first.y(), first.z(), static_cast<cl_int>(turns_.frame)}},
                       fromBricks(T_world_camera), toKernel(K.fx, K.fy, K.cx, K.cy),
                       cl_int2{{K.width, K.height}}, depths_, ratings_, fromBricks(T_world_color),
                       toKernel(K_color.fx, K_color.fy, K_color.cx, K_color.cy),
                       cl_int2{{image.cols, image.rows}}, image_, band, map.pools().distances(),
                       map.pools().weights(), map.pools().colors());
}

void ColorIntegrator::rate(const BrickMap& map, const Surface& surface,
                           const Eigen::Isometry3d& T_world_color) {
  const Intrinsics& K = surface.maps.K;
  const DepthPyramid::Level& readings = surface.readings.levels.front();
  SCANTROVE_CHECK(readings.K.width == K.width && readings.K.height == K.height);
  SCANTROVE_CHECK(surface.hidden.isContinuous() && surface.hidden.cols == K.width &&
                  surface.hidden.rows == K.height);
  fit(hidden_, surface.hidden.total());
  hidden_.write(compute_->queue(), {surface.hidden.ptr<cl_uchar>(), surface.hidden.total()});
  const std::size_t count = cells(K.width) * cells(K.height);
  fit(depths_, count);
  fit(ratings_, count);
  constexpr float kInNoise = 3;  // standard deviations
  const cl_float2 apart{{kAcross_vox * map.voxelSize(), kInNoise * params_.depth_noise_m}};
  rate_pixels_.launch(cl::NDRange(cells(K.width), cells(K.height)), Lanes::pixelGroup(),
                      surface.maps.vertices_world, surface.maps.normals_world, readings.vertices_camera,
                      hidden_, K.width, K.height, toKernel(surface.maps.T_world_camera.inverse()),
                      pointOf(surface.maps.T_world_camera), pointOf(T_world_color), std::min(K.fx, K.fy),
                      kAcross_vox * map.voxelSize(), apart, depths_, ratings_);
}

// The sampled pixels change from frame to frame, so that distant bricks, smaller than a square, get a turn,
// too. Nothing here may depend on slots, because these differ with the memory budget.
void ColorIntegrator::listBricks(const BrickMap& map, const RenderedView& view,
                                 const Eigen::Vector3i& first) {
  host_bricks_.clear();
  listed_in_.resize(static_cast<std::size_t>(map.device().slotEnd()), 0);
  const float voxel_m = map.voxelSize();
  const float bricks_per_meter = 1 / (BRICK_SIDE * voxel_m);
  const auto add = [&](const Eigen::Vector3i& brick) {
    const int slot = map.device().slotOf(brick);
    if (slot == BRICK_NONE) return;
    std::uint32_t& listed_in = listed_in_[static_cast<std::size_t>(slot)];
    if (std::exchange(listed_in, turns_.frame) == turns_.frame) return;
    const Eigen::Vector3i local = brick - first;
    host_bricks_.push_back({{local.x(), local.y(), local.z(), slot}});
  };
  const auto brickOf = [&](const Eigen::Vector3f& p) -> Eigen::Vector3i {
    return (p * bricks_per_meter).array().floor().cast<int>();
  };
  const unsigned choice = brick_hash(static_cast<int>(turns_.frame), 0, 0);
  const int first_u = static_cast<int>(choice % kSample_px);
  const int first_v = static_cast<int>(choice / kSample_px % kSample_px);
  Eigen::Vector3i last_low = Eigen::Vector3i::Constant(std::numeric_limits<int>::max());
  Eigen::Vector3i last_high = last_low;
  for (int v = first_v; v < view.K.height; v += kSample_px) {
    for (int u = first_u; u < view.K.width; u += kSample_px) {
      const int pixel = v * view.K.width + u;
      const Eigen::Vector4f& vertex = view.vertices_world[static_cast<std::size_t>(pixel)];
      if (!(vertex.w() > 0)) continue;
      const Eigen::Vector3f reach = Eigen::Vector3f::Constant(voxel_m);
      const Eigen::Vector3i low = brickOf(vertex.head<3>() - reach);
      const Eigen::Vector3i high = brickOf(vertex.head<3>() + reach);
      if (low == last_low && high == last_high) continue;
      last_low = low;
      last_high = high;
      for (int z = low.z(); z <= high.z(); ++z) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int x = low.x(); x <= high.x(); ++x) add({x, y, z});
        }
      }
    }
  }
  if (host_bricks_.size() <= kBricksAtATime) return;
  const auto most = static_cast<unsigned>(kTurns * kBricksAtATime / host_bricks_.size());
  const unsigned turns = std::max(1U, most);
  std::erase_if(host_bricks_, [&](const cl_int4& b) {
    const unsigned turn = brick_hash(first.x() + b.s[0], first.y() + b.s[1], first.z() + b.s[2]) % kTurns;
    return (turn + kTurns - turns_.first) % kTurns >= turns;
  });
  turns_.first = (turns_.first + turns) % kTurns;
}

}  // namespace scantrove
