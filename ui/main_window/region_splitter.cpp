#include "ui/main_window/region_splitter.h"

#include <QAction>
#include <utility>

#include "ui/main_window/scene_pane.h"
#include "ui/main_window/view_actions.h"
#include "ui/models/region_selection.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove {
namespace {

/// Minimum distance of neighbouring points of a stroke; about the radius that a split uses around each.
constexpr float kPointStep_m = 0.01F;

}  // namespace

const QColor RegionSplitter::kHereColor(0xff, 0x4d, 0x6d);
const QColor RegionSplitter::kThereColor(0x3a, 0xa0, 0xff);

RegionSplitter::RegionSplitter(ScenePane& scene, FramePanels& frames, const RegionSelection& selection,
                               QObject* parent)
    : QObject(parent), scene_(scene), frames_(frames), selection_(selection) {
  SceneView* const view = scene_.view();
  connect(view, &SceneView::strokeAt, this, &RegionSplitter::addPoint);
  connect(view, &SceneView::strokeEnded, this, &RegionSplitter::endStroke);
  connect(view, &SceneView::strokeChanged, this,
          [this, view] { scene_.overlay()->setStroke(view->input().stroke(), color()); });
  // Queued, so that it does not run during drawing.
  connect(view, &SceneView::drawn, this, &RegionSplitter::placeMarksInScene, Qt::QueuedConnection);
  connect(&frames_, &FramePanels::strokeAt, this, &RegionSplitter::addPoint);
  connect(&frames_, &FramePanels::strokeEnded, this, &RegionSplitter::endStroke);
}

void RegionSplitter::begin() {
  split_ = Operation{};
  split_.kind = OperationKind::cut;
  has_added_ = false;
  other_region_ = {};
  scene_.viewActions()->measureAction()->setChecked(false);  // the splitter needs the clicks
  setStep(Step::here);
}

void RegionSplitter::end() {
  if (step_ != Step::no) setStep(Step::no);
}

bool RegionSplitter::accept() {
  if (isSplit()) {
    end();
    return true;
  }
  // Without a stroke over the other part, the colours around the first decide.
  if (step_ == Step::there || (expectsStroke() && !side().empty())) advance();
  return isActive();
}

void RegionSplitter::repeat() {
  if (step_ != Step::shown) return;
  split_.there_world.clear();
  setStep(Step::there);
}

void RegionSplitter::click(const RegionPoint& at, Qt::KeyboardModifiers modifiers) {
  addPoint(at);
  endStroke(modifiers);
}

std::vector<Eigen::Vector3f>& RegionSplitter::side() {
  return step_ == Step::here ? split_.here_world : split_.there_world;
}

void RegionSplitter::addPoint(const RegionPoint& at) {
  if (!expectsStroke() || !at.region || !at.point_world) return;
  if (!split_.regions.empty() && split_.regions.front() != at.region) {
    other_region_ = at.region;
    return;
  }
  if (split_.regions.empty()) emit regionChosen(at.region);
  split_.regions = {at.region};
  std::vector<Eigen::Vector3f>& points = side();
  if (has_added_ && (points.back() - *at.point_world).norm() < kPointStep_m) return;
  has_added_ = true;
  points.push_back(*at.point_world);
}

void RegionSplitter::endStroke(Qt::KeyboardModifiers modifiers) {
  if (!expectsStroke()) return;
  const RegionId other = std::exchange(other_region_, RegionId{});
  if (!std::exchange(has_added_, false)) {
    emit failed(other ? tr("These are two regions already: %1 and %2. Draw on one region.")
                            .arg(selection_.title(split_.regions.front()), selection_.title(other))
                      : tr("There is no depth at that point. Draw on a highlighted region."));
    return;
  }
  showMarks();
  if (!modifiers.testFlag(Qt::ShiftModifier)) advance();
}

void RegionSplitter::advance() {
  if (step_ == Step::here) return setStep(Step::there);
  emit splitRequested(split_);
  setStep(Step::shown);
}

void RegionSplitter::setStep(Step step) {
  step_ = step;
  QString hint;
  if (step == Step::here) {
    hint = tr("Split, 1 of 2: draw over one part, or click it. Shift adds strokes, Escape cancels");
  } else if (step == Step::there) {
    hint =
        tr("Split, 2 of 2: draw over the other part, or click it. Return splits by colour, Escape cancels");
  } else if (step == Step::shown) {
    hint = tr("Split. Return accepts, Escape undoes");
  }
  scene_.overlay()->setHint(hint);
  scene_.view()->setCursor(expectsStroke() ? Qt::CrossCursor : Qt::ArrowCursor);
  scene_.view()->input().setDrawsStrokes(expectsStroke());
  frames_.setStrokeColor(expectsStroke() ? std::optional(color()) : std::nullopt);
  if (step == Step::no) split_ = Operation{};
  showMarks();
  emit changed();
}

QString RegionSplitter::instruction() const {
  if (step_ == Step::here) return tr("Draw over one part");
  return step_ == Step::there ? tr("Draw over the other part") : QString();
}

void RegionSplitter::showMarks() {
  std::vector<PointMarks> marks;
  if (!split_.here_world.empty()) marks.push_back({kHereColor, split_.here_world});
  if (!split_.there_world.empty()) marks.push_back({kThereColor, split_.there_world});
  frames_.setMarks(std::move(marks));
  placeMarksInScene();
}

void RegionSplitter::placeMarksInScene() {
  std::vector<SceneOverlay::Marks> marks;
  const auto mark = [&](const QColor& color, const std::vector<Eigen::Vector3f>& points_world) {
    QPolygonF seen;
    for (const Eigen::Vector3f& point : points_world) {
      if (const std::optional<QPointF> at = scene_.view()->positionOf(point)) seen << *at;
    }
    if (!seen.isEmpty()) marks.push_back({color, seen});
  };
  mark(kHereColor, split_.here_world);
  mark(kThereColor, split_.there_world);
  scene_.overlay()->setMarks(std::move(marks));
}

}  // namespace scantrove
