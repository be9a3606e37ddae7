#include "ui/main_window/region_controller.h"

#include <QCursor>
#include <QLocale>
#include <QMenu>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "ui/main_window/scene_pane.h"
#include "ui/main_window/view_actions.h"
#include "ui/painting/image_canvas.h"
#include "ui/painting/image_mode.h"
#include "ui/painting/image_page.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/region_picture.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove {
RegionController::RegionController(ScanBridge& bridge, ScenePane& scene, FramePanels& frames,
                                   UndoHistory& history, QWidget& window)
    : QObject(&window),
      scene_(scene),
      frames_(frames),
      actions_(this),
      operations_(bridge, scene, selection_, history, window),
      splitter_(new RegionSplitter(scene, frames, selection_, this)),
      naming_(new RegionNaming(bridge, selection_, operations_, actions_, window)) {
  connectFrames();
  connectScene();
  connectActions();
  connectSplitter();
  connect(&selection_, &RegionSelection::hoverChanged, this, &RegionController::updateHighlight);
  connect(&selection_, &RegionSelection::selectionChanged, this, &RegionController::updateHighlight);
  connect(&selection_, &RegionSelection::selectionChanged, this, &RegionController::updateActions);
  connect(&selection_, &RegionSelection::selectionChanged, this, [this] {
    const std::vector<RegionId>& selected = selection_.selected();
    scene_.view()->setSelected({selected.begin(), selected.end()});
  });
  connect(&selection_, &RegionSelection::infosChanged, this, [this] {
    updateActions();
    sizes_.clear();
    std::set<RegionId> background = selection_.background();
    if (background == background_) return;
    background_ = std::move(background);
    scene_.viewActions()->setBackground(background_);
  });
  connect(&operations_.proposals(), &RegionProposals::changed, this, &RegionController::showProposal);
  connect(&operations_, &RegionOperations::failed, this, [this](const QString& message) {
    emit failed(message);
    splitter_->end();
  });
  connect(&operations_, &RegionOperations::hinted, this, &RegionController::hinted);
  updateActions();
}

void RegionController::connectFrames() {
  connect(&frames_, &FramePanels::pointedAt, this, [this](const RegionPoint& at) {
    point(at);
    frames_.setTag(tagOf(at.region));
  });
  connect(&frames_, &FramePanels::pointerMoved, &scene_.view()->drawing(), &SceneDrawing::notePointing);
  connect(&frames_, &FramePanels::pointerLeft, this, [this] { selection_.hover({}); });
  connect(&frames_, &FramePanels::clicked, this, &RegionController::click);
  connect(&frames_, &FramePanels::doubleClicked, this,
          [this](const RegionPoint& at, const QPoint& on_screen) {
            if (!at.region || splitter_->expectsStroke()) return;
            selection_.select(at.region);
            naming_->edit(on_screen);
          });
  connect(&frames_, &FramePanels::menuRequested, this, &RegionController::openMenu);
  connect(
      &frames_, &FramePanels::bandDrawn, this,
      [this](const std::vector<RegionId>& regions, Qt::KeyboardModifiers) { selection_.select(regions); });
}

void RegionController::connectImage(ImageMode& image) {
  for (QAction* action : actions_.all()) image.page().canvas().addAction(action);
  connect(&image, &ImageMode::pointedAt, this, [this, &image](const RegionPoint& at) {
    point(at);
    image.setTag(tagOf(at.region));
  });
  connect(&image, &ImageMode::pointerLeft, this, [this] { selection_.hover({}); });
  connect(&image, &ImageMode::clicked, this, &RegionController::click);
  connect(&image, &ImageMode::doubleClicked, this, [this](const RegionPoint& at, const QPoint& on_screen) {
    if (!at.region || splitter_->expectsStroke()) return;
    selection_.select(at.region);
    naming_->edit(on_screen);
  });
  connect(&image, &ImageMode::menuRequested, this, &RegionController::openMenu);
  connect(&image, &ImageMode::operationReady, &operations_, &RegionOperations::perform);
  connect(&image, &ImageMode::failed, this, &RegionController::failed);
}

void RegionController::connectScene() {
  SceneView* const view = scene_.view();
  connect(view, &SceneView::pointedAt, this, [this, view](const QPointF& position) {
    pointer_in_scene_ = position;
    const RegionPoint at = view->at(position);
    point(at);
    scene_.overlay()->setTag(position, tagOf(at.region));
  });
  connect(view, &SceneView::pointerLeft, this, [this] {
    pointer_in_scene_.reset();
    selection_.hover({});
    scene_.overlay()->setTag({}, {});
  });
  connect(view, &SceneView::clicked, this,
          [this, view](const QPointF& position, Qt::KeyboardModifiers modifiers) {
            last_position_ = view->mapToGlobal(position.toPoint());
            click(view->at(position), modifiers);
          });
  connect(view, &SceneView::doubleClicked, this, [this, view](const QPointF& position) {
    if (splitter_->expectsStroke()) return;
    const RegionPoint at = view->at(position);
    if (!at.region) {
      view->fitAll();
      return;
    }
    selection_.select(at.region);
    naming_->edit(view->mapToGlobal(position.toPoint()));
  });
  connect(view, &SceneView::menuRequested, this,
          [this, view](const QPointF& position, const QPoint& on_screen) {
            openMenu(view->at(position), on_screen);
          });
  connect(view, &SceneView::bandChanged, this,
          [this, view] { scene_.overlay()->setBand(view->input().band()); });
  connect(view, &SceneView::bandDrawn, this, [this, view](const QRectF& band) {
    const cv::Mat& ids = view->regionIds();
    if (ids.empty()) return;
    const double scale = static_cast<double>(ids.cols) / view->width();
    const cv::Rect pixels(static_cast<int>(band.left() * scale), static_cast<int>(band.top() * scale),
                          static_cast<int>(band.width() * scale) + 1,
                          static_cast<int>(band.height() * scale) + 1);
    selection_.select(regionsIn(ids, pixels));
  });
  // Deferred, so that it neither runs during drawing nor delays the display of the picture.
  connect(view, &SceneView::drawn, this,
          [this] { QTimer::singleShot(0, this, &RegionController::highlightScene); });
}

void RegionController::connectActions() {
  for (QAction* action : actions_.all()) {
    scene_.addAction(action);
    frames_.addAction(action);
  }
  const auto on = [this](QAction* action, auto slot) { connect(action, &QAction::triggered, this, slot); };
  on(actions_.name, [this] {
    if (!splitter_->accept()) editName();
  });
  on(actions_.join, [this] { operations_.join(); });
  on(actions_.cut, [this] { splitter_->begin(); });
  on(actions_.finer, [this] { operations_.applyToEach(OperationKind::finer); });
  on(actions_.coarser, [this] { operations_.applyToEach(OperationKind::coarser); });
  on(actions_.background,
     [this](bool checked) { operations_.applyToAll(OperationKind::background, checked); });
  on(actions_.object, [this] { operations_.applyToAll(OperationKind::object); });
  on(actions_.reject, [this](bool checked) { operations_.applyToAll(OperationKind::reject, checked); });
  on(actions_.accept, [this] { operations_.acceptFirst(); });
  on(actions_.accept_all, [this] { operations_.acceptAll(); });
  on(actions_.not_this, [this] { operations_.proposals().rejectFirst(); });
  on(actions_.mark_supports, [this] { operations_.markSupports(); });
  on(actions_.next, [this] { selection_.selectBySize(true); });
  on(actions_.previous, [this] { selection_.selectBySize(false); });
  on(actions_.fit, [this] {
    const std::vector<RegionId>& selected = selection_.selected();
    scene_.view()->fit(scene_.view()->scene().cloud().boundsOf({selected.begin(), selected.end()}));
  });
  on(actions_.deselect, [this] { deselect(); });
  for (QAction* action : actions_.recent)
    on(action, [this, action] { naming_->give(action->data().toString(), last_position_); });
}

void RegionController::beginScan() {
  splitter_->end();
  selection_.reset();
  naming_->beginScan();
  operations_.beginScan();
}

void RegionController::showSnapshot(const ScanSnapshot& snapshot) {
  selection_.update(snapshot);
  operations_.showSnapshot(snapshot);
}

void RegionController::finishEditing() { naming_->finishEditing(); }

void RegionController::point(const RegionPoint& at) { selection_.hover(at.region); }

void RegionController::click(const RegionPoint& at, Qt::KeyboardModifiers modifiers) {
  if (splitter_->expectsStroke()) return splitter_->click(at, modifiers);
  splitter_->end();
  last_position_ = QCursor::pos();
  const bool also = modifiers.testFlag(Qt::ControlModifier);
  if (also && !at.region) return;
  selection_.select(at.region, also);
}

void RegionController::openMenu(const RegionPoint& at, const QPoint& on_screen) {
  if (at.region && !selection_.isSelected(at.region)) selection_.select(at.region);
  last_position_ = on_screen;
  auto* menu = new QMenu(naming_->editor().parentWidget());
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setObjectName(QStringLiteral("regionMenu"));
  menu->setToolTipsVisible(true);
  menu->addActions(actions_.onSelection());
  QMenu* recent = nullptr;
  for (QAction* action : actions_.recent) {
    if (!action->isVisible()) continue;
    if (recent == nullptr) recent = menu->addMenu(tr("&Recent names"));
    recent->addAction(action);
  }
  menu->popup(on_screen);
}

void RegionController::connectSplitter() {
  connect(splitter_, &RegionSplitter::changed, this, [this] {
    updateActions();
    // Also updates the tag of a resting pointer.
    const QStringList tag = tagOf(selection_.hovered());
    frames_.setTag(tag);
    if (pointer_in_scene_) scene_.overlay()->setTag(*pointer_in_scene_, tag);
  });
  connect(splitter_, &RegionSplitter::regionChosen, this,
          [this](RegionId region) { selection_.select(region); });
  connect(splitter_, &RegionSplitter::splitRequested, this,
          [this](const Operation& cut) { operations_.perform(cut); });
  connect(&operations_, &RegionOperations::splitFailed, this, [this](const QString& message) {
    emit failed(message);
    splitter_->repeat();
  });
  connect(splitter_, &RegionSplitter::failed, this, &RegionController::failed);
}

void RegionController::deselect() {
  if (splitter_->isActive()) {
    if (splitter_->isSplit()) operations_.undoNewest();
    return splitter_->end();
  }
  selection_.select(RegionId{});
}

void RegionController::showProposal() {
  const Proposal* const first = operations_.proposals().first();
  actions_.enableProposals(first != nullptr);
  updateHighlight();
}

RegionId RegionController::highlightedRegion() const {
  const Proposal* const proposal = operations_.proposals().first();
  const RegionId hovered = selection_.hovered();
  // The pointer usually rests on the region just named, which is highlighted anyway.
  const bool is_selected = std::ranges::find(selection_.selected(), hovered) != selection_.selected().end();
  if (hovered && (proposal == nullptr || !is_selected)) return hovered;
  return proposal != nullptr ? proposal->region : RegionId{};
}

void RegionController::updateHighlight() {
  frames_.setHighlight(highlightedRegion(), selection_.selected());
  highlightScene();
}

void RegionController::highlightScene() {
  SceneView* const view = scene_.view();
  if (pointer_in_scene_) {
    const RegionPoint at = view->at(*pointer_in_scene_);
    scene_.overlay()->setTag(pointer_in_scene_, tagOf(at.region));
    selection_.hover(at.region);
  }
  const bool any = highlightedRegion() || !selection_.selected().empty();
  scene_.overlay()->setHighlight(
      any ? highlightPicture(view->regionIds(), highlightedRegion(), selection_.selected()) : QImage());
}

void RegionController::editName() {
  if (selection_.selected().empty() && selection_.hovered()) {
    last_position_ = QCursor::pos();
    selection_.select(selection_.hovered(), false);
  }
  if (selection_.selected().empty())
    return emit operations_.hinted(tr("Point at a region to name, or click it."));
  naming_->edit(last_position_);
}

void RegionController::updateActions() {
  const std::vector<RegionId>& selected = selection_.selected();
  const RegionInfo* const first = selected.empty() ? nullptr : selection_.info(selected.front());
  actions_.enableFor(selected.size(), first != nullptr && first->note.background,
                     first != nullptr && first->note.rejected);
  actions_.cut->setEnabled(!selection_.infos().empty());
  // Else a name that is typed at once would be taken for keys.
  actions_.name->setEnabled(!selection_.infos().empty());
  actions_.enableSupports(!selection_.proposedBackground().empty());
  if (!splitter_->isActive()) return;
  actions_.deselect->setEnabled(true);
}

QString RegionController::sizeOf(RegionId region) {
  const auto [size, is_new] = sizes_.try_emplace(region);
  if (is_new) {
    const Eigen::AlignedBox3f box = scene_.view()->scene().cloud().boundsOf({region});
    const Eigen::Vector3f sides_cm =
        box.isEmpty() ? Eigen::Vector3f::Zero() : Eigen::Vector3f(100 * box.sizes());
    if (sides_cm.maxCoeff() > 0) {
      size->second = tr("%1 × %2 × %3 cm")
                         .arg(std::lround(sides_cm.x()))
                         .arg(std::lround(sides_cm.y()))
                         .arg(std::lround(sides_cm.z()));
    }
  }
  return size->second;
}

QStringList RegionController::tagOf(RegionId region) {
  const RegionInfo* const info = selection_.info(region);
  if (info == nullptr) return {};
  QStringList lines{selection_.title(region)};
  QStringList metadata;
  if (!info->category().empty()) metadata << tr("class %1").arg(QString::fromStdString(info->category()));
  if (const QString size = sizeOf(region); !size.isEmpty()) metadata << size;
  metadata << tr("%1 voxels").arg(QLocale().toString(static_cast<qlonglong>(info->voxels)));
  if (info->note.background) metadata << tr("background");
  if (info->note.rejected) metadata << tr("rejected");
  if (info->object) {
    // The list calls it so; a user may not have named it yet.
    const QString object = info->label ? QString::fromStdString(info->label->name) : QString();
    metadata << (object.isEmpty() || object == lines.front() ? tr("object") : tr("object %1").arg(object));
  }
  lines << metadata.join(QStringLiteral(" · "));
  if (info->is_proposed_background) lines << tr("looks like background: things stand on it");
  if (const QString next = splitter_->instruction(); !next.isEmpty()) lines << next;
  return lines;
}

}  // namespace scantrove
