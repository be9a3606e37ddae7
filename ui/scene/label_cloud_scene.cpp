#include "ui/scene/label_cloud_scene.h"

#include <vtkCamera.h>

#include <algorithm>
#include <utility>

#include "ui/scene/splats.h"
#include "ui/scene/up_direction.h"

namespace scantrove {
namespace {

constexpr std::size_t kFirstLevelingPoints = 20'000;

void setBackdrop(vtkRenderer* renderer, const Rgb& top, const Rgb& bottom) {
  renderer->GradientBackgroundOn();
  renderer->SetBackground(bottom[0] / 255.0, bottom[1] / 255.0, bottom[2] / 255.0);
  renderer->SetBackground2(top[0] / 255.0, top[1] / 255.0, top[2] / 255.0);
}

Rgb between(const Rgb& a, const Rgb& b) {
  Rgb middle{};
  for (std::size_t c = 0; c < 3; ++c) middle[c] = static_cast<std::uint8_t>((a[c] + b[c]) / 2);
  return middle;
}

}  // namespace

LabelCloudScene::LabelCloudScene()
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      cloud_(renderer_),
      sensor_(renderer_),
      grid_(renderer_),
      measure_(renderer_),
      arrow_(renderer_),
      parts_(renderer_) {
  enableSplats(renderer_);
  setColors(Colors{});
}

void LabelCloudScene::setColors(const Colors& colors) {
  setBackdrop(renderer_, colors.background_top, colors.background_bottom);
  grid_.setColor(colors.grid);
  cloud_.setBackdrop(between(colors.background_top, colors.background_bottom));
  sensor_.setTrailColor(colors.trail);
}

void LabelCloudScene::clear() {
  cloud_.clear();
  sensor_.clear();
  measure_.show({});
  arrow_.hide();
  viewpoint_ = OrbitCamera();
  grid_.place({0, 1, 1.5F}, -Eigen::Vector3f::UnitY(), 2);
  following_ = true;
  has_pose_ = false;
  points_at_leveling_ = 0;
  up_ = -Eigen::Vector3f::UnitY();
}

void LabelCloudScene::updateBricks(std::span<const CloudBrick> changed) {
  cloud_.update(changed, {});
  if (has_pose_ && cloud_.pointCount() > std::max(kFirstLevelingPoints, 2 * points_at_leveling_)) levelOut();
}

void LabelCloudScene::beginParts(std::size_t points) {
  std::map<vtkProp*, std::size_t> part_of = cloud_.divide(points);
  std::size_t last = 0;
  for (const auto& [prop, part] : part_of) last = std::max(last, part);
  parts_.begin(std::move(part_of), last + 1);
}

void LabelCloudScene::updateAllButBricks(const ScanSnapshot& snapshot) {
  cloud_.update({}, snapshot.changed_regions);
  sensor_.setPose(snapshot.pose, snapshot.K);
  sensor_.setTrail(snapshot.trail);
  if (snapshot.frame_index < 0) return;

  const Eigen::Isometry3f T_world_camera = snapshot.pose.T_world_camera.cast<float>();
  if (!has_pose_) {
    R_world_camera_ = T_world_camera.linear();
    up_ = -R_world_camera_.col(1);
    viewpoint_.setUp(up_);
  }
  if (following_ && snapshot.pose.usable()) {
    // Looks over the sensor's shoulder at the surface in front of it.
    const Eigen::Vector3f center = T_world_camera.translation();
    const Eigen::Vector3f ahead = T_world_camera.linear().col(2);
    const Eigen::Vector3f side = T_world_camera.linear().col(0);
    const Eigen::Vector3f eye = center - 1.1F * ahead + 0.55F * viewpoint_.up() + 0.35F * side;
    viewpoint_.approach(eye, center + 1.5F * ahead, has_pose_ ? 0.12F : 1.0F);
  }
  has_pose_ = true;
}

void LabelCloudScene::levelOut() {
  points_at_leveling_ = cloud_.pointCount();
  up_ = findUp(cloud_.brickNormals(), R_world_camera_);
  if (following_) viewpoint_.setUp(up_);
  const Eigen::AlignedBox3f& box = cloud_.bounds();
  const Eigen::Vector3f center = box.center();
  cloud_.setHeights(up_, cloud_.floorHeight(up_), cloud_.heightAbove(up_, 0.98F));
  grid_.place(center + (cloud_.floorHeight(up_) - center.dot(up_)) * up_, up_, 0.6F * box.diagonal().norm());
}

void LabelCloudScene::setFollowing(bool following) {
  following_ = following;
  if (following) viewpoint_.setUp(up_);
}

void LabelCloudScene::fitAll(float aspect) {
  following_ = false;
  viewpoint_.setUp(up_);
  viewpoint_.fit(cloud_.bounds(), aspect);
}

void LabelCloudScene::fit(const Eigen::AlignedBox3f& box, float aspect) {
  if (box.isEmpty()) return;
  following_ = false;
  viewpoint_.fit(box, aspect);
  viewpoint_.zoom(1.35F);  // with a margin
}

void LabelCloudScene::lookFrom(StandardView from) {
  following_ = false;
  viewpoint_.setUp(up_);
  // The first view direction of the sensor, made horizontal.
  Eigen::Vector3f ahead = R_world_camera_.col(2) - R_world_camera_.col(2).dot(up_) * up_;
  if (ahead.norm() < 0.1F) ahead = -R_world_camera_.col(1) + R_world_camera_.col(1).dot(up_) * up_;
  ahead.normalize();
  const Eigen::Vector3f side = ahead.cross(up_);
  // Views from top and bottom are slightly tilted, because the camera cannot look along `up`.
  constexpr float kSlant = 0.05F;
  switch (from) {
    case StandardView::front:
      return viewpoint_.lookAlong(ahead);
    case StandardView::back:
      return viewpoint_.lookAlong(-ahead);
    case StandardView::left:
      return viewpoint_.lookAlong(side);
    case StandardView::right:
      return viewpoint_.lookAlong(-side);
    case StandardView::top:
      return viewpoint_.lookAlong(kSlant * ahead - up_);
    case StandardView::bottom:
      return viewpoint_.lookAlong(kSlant * ahead + up_);
  }
}

std::optional<float> LabelCloudScene::clipDistance() const {
  if (!clip_behind_target_m_) return std::nullopt;
  return std::max(0.0F, viewpoint_.distance() + *clip_behind_target_m_);
}

std::optional<Eigen::Vector3f> LabelCloudScene::pick(float x, float y, int width_px, int height_px) const {
  const float aspect = static_cast<float>(width_px) / static_cast<float>(std::max(1, height_px));
  const Eigen::Vector3f direction = viewpoint_.rayAt(x, y, aspect);
  // The distance of the plane along a ray grows with its angle to the view.
  const float clip_m = clipDistance().value_or(0) / direction.dot(viewpoint_.forward());
  return cloud_.pick(viewpoint_.eye() + clip_m * direction, direction,
                     OrbitCamera::radiansPerPixel(height_px));
}

bool LabelCloudScene::prepare(int width_px, int height_px, std::size_t point_budget,
                              std::size_t rebuild_budget) {
  parts_.end();
  Eigen::AlignedBox3f all = cloud_.bounds();
  all.extend(sensor_.bounds());
  all.extend(arrow_.bounds());
  vtkCamera* camera = renderer_->GetActiveCamera();
  viewpoint_.applyTo(camera, all);
  if (const std::optional<float> clip_m = clipDistance()) {
    const double* range = camera->GetClippingRange();
    const double nearest = std::max(range[0], static_cast<double>(*clip_m));
    camera->SetClippingRange(nearest, std::max(range[1], nearest + 1));
  }
  return cloud_.prepare(camera, width_px, height_px, point_budget, rebuild_budget);
}

}  // namespace scantrove
