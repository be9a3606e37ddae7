#include "ui/view/scene_drawing.h"

#include <QPainter>
#include <QWidget>
#include <algorithm>
#include <utility>

#include "ui/view/qt_render_window.h"

namespace scantrove {
namespace {

constexpr int kSettle_ms = 350;
constexpr double kTimeShareWhileScanning = 0.15;
constexpr double kTimeShareWhileArriving = 0.4;
constexpr int kShortestInterval_ms = 150;  ///< while data arrives
constexpr int kLongestInterval_ms = 2000;
constexpr int kPointing_ms = 150;
constexpr int kSimilarSize = 5;  ///< sizes that differ by less than a fifth: a picture may be stretched
constexpr std::size_t kRebuildAtATimePoints = 150'000;
constexpr std::size_t kRebuildInAStepPoints = 50'000;  ///< if further steps can follow at once
constexpr int kMaxSteps = 3;                           ///< before a picture of arriving data
constexpr std::size_t kRebuildAllPoints = 10'000'000;

double millisecondsOf(const QElapsedTimer& timer) { return static_cast<double>(timer.nsecsElapsed()) * 1e-6; }

}  // namespace

SceneDrawing::SceneDrawing(QWidget& view, LabelCloudScene& scene, PendingSnapshots& pending_snapshots)
    : view_(view),
      scene_(scene),
      pending_snapshots_(pending_snapshots),
      window_(std::make_unique<QtRenderWindow>(scene.renderer())) {
  draw_timer_.setSingleShot(true);
  connect(&draw_timer_, &QTimer::timeout, this, &SceneDrawing::drawUnlessPointing);
  settle_timer_.setSingleShot(true);
  settle_timer_.setInterval(kSettle_ms);
  connect(&settle_timer_, &QTimer::timeout, this, [this] {
    moving_ = false;
    resizing_ = false;
    schedule();
  });
  since_draw_.start();
}

SceneDrawing::~SceneDrawing() = default;

void SceneDrawing::makeCurrent() { window_->makeCurrent(); }

QSize SceneDrawing::pixels() const { return view_.size() * view_.devicePixelRatioF(); }

void SceneDrawing::setScanning(bool scanning) {
  scanning_ = scanning;
  schedule();
}

void SceneDrawing::drawUserEdit() {
  has_user_edit_ = true;
  draw_timer_.start(0);
}

bool SceneDrawing::isStretched() const {
  const QSize now = pixels(), was = picture_.size();
  const auto isSimilar = [](int a, int b) { return std::abs(a - b) * kSimilarSize <= std::max(a, b); };
  return is_detailed_ && !is_outdated_ && isSimilar(now.width(), was.width()) &&
         isSimilar(now.height(), was.height());
}

void SceneDrawing::redrawResized() {
  // A bar beside the view comes or goes: the detailed picture is stretched until its successor is there.
  if (!moving_ && isStretched()) {
    settle_timer_.start();
    return view_.update();
  }
  // Draws quickly until the size is final.
  resizing_ = true;
  redraw(true);
}

void SceneDrawing::redraw(bool moving) {
  if (!moving) return schedule();
  moving_ = true;
  settle_timer_.start();
  draw_timer_.start(0);
}

void SceneDrawing::schedule() {
  if (in_parts_ == InParts::still) in_parts_ = InParts::none;  // the scene has changed
  if (draw_timer_.isActive()) return;
  int wait_ms = 0;
  if (!moving_ && (scanning_ || !pending_snapshots_.isEmpty())) {
    const double share = scanning_ ? kTimeShareWhileScanning : kTimeShareWhileArriving;
    const int interval_ms =
        std::clamp(static_cast<int>(draw_ms_ / share), kShortestInterval_ms, kLongestInterval_ms);
    wait_ms = std::max(0, interval_ms - static_cast<int>(since_draw_.elapsed()));
  }
  draw_timer_.start(wait_ms);
}

void SceneDrawing::drawUnlessPointing() {
  // Drawing blocks the window, so it must not delay the response to the moving pointer.
  const bool is_pointing = scanning_ && !moving_ && !has_user_edit_ && since_pointed_.isValid() &&
                           since_pointed_.elapsed() < kPointing_ms &&
                           since_draw_.elapsed() < kLongestInterval_ms;
  if (is_pointing) {
    draw_timer_.start(kPointing_ms);
    return;
  }
  has_user_edit_ = false;
  if (!drawsQuickly() || moving_) is_prepared_ = false;
  if (!drawsQuickly() && view_.isVisible()) return drawStill();
  if (in_parts_ == InParts::still) in_parts_ = InParts::none;
  if (!moving_ && !full_detail_ && view_.isVisible()) return drawArriving();
  in_parts_ = InParts::none;
  is_outdated_ = true;
  view_.update();
}

void SceneDrawing::drawArriving() {
  const QSize pixels = this->pixels();
  if (in_parts_ != InParts::arriving && !is_prepared_) {
    prepareQuickly(pixels, kRebuildInAStepPoints);
    is_prepared_ = is_complete_ || ++preparing_steps_ == kMaxSteps;
    draw_timer_.start(0);
    return;
  }
  if (in_parts_ != InParts::arriving) {
    is_prepared_ = false;
    preparing_steps_ = 0;
    beginParts(InParts::arriving);
    return;
  }
  if (drawPart(pixels)) return;
  budget().update(scene_.cloud().drawnPointCount(), parts_ms_);
  view_.update();
  if (!is_complete_) schedule();
}

void SceneDrawing::prepareQuickly(const QSize& pixels, std::size_t rebuild_points) {
  scene_.setOverlap(SplatOverlap::quick);
  is_complete_ = scene_.prepare(pixels.width(), pixels.height(), budget().points(), rebuild_points);
}

bool SceneDrawing::drawsQuickly() const {
  return moving_ || scanning_ || full_detail_ || !pending_snapshots_.isEmpty();
}

PointBudget& SceneDrawing::budget() {
  if (resizing_) return budgets_.resizing;
  return scanning_ && !moving_ ? budgets_.scanning : budgets_.moving;
}

PointBudget& SceneDrawing::partBudget() { return drawsQuickly() ? budgets_.arriving_part : budgets_.part; }

void SceneDrawing::drawStill() {
  const QSize pixels = this->pixels();
  if (in_parts_ != InParts::still) {
    scene_.setOverlap(SplatOverlap::exact);
    if (!scene_.prepare(pixels.width(), pixels.height(), budgets_.still.points(), kRebuildInAStepPoints)) {
      draw_timer_.start(0);  // continues after pending events of the window
      return;
    }
    beginParts(InParts::still);
    return;
  }
  if (drawPart(pixels)) return;
  budgets_.still.update(scene_.cloud().drawnPointCount(), parts_ms_);
  is_detailed_ = true;
  view_.update();
}

void SceneDrawing::beginParts(InParts what) {
  scene_.beginParts(partBudget().points());
  in_parts_ = what;
  parts_ms_ = 0;
  draw_timer_.start(0);
}

bool SceneDrawing::drawPart(const QSize& pixels) {
  QElapsedTimer timer;
  timer.start();
  window_->draw(pixels);
  const double took_ms = millisecondsOf(timer);
  parts_ms_ += took_ms;
  const bool has_more = scene_.nextPart();
  // The last part may be small, so its time must not raise the budget.
  partBudget().update(has_more ? partBudget().points() : 0, took_ms);
  if (has_more) {
    draw_timer_.start(0);
    return true;
  }
  in_parts_ = InParts::none;
  takePicture(pixels, parts_ms_);
  return false;
}

void SceneDrawing::takePicture(const QSize& pixels, double took_ms) {
  QElapsedTimer timer;
  timer.start();
  is_detailed_ = false;
  picture_ = window_->picture(pixels);
  picture_.setDevicePixelRatio(view_.devicePixelRatioF());
  is_outdated_ = false;
  draw_ms_ += 0.3 * (took_ms + millisecondsOf(timer) - draw_ms_);
  since_draw_.start();
  emit drawn(pixels);
}

void SceneDrawing::paint(QPainter& painter) {
  if (!window_->works()) {
    painter.fillRect(view_.rect(), view_.palette().window());
    painter.drawText(view_.rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("The 3D view needs OpenGL 3.2, which this display does not offer.\nEverything else "
                        "works. Mesa's llvmpipe provides it on any computer."));
    return;
  }
  const QSize pixels = this->pixels();
  // If only an overlay changed, the stored picture is still valid.
  if (is_outdated_ || (pixels != picture_.size() && !isStretched())) drawNow(pixels);
  if (pixels == picture_.size()) return painter.drawImage(0, 0, picture_);
  painter.drawImage(view_.rect(), picture_);  // stretched until it is drawn anew
}

void SceneDrawing::drawNow(const QSize& pixels) {
  QElapsedTimer timer;
  timer.start();
  in_parts_ = InParts::none;
  if (full_detail_) {
    pending_snapshots_.transfer(1e9);
    scene_.setOverlap(SplatOverlap::exact);
    constexpr auto kAll = static_cast<std::size_t>(PointBudget::kMax);
    is_complete_ = scene_.prepare(pixels.width(), pixels.height(), kAll, kRebuildAllPoints);
  } else {
    const bool has_more = scanning_ || !pending_snapshots_.isEmpty();
    prepareQuickly(pixels, resizing_  ? kRebuildInAStepPoints
                           : has_more ? kRebuildAtATimePoints
                                      : kRebuildAllPoints);
  }
  is_prepared_ = false;
  preparing_steps_ = 0;
  const double prepared_ms = millisecondsOf(timer);
  window_->draw(pixels);
  const double took_ms = millisecondsOf(timer);
  if (!full_detail_) budget().update(scene_.cloud().drawnPointCount(), took_ms - prepared_ms);
  takePicture(pixels, took_ms);
  if (!is_complete_ || !drawsQuickly()) schedule();  // the remaining chunks, or the same with full detail
}

}  // namespace scantrove
