#include "ui/view/scene_view.h"

#include <QOpenGLContext>
#include <algorithm>
#include <utility>

#include "ui/view/qt_render_window.h"

namespace scantrove {
namespace {

constexpr int kSettle_ms = 350;
constexpr double kTakeOver_ms = 15;  ///< at a time

}  // namespace

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent) {
  setFormat(surfaceFormat());
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(240, 180);
  setAccessibleName(tr("3D view"));
  setAccessibleDescription(
      tr("The scanned scene as coloured points. Arrow keys turn, plus and minus zoom, Home shows all."));
  setMouseTracking(true);
  // What was drawn stays until the next drawing is complete.
  setUpdateBehavior(QOpenGLWidget::PartialUpdate);
  arrival_timer_.setSingleShot(true);
  connect(&arrival_timer_, &QTimer::timeout, this, &SceneView::takeOver);
  draw_timer_.setSingleShot(true);
  connect(&draw_timer_, &QTimer::timeout, this, &SceneView::drawUnlessPointing);
  settle_timer_.setSingleShot(true);
  settle_timer_.setInterval(kSettle_ms);
  connect(&settle_timer_, &QTimer::timeout, this, [this] {
    moving_ = false;
    resizing_ = false;
    schedule();
  });
  since_draw_.start();
}

SceneView::~SceneView() {
  // VTK frees its OpenGL objects while the context still lives.
  makeCurrent();
  window_.reset();
  scene_.clear();
  doneCurrent();
}

QSurfaceFormat SceneView::surfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setSwapBehavior(QSurfaceFormat::DoubleBuffer);
  format.setRedBufferSize(8);
  format.setGreenBufferSize(8);
  format.setBlueBufferSize(8);
  format.setAlphaBufferSize(8);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  format.setSamples(0);
  format.setSwapInterval(0);
  return format;
}

void SceneView::clearScene() {
  if (window_ != nullptr) makeCurrent();
  arrivals_.clear();
  scene_.clear();
  if (window_ != nullptr) doneCurrent();
  emit followingChanged(scene_.following());
  emit cleared();
  schedule();
}

void SceneView::showSnapshot(const std::shared_ptr<const ScanSnapshot>& snapshot) {
  arrivals_.add(snapshot);
  const auto isByPerson = [](const auto& change) { return change.by_person; };
  is_awaited_ = is_awaited_ || std::ranges::any_of(snapshot->changed_regions, isByPerson) ||
                std::ranges::any_of(snapshot->changed_bricks, isByPerson);
  takeOver();
  if (is_awaited_) draw_timer_.start(0);
}

void SceneView::takeOver() {
  if (!arrivals_.takeOver(kTakeOver_ms)) arrival_timer_.start(0);
  schedule();
}

void SceneView::setScanning(bool scanning) {
  scanning_ = scanning;
  schedule();
}

void SceneView::setColors(const LabelCloudScene::Colors& colors) {
  scene_.setColors(colors);
  schedule();
}

void SceneView::setFollowing(bool following) {
  if (following == scene_.following()) return;
  scene_.setFollowing(following);
  emit followingChanged(following);
  schedule();
}

void SceneView::fitAll() {
  scene_.fitAll(static_cast<float>(width()) / static_cast<float>(std::max(1, height())));
  emit followingChanged(false);
  schedule();
}

void SceneView::turn(float yaw) {
  scene_.viewpoint().orbit(yaw, 0);
  scanning_ ? schedule() : redraw(true);
}

void SceneView::setGridVisible(bool visible) {
  scene_.setGridVisible(visible);
  schedule();
}

void SceneView::setColoring(Coloring coloring) {
  scene_.setColoring(coloring);
  schedule();
}

void SceneView::setBackground(const std::set<RegionId>& regions, BackgroundLook look) {
  scene_.setBackground(regions, look);
  schedule();
}

void SceneView::lookFrom(StandardView from) {
  scene_.lookFrom(from);
  emit followingChanged(false);
  schedule();
}

void SceneView::fit(const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return;
  scene_.fit(box, static_cast<float>(width()) / static_cast<float>(std::max(1, height())));
  emit followingChanged(false);
  schedule();
}

void SceneView::initializeGL() {
  window_ = std::make_unique<QtRenderWindow>(*this, scene_.renderer());
  // A new context (the view moved to another window) knows nothing of the old one's framebuffers.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    window_.reset();
    doneCurrent();
  });
  is_old_ = true;
}

const cv::Mat& SceneView::regionIds() { return pointing_.regionIds(); }

RegionPoint SceneView::at(const QPointF& place) {
  if (width() < 1 || height() < 1) return {};
  return pointing_.at({place.x() / width(), place.y() / height()});
}

std::optional<QPointF> SceneView::placeOf(const Eigen::Vector3f& point_world) {
  const float aspect = static_cast<float>(width()) / static_cast<float>(std::max(1, height()));
  const auto place = scene_.viewpoint().placeOf(point_world, aspect);
  if (!place || place->cwiseAbs().maxCoeff() > 1) return std::nullopt;
  return QPointF((static_cast<double>(place->x()) + 1) / 2 * width(),
                 (1 - static_cast<double>(place->y())) / 2 * height());
}

}  // namespace scantrove
