#include "core/discovery/reach_history.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/check.h"
#include "core/discovery/region_points.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

/// Step between sampled pixels, in an image of 320 x 240. The error at an end stays well below kSlack_m.
constexpr int kStep_px = 2;
/// Ends within this distance are equal: surfaces are noisy, and labels vary along outlines.
constexpr float kSlack_m = 0.015F;
/// The image must continue behind an end by this much more.
constexpr int kMargin_px = 2;
/// A region that was too large is measured again after this many frames, because it may have split.
constexpr int kRecheckFrames = 60;

std::array<Eigen::Vector3f, ReachHistory::kAxes> makeAxes() {
  std::array<Eigen::Vector3f, ReachHistory::kAxes> axes;
  std::size_t count = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i at(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    // Of two opposite directions, the one with a positive last non-zero coordinate.
    const int sign = at.z() != 0 ? at.z() : (at.y() != 0 ? at.y() : at.x());
    if (sign > 0) axes[count++] = at.cast<float>().normalized();
  }
  SCANTROVE_CHECK(count == ReachHistory::kAxes);
  return axes;
}

const std::array<Eigen::Vector3f, ReachHistory::kAxes>& axes() {
  static const auto made = makeAxes();
  return made;
}

using Widths = Eigen::Matrix<float, static_cast<int>(ReachHistory::kAxes), 1>;

/// The sides of a box with known directions, and the error of its widths.
struct FittedSides {
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
  float misfit_m = 0;
};

/// `directions`: columns of a rotation. Sides along measured directions keep the measured length.
FittedSides sidesAlong(const Eigen::Matrix3f& directions, const Widths& widths) {
  // The width of a box along d is the sum of its sides, each times the cosine of its angle to d.
  Eigen::Matrix<float, static_cast<int>(ReachHistory::kAxes), 3> cosines;
  for (std::size_t axis = 0; axis < ReachHistory::kAxes; ++axis)
    cosines.row(static_cast<Eigen::Index>(axis)) =
        (directions.transpose() * axes()[axis]).cwiseAbs().transpose();
  FittedSides sides;
  sides.size_m = cosines.colPivHouseholderQr().solve(widths).cwiseMax(0.0F);
  constexpr float kSame = 1 - 1e-5F;  // cosine of parallel directions, less rounding
  for (Eigen::Index side = 0; side < 3; ++side) {
    Eigen::Index measured = 0;
    if (cosines.col(side).maxCoeff(&measured) > kSame) sides.size_m[side] = widths[measured];
  }
  sides.misfit_m = (cosines * sides.size_m - widths).norm();
  return sides;
}

/// Tells which points are far enough from the border to be true ends.
class Interior {
 public:
  Interior(const DiscoveryInput& input, const cv::Rect& visible_px)
      : visible_px_(visible_px),
        slack_px_m_(kSlack_m * std::max(input.view.K.fx, input.view.K.fy)),
        depth_(input.view.T_world_camera) {}
  [[nodiscard]] bool holds(int u, int v, const Eigen::Vector4f& vertex) const {
    const float z = depth_(vertex);
    constexpr float kNearest_m = 0.1F;  // no camera measures nearer depth
    const int margin = kMargin_px + static_cast<int>(std::ceil(slack_px_m_ / std::max(z, kNearest_m)));
    return u - visible_px_.x >= margin && v - visible_px_.y >= margin && visible_px_.br().x - u > margin &&
           visible_px_.br().y - v > margin;
  }

 private:
  cv::Rect visible_px_;
  float slack_px_m_;
  CameraDepth depth_;
};

}  // namespace

/// The reach of a region in one frame: of all of it, and of its part off the border.
struct ReachHistory::Seen {
  std::array<float, 2 * kAxes> all, inside;
  Seen() {
    all.fill(std::numeric_limits<float>::lowest());
    inside.fill(std::numeric_limits<float>::lowest());
  }

  void add(const Eigen::Vector3f& point, bool is_inside) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const float along = axes()[axis].dot(point);
      all[2 * axis] = std::max(all[2 * axis], along);
      all[2 * axis + 1] = std::max(all[2 * axis + 1], -along);
      if (!is_inside) continue;
      inside[2 * axis] = std::max(inside[2 * axis], along);
      inside[2 * axis + 1] = std::max(inside[2 * axis + 1], -along);
    }
  }
};

void ReachHistory::add(const DiscoveryInput& input, const cv::Rect& visible_px, float max_size_m) {
  ++frame_;
  std::erase_if(reaches_, [&](const auto& entry) {
    const Reach& reach = entry.second;
    return frame_ - reach.last_seen > (reach.is_too_large ? kRecheckFrames : kMemory);
  });
  std::unordered_map<RegionId, Seen> seen;
  const Interior interior(input, visible_px);
  RegionId last;
  Seen* of_last = nullptr;  // null: not needed
  const int step_px = kStep_px * stepOfMeans(input.view.K.width);
  for (int v = 0; v < input.view.K.height; v += step_px) {
    for (int u = 0; u < input.view.K.width; u += step_px) {
      const std::size_t pixel = input.view.K.indexOf(u, v);
      const RegionId region = input.regions[pixel];
      if (!region || !isSurface(input.view.vertices_world[pixel])) continue;
      if (region != last) {
        last = region;
        const auto known = reaches_.find(region);
        const bool is_requested = known == reaches_.end() || !known->second.is_too_large;
        of_last = is_requested ? &seen[region] : nullptr;
      }
      if (of_last != nullptr)
        of_last->add(input.view.vertices_world[pixel].head<3>(),
                     interior.holds(u, v, input.view.vertices_world[pixel]));
    }
  }
  for (const auto& [region, now] : seen) update(region, now, max_size_m);
}

void ReachHistory::update(RegionId region, const Seen& seen, float max_size_m) {
  const auto [entry, is_new] = reaches_.try_emplace(region);
  Reach& reach = entry->second;
  reach.last_seen = frame_;
  for (std::size_t i = 0; i < reach.ends.size(); ++i) {
    End& end = reach.ends[i];
    if (is_new || seen.all[i] > end.far_m + kSlack_m) {
      end = {seen.all[i], seen.inside[i] >= seen.all[i] - kSlack_m};
      reach.last_grown = frame_;
    } else {
      end.is_shown = end.is_shown || seen.inside[i] >= end.far_m - kSlack_m;
    }
  }
  reach.shown_part = 1;
  for (std::size_t i = 0; i < reach.ends.size(); i += 2) {
    const float width_m = reach.ends[i].far_m + reach.ends[i + 1].far_m;
    reach.is_too_large = reach.is_too_large || width_m > max_size_m;
    const float shown_m = seen.all[i] + seen.all[i + 1];
    reach.shown_part = std::min(reach.shown_part, width_m > kSlack_m ? shown_m / width_m : 1);
  }
}

float ReachHistory::shownPart(RegionId region) const {
  const auto found = reaches_.find(region);
  return found == reaches_.end() || found->second.last_seen != frame_ ? 0 : found->second.shown_part;
}

bool ReachHistory::isSeenToItsEnds(RegionId region, int frames) const {
  const auto found = reaches_.find(region);
  if (found == reaches_.end() || found->second.is_too_large) return false;
  return frame_ - found->second.last_grown >= frames &&
         std::ranges::all_of(found->second.ends, &End::is_shown);
}

Eigen::Vector3f ReachHistory::sizeOf(RegionId region, const Eigen::Matrix3f& axes) const {
  const auto found = reaches_.find(region);
  if (found == reaches_.end() || found->second.is_too_large) return Eigen::Vector3f::Zero();
  Widths widths;
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    widths[static_cast<Eigen::Index>(axis)] =
        found->second.ends[2 * axis].far_m + found->second.ends[2 * axis + 1].far_m;
  FittedSides best = sidesAlong(Eigen::Matrix3f::Identity(), widths);
  const auto consider = [&](const Eigen::Matrix3f& turned) {
    // Extents vary by the slack, so a slightly better fit does not count.
    if (const FittedSides other = sidesAlong(turned, widths); other.misfit_m < best.misfit_m - kSlack_m)
      best = other;
  };
  constexpr float kEighthOfATurn = std::numbers::pi_v<float> / 4;
  for (int axis = 0; axis < 3; ++axis)
    consider(Eigen::AngleAxisf(kEighthOfATurn, Eigen::Vector3f::Unit(axis)).toRotationMatrix());
  consider(axes);
  return best.size_m;
}

}  // namespace scantrove
