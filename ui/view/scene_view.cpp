#include "ui/view/scene_view.h"

#include <QPainter>
#include <algorithm>

namespace scantrove {
namespace {

constexpr double kTransfer_ms = 15;  ///< per step

}  // namespace

SceneView::SceneView(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(240, 180);
  setAccessibleName(tr("3D view"));
  setAccessibleDescription(
      tr("The scanned scene as coloured points. Arrow keys turn, plus and minus zoom, Home shows all."));
  setMouseTracking(true);
  transfer_timer_.setSingleShot(true);
  connect(&transfer_timer_, &QTimer::timeout, this, &SceneView::transfer);
  connect(&drawing_, &SceneDrawing::drawn, this, [this](const QSize& pixels) {
    pointing_.setDrawn(pixels, devicePixelRatioF());
    emit drawn();
  });
}

SceneView::~SceneView() {
  // VTK must free its OpenGL objects while the context exists.
  drawing_.makeCurrent();
  scene_.clear();
}

void SceneView::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  drawing_.paint(painter);
}

void SceneView::resizeEvent(QResizeEvent* /*event*/) { drawing_.redrawResized(); }

void SceneView::clearScene() {
  drawing_.makeCurrent();
  pending_snapshots_.clear();
  scene_.clear();
  emit followingChanged(scene_.following());
  emit cleared();
  drawing_.schedule();
}

void SceneView::showSnapshot(const std::shared_ptr<const ScanSnapshot>& snapshot) {
  pending_snapshots_.add(snapshot);
  const auto isByPerson = [](const auto& change) { return change.by_person; };
  const bool has_user_edit = std::ranges::any_of(snapshot->changed_regions, isByPerson) ||
                             std::ranges::any_of(snapshot->changed_bricks, isByPerson);
  transfer();
  if (has_user_edit) drawing_.drawUserEdit();
}

void SceneView::transfer() {
  if (!pending_snapshots_.transfer(kTransfer_ms)) transfer_timer_.start(0);
  drawing_.schedule();
}

void SceneView::setColors(const LabelCloudScene::Colors& colors) {
  scene_.setColors(colors);
  drawing_.schedule();
}

void SceneView::setFollowing(bool following) {
  if (following == scene_.following()) return;
  scene_.setFollowing(following);
  emit followingChanged(following);
  drawing_.schedule();
}

void SceneView::fitAll() {
  scene_.fitAll(static_cast<float>(width()) / static_cast<float>(std::max(1, height())));
  emit followingChanged(false);
  drawing_.schedule();
}

void SceneView::turn(float yaw) {
  scene_.viewpoint().orbit(yaw, 0);
  drawing_.isScanning() ? drawing_.schedule() : drawing_.redraw(true);
}

void SceneView::setGridVisible(bool visible) {
  scene_.setGridVisible(visible);
  drawing_.schedule();
}

void SceneView::setColoring(Coloring coloring) {
  scene_.setColoring(coloring);
  drawing_.schedule();
}

void SceneView::setBackground(const std::set<RegionId>& regions, BackgroundStyle style) {
  scene_.setBackground(regions, style);
  drawing_.schedule();
}

void SceneView::setSelected(const std::set<RegionId>& regions) {
  scene_.setSelected(regions);
  drawing_.schedule();
}

void SceneView::lookFrom(StandardView from) {
  scene_.lookFrom(from);
  emit followingChanged(false);
  drawing_.schedule();
}

void SceneView::lookFromCamera(const Eigen::Isometry3d& T_world_camera) {
  constexpr float kTarget_m = 1.5F;  // that the view then turns around
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  setFollowing(false);
  scene_.viewpoint().lookAt(T.translation(), T * Eigen::Vector3f(0, 0, kTarget_m));
  drawing_.schedule();
}

void SceneView::fit(const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return;
  scene_.fit(box, static_cast<float>(width()) / static_cast<float>(std::max(1, height())));
  emit followingChanged(false);
  drawing_.schedule();
}

const cv::Mat& SceneView::regionIds() { return pointing_.regionIds(); }

RegionPoint SceneView::at(const QPointF& position) {
  if (width() < 1 || height() < 1) return {};
  return pointing_.at({position.x() / width(), position.y() / height()});
}

std::optional<QPointF> SceneView::positionOf(const Eigen::Vector3f& point_world) {
  const float aspect = static_cast<float>(width()) / static_cast<float>(std::max(1, height()));
  const auto position = scene_.viewpoint().positionOf(point_world, aspect);
  if (!position || position->cwiseAbs().maxCoeff() > 1) return std::nullopt;
  return QPointF((static_cast<double>(position->x()) + 1) / 2 * width(),
                 (1 - static_cast<double>(position->y())) / 2 * height());
}

}  // namespace scantrove
