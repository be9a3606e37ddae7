#include "core/session/row_checks.h"

#include <QVariant>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/image_header.h"

namespace scantrove::rows {
namespace {

/// Tolerance of a quaternion's length, and of a rotation's columns.
constexpr double kRounding = 1e-3;
constexpr float kLargestEvidence = 1e9F;
constexpr int kLargestSide_px = 1 << 16;
/// Limits of focal lengths and centres, relative to the image's side.
constexpr float kShortestFocal = 0.02F, kLongestFocal = 100, kFarthestCenter = 10;
constexpr float kLargestUnit_m = 10;

bool isWithin(std::int64_t value, Bounds bounds) { return value >= bounds.least && value <= bounds.most; }

bool isNear(const Eigen::Vector3d& place) {
  return place.allFinite() && place.cwiseAbs().maxCoeff() <= kFarthest_m;
}

bool isRigid(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  return isNear(T.translation()) && R.allFinite() &&
         (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kRounding &&
         R.determinant() > 0;
}

bool arePlaces(const std::vector<Eigen::Vector3f>& places) {
  return std::ranges::all_of(places,
                             [](const Eigen::Vector3f& place) { return isNear(place.cast<double>()); });
}

bool isFragment(FragmentId fragment) { return isWithin(fragment.value, kFragments); }

/// Also accepts none.
bool isRegion(RegionId region) { return region.value <= kRegions.most; }

bool isCorrection(const MaskCorrection& correction) {
  const PaintedPixels &added = correction.added, &removed = correction.removed;
  const ImageSize size{static_cast<std::uint32_t>(added.width), static_cast<std::uint32_t>(added.height)};
  return isWithin(correction.key_frame, kCounts) && isWithin(correction.image, kCounts) && added.width > 0 &&
         added.height > 0 && added.width == removed.width && added.height == removed.height &&
         checkImageSize(size, "").has_value();
}

bool isAlong(float focal, float center, int side) {
  const float share = focal / static_cast<float>(side);
  return side > 0 && side <= kLargestSide_px && share >= kShortestFocal && share <= kLongestFocal &&
         std::abs(center) <= kFarthestCenter * static_cast<float>(side);
}

}  // namespace

std::optional<std::int64_t> integerAt(const QSqlQuery& row, int column, Bounds bounds) {
  const QVariant value = row.value(column);
  if (value.typeId() != QMetaType::LongLong && value.typeId() != QMetaType::Int) return std::nullopt;
  const std::int64_t number = value.toLongLong();
  return isWithin(number, bounds) ? std::optional(number) : std::nullopt;
}

bool areIntegers(const QSqlQuery& row, int first_column, int last_column, Bounds bounds) {
  for (int column = first_column; column <= last_column; ++column) {
    if (!integerAt(row, column, bounds)) return false;
  }
  return true;
}

std::optional<Eigen::Isometry3d> poseAt(const QSqlQuery& row, int first_column) {
  const auto number = [&](int i) {
    bool is_number = false;
    const double value = row.value(first_column + i).toDouble(&is_number);
    return is_number ? value : std::nan("");
  };
  const Eigen::Vector3d place(number(0), number(1), number(2));
  const Eigen::Quaterniond rotation(number(6), number(3), number(4), number(5));
  // NaN and overflow fail the comparison.
  if (!isNear(place) || !(std::abs(rotation.norm() - 1) <= kRounding)) return std::nullopt;
  return Eigen::Isometry3d(Eigen::Translation3d(place) * rotation.normalized());
}

bool isPlausible(const Intrinsics& K) {
  return isAlong(K.fx, K.cx, K.width) && isAlong(K.fy, K.cy, K.height);
}

bool isPlausible(const SavedKeyFrame& key) {
  const bool is_unit = key.meters_per_unit > 0 && key.meters_per_unit <= kLargestUnit_m;
  const auto isSide = [](int side) { return side >= 0 && side <= kLargestSide_px; };
  if (!is_unit || !isSide(key.color_width) || !isSide(key.color_height)) return false;
  return !key.color_camera || (isPlausible(key.color_camera->K) && isRigid(key.color_camera->T_color_depth));
}

bool isPlausible(const BorderEvidence& e) {
  const auto isSmall = [](float value) { return std::abs(value) <= kLargestEvidence; };
  const bool are_colors_small =
      !e.colors ||
      (isSmall(e.colors->difference) && isSmall(e.colors->chroma_difference) && isSmall(e.colors->shared) &&
       isSmall(e.colors->shared_chroma) && isSmall(e.colors->elsewhere) && isSmall(e.colors->variety));
  return are_colors_small && isSmall(e.color_shift.value_or(0)) &&
         std::ranges::all_of(std::to_array({e.observations, e.bridged, e.shared, e.bends, e.concavity_rad,
                                            e.folded, e.ridged, e.length_m, e.appeared_together,
                                            e.appeared_apart, e.attached, e.unattached, e.step_m}),
                             isSmall);
}

bool isPlausible(const Operation& operation) {
  const bool is_paint = operation.kind == OperationKind::paint || operation.kind == OperationKind::unpaint;
  const bool is_review = operation.kind == OperationKind::review;
  if (is_review != operation.review.has_value() || (is_review && !operation.regions.empty())) return false;
  if (is_paint != operation.correction.has_value() || (is_paint && operation.regions.size() != 1))
    return false;
  if (is_paint && !isCorrection(*operation.correction)) return false;
  return std::ranges::all_of(operation.regions, isRegion) && arePlaces(operation.here_world) &&
         arePlaces(operation.there_world);
}

bool isPlausible(const OperationEffect& effect) {
  return std::ranges::all_of(effect.moves,
                             [](const RegionMove& move) {
                               return isFragment(move.fragment) && isRegion(move.before) &&
                                      isRegion(move.after);
                             }) &&
         std::ranges::all_of(effect.constraints,
                             [](const auto& constraint) {
                               return isFragment(constraint.a) && isFragment(constraint.b) &&
                                      constraint.a != constraint.b;
                             }) &&
         std::ranges::all_of(effect.notes, [](const auto& note) { return isRegion(note.region); }) &&
         (!effect.anchor || isFragment(effect.anchor)) && std::ranges::all_of(effect.created, isRegion);
}

}  // namespace scantrove::rows
