// When the 3D view draws, how much of the scene, and how it gets to the screen.
#include <algorithm>
#include <utility>

#include "ui/view/qt_render_window.h"
#include "ui/view/scene_view.h"

namespace scantrove {
namespace {

constexpr double kTimeShareWhileScanning = 0.15;
constexpr double kTimeShareWhileArriving = 0.4;
constexpr int kShortestInterval_ms = 150;  ///< while something comes in
constexpr int kLongestInterval_ms = 2000;
constexpr int kPointing_ms = 150;
constexpr std::size_t kRebuildAtATimePoints = 150'000;
constexpr std::size_t kRebuildAllPoints = 10'000'000;

double millisecondsOf(const QElapsedTimer& timer) { return static_cast<double>(timer.nsecsElapsed()) * 1e-6; }

}  // namespace

void SceneView::redraw(bool moving) {
  if (!moving) return schedule();
  moving_ = true;
  settle_timer_.start();
  draw_timer_.start(0);
}

void SceneView::interacted() {
  if (scene_.following()) {
    scene_.setFollowing(false);
    emit followingChanged(false);
  }
  redraw(true);
}

void SceneView::schedule() {
  is_in_parts_ = false;  // of something that is no more
  if (draw_timer_.isActive()) return;
  int wait_ms = 0;
  if (!moving_ && (scanning_ || !arrivals_.isEmpty())) {
    const double share = scanning_ ? kTimeShareWhileScanning : kTimeShareWhileArriving;
    const int interval_ms =
        std::clamp(static_cast<int>(draw_ms_ / share), kShortestInterval_ms, kLongestInterval_ms);
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
  if (!scanning_ || moving_) is_prepared_ = false;
  if (!hurries() && window_ != nullptr && isVisible()) return drawStill();
  is_in_parts_ = false;
  if (scanning_ && !moving_ && !full_detail_ && !is_prepared_) {
    // Two short holds rather than a long one: first what is new, then, when the window has done what else it
    // has to do, the picture.
    prepareHastily(size() * devicePixelRatioF());
    is_prepared_ = true;
    draw_timer_.start(0);
    return;
  }
  is_old_ = true;
  update();
}

void SceneView::prepareHastily(const QSize& pixels) {
  scene_.setOverlap(SplatOverlap::quick);
  const bool more_comes = scanning_ || !arrivals_.isEmpty();
  is_complete_ = scene_.prepare(pixels.width(), pixels.height(), budget().points(),
                                more_comes ? kRebuildAtATimePoints : kRebuildAllPoints);
}

bool SceneView::hurries() const { return moving_ || scanning_ || full_detail_ || !arrivals_.isEmpty(); }

PointBudget& SceneView::budget() { return scanning_ && !moving_ ? scanning_budget_ : moving_budget_; }

void SceneView::drawStill() {
  QElapsedTimer timer;
  timer.start();
  const QSize pixels = size() * devicePixelRatioF();
  if (!is_in_parts_) {
    scene_.setOverlap(SplatOverlap::exact);
    if (!scene_.prepare(pixels.width(), pixels.height(), still_budget_.points(), kRebuildAtATimePoints)) {
      draw_timer_.start(0);  // the next chunks, when the window has done what else it has to do
      return;
    }
    scene_.beginParts(part_budget_.points());
    is_in_parts_ = true;
    still_ms_ = 0;
    drawn_size_ = pixels;
    draw_timer_.start(0);
    return;
  }
  makeCurrent();
  window_->draw(pixels);
  doneCurrent();
  const double took_ms = millisecondsOf(timer);
  still_ms_ += took_ms;
  part_budget_.learn(part_budget_.points(), took_ms);
  if (scene_.nextPart()) {
    draw_timer_.start(0);
    return;
  }
  is_in_parts_ = false;
  is_old_ = false;
  still_budget_.learn(scene_.cloud().drawnPointCount(), still_ms_);
  noteDrawn(pixels, still_ms_);
  update();
}

void SceneView::noteDrawn(const QSize& pixels, double took_ms) {
  draw_ms_ += 0.3 * (took_ms - draw_ms_);
  since_draw_.start();
  pointing_.setDrawn(pixels, devicePixelRatioF());
  emit drawn();
}

void SceneView::resizeGL(int /*width*/, int /*height*/) {
  // Quickly, until it has the size that it is to have.
  redraw(true);
}

void SceneView::paintGL() {
  const QSize pixels = size() * devicePixelRatioF();
  if (!is_old_ && pixels == drawn_size_) {
    // Something that lies over the view changed: the picture is there already. That which is being drawn is
    // not.
    if (is_in_parts_) return;
    window_->copyToWidget(pixels);
    return;
  }
  QElapsedTimer timer;
  timer.start();
  is_old_ = is_in_parts_ = false;
  drawn_size_ = pixels;
  if (full_detail_) {
    arrivals_.takeOver(1e9);
    scene_.setOverlap(SplatOverlap::exact);
    constexpr auto kAll = static_cast<std::size_t>(PointBudget::kMost);
    is_complete_ = scene_.prepare(pixels.width(), pixels.height(), kAll, kRebuildAllPoints);
  } else if (!is_prepared_ || !scanning_ || moving_) {
    prepareHastily(pixels);
  }
  is_prepared_ = false;
  const double prepared_ms = millisecondsOf(timer);
  window_->draw(pixels);
  window_->copyToWidget(pixels);
  const double took_ms = millisecondsOf(timer);
  if (!full_detail_) budget().learn(scene_.cloud().drawnPointCount(), took_ms - prepared_ms);
  noteDrawn(pixels, took_ms);
  if (!is_complete_ || !hurries()) schedule();  // the rest; or the same with much detail
}

}  // namespace scantrove
