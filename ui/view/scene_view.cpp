#include "ui/view/scene_view.h"

#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <algorithm>
#include <utility>

namespace scantrove {
namespace {

constexpr double kTimeShareWhileScanning = 0.15;
constexpr int kShortestInterval_ms = 150;  ///< while scanning
constexpr int kLongestInterval_ms = 2000;
constexpr int kSettle_ms = 350;
constexpr int kPointing_ms = 150;
constexpr std::size_t kRebuildWhileScanningPoints = 150'000;

}  // namespace

/// VTK's render window in Qt's context. Answers VTK's questions about the context.
class SceneView::RenderWindow {
 public:
  RenderWindow(SceneView& view, vtkRenderer* renderer)
      : view_(view), window_(vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New()) {
    window_->SetOwnContext(0);
    window_->SetFrameBlitModeToNoBlit();
    window_->SetMultiSamples(0);
    window_->SetReadyForRendering(true);
    window_->SetMapped(1);
    window_->SetIsDirect(1);
    window_->SetSupportsOpenGL(1);
    observe(vtkCommand::WindowMakeCurrentEvent, onMakeCurrent);
    observe(vtkCommand::WindowIsCurrentEvent, onIsCurrent);
    window_->AddRenderer(renderer);
    window_->OpenGLInitContext();
  }

  ~RenderWindow() { window_->Finalize(); }
  RenderWindow(const RenderWindow&) = delete;
  RenderWindow& operator=(const RenderWindow&) = delete;

  [[nodiscard]] vtkGenericOpenGLRenderWindow& vtk() { return *window_; }

 private:
  using Callback = void (*)(vtkObject*, unsigned long, void*, void*);

  void observe(unsigned long event, Callback callback) {
    const auto command = vtkSmartPointer<vtkCallbackCommand>::New();
    command->SetCallback(callback);
    command->SetClientData(&view_);
    window_->AddObserver(event, command);
  }

  /// makeCurrent() also binds Qt's framebuffer: harmful while VTK is drawing into its own. Only when needed.
  static void onMakeCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client, void* /*data*/) {
    auto* view = static_cast<SceneView*>(client);
    if (QOpenGLContext::currentContext() != view->context()) view->makeCurrent();
  }

  static void onIsCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client, void* data) {
    const auto* view = static_cast<SceneView*>(client);
    *static_cast<bool*>(data) =
        view->context() != nullptr && QOpenGLContext::currentContext() == view->context();
  }

  SceneView& view_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

SceneView::SceneView(QWidget* parent) : QOpenGLWidget(parent) {
  setFormat(surfaceFormat());
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(240, 180);
  setAccessibleName(tr("3D view"));
  setAccessibleDescription(
      tr("The scanned scene as coloured points. Arrow keys turn, plus and minus zoom, Home shows all."));
  setMouseTracking(true);
  draw_timer_.setSingleShot(true);
  connect(&draw_timer_, &QTimer::timeout, this, &SceneView::drawUnlessPointing);
  settle_timer_.setSingleShot(true);
  settle_timer_.setInterval(kSettle_ms);
  connect(&settle_timer_, &QTimer::timeout, this, [this] {
    moving_ = false;
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
  scene_.clear();
  if (window_ != nullptr) doneCurrent();
  emit followingChanged(scene_.following());
  emit cleared();
  schedule();
}

void SceneView::showSnapshot(const ScanSnapshot& snapshot) {
  scene_.update(snapshot);
  const auto isByPerson = [](const auto& change) { return change.by_person; };
  if (std::ranges::any_of(snapshot.changed_regions, isByPerson) ||
      std::ranges::any_of(snapshot.changed_bricks, isByPerson)) {
    is_awaited_ = true;
    draw_timer_.start(0);
  }
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
  schedule();
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

void SceneView::redraw(bool moving) {
  if (!moving) return schedule();
  moving_ = true;
  settle_timer_.start();
  draw_timer_.start(0);
}

void SceneView::schedule() {
  if (draw_timer_.isActive()) return;
  int wait_ms = 0;
  if (scanning_ && !moving_) {
    const int interval_ms = std::clamp(static_cast<int>(draw_ms_ / kTimeShareWhileScanning),
                                       kShortestInterval_ms, kLongestInterval_ms);
    wait_ms = std::max(0, interval_ms - static_cast<int>(since_draw_.elapsed()));
  }
  draw_timer_.start(wait_ms);
}

void SceneView::drawUnlessPointing() {
  // A drawing holds the window up: not between two steps of the pointer, who wants to see what it points at.
  const bool is_pointing = scanning_ && !moving_ && !is_awaited_ && since_pointed_.isValid() &&
                           since_pointed_.elapsed() < kPointing_ms &&
                           since_draw_.elapsed() < kLongestInterval_ms;
  if (is_pointing) {
    draw_timer_.start(kPointing_ms);
    return;
  }
  is_awaited_ = false;
  is_old_ = true;
  update();
}

PointBudget& SceneView::budget() {
  if (moving_) return moving_budget_;
  return scanning_ ? scanning_budget_ : still_budget_;
}

void SceneView::initializeGL() {
  window_ = std::make_unique<RenderWindow>(*this, scene_.renderer());
  // A new context (the view moved to another window) knows nothing of the old one's framebuffers.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    window_.reset();
    doneCurrent();
  });
  is_old_ = true;
}

void SceneView::paintGL() {
  QElapsedTimer timer;
  timer.start();
  const QSize pixels = size() * devicePixelRatioF();
  vtkGenericOpenGLRenderWindow& window = window_->vtk();
  if (!std::exchange(is_old_, false) && pixels == drawn_size_) {
    // Something that lies over the view changed: the picture is there already.
    window.GetState()->Reset();
    blitToWidget();
    return;
  }
  drawn_size_ = pixels;
  window.SetSize(pixels.width(), pixels.height());
  window.SetScreenSize(pixels.width(), pixels.height());
  // Qt changed OpenGL's state behind VTK's back.
  window.GetState()->Reset();
  window.GetState()->Push();
  const std::size_t rebuild_budget = scanning_ && !full_detail_ ? kRebuildWhileScanningPoints : 10'000'000;
  const std::size_t points = full_detail_ ? static_cast<std::size_t>(PointBudget::kMost) : budget().points();
  const bool hurry = (moving_ || scanning_) && !full_detail_;
  scene_.setOverlap(hurry ? SplatOverlap::quick : SplatOverlap::exact);
  const bool complete = scene_.prepare(pixels.width(), pixels.height(), points, rebuild_budget);
  const double prepared_ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  window.Render();
  window.GetState()->Pop();
  blitToWidget();

  const double took_ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  draw_ms_ += 0.3 * (took_ms - draw_ms_);
  if (!full_detail_) budget().learn(scene_.cloud().drawnPointCount(), took_ms - prepared_ms);
  since_draw_.start();
  pointing_.setDrawn(pixels, devicePixelRatioF());
  emit drawn();
  if (!complete) schedule();
}

void SceneView::blitToWidget() {
  QOpenGLExtraFunctions* gl = QOpenGLContext::currentContext()->extraFunctions();
  vtkOpenGLFramebufferObject* source = window_->vtk().GetDisplayFramebuffer();
  const QSize pixels = size() * devicePixelRatioF();
  source->Bind(GL_READ_FRAMEBUFFER);
  source->ActivateReadBuffer(0);
  gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, defaultFramebufferObject());
  gl->glDisable(GL_SCISSOR_TEST);
  gl->glBlitFramebuffer(0, 0, pixels.width(), pixels.height(), 0, 0, pixels.width(), pixels.height(),
                        GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
  // VTK leaves transparency in the picture; the widget must be opaque.
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void SceneView::interacted() {
  moving_ = true;
  settle_timer_.start();
  if (scene_.following()) {
    scene_.setFollowing(false);
    emit followingChanged(false);
  }
  draw_timer_.stop();
  draw_timer_.start(0);
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
