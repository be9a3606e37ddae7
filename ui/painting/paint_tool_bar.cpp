#include "ui/painting/paint_tool_bar.h"

#include <QAction>
#include <QActionGroup>
#include <QCheckBox>
#include <QSettings>
#include <QSpinBox>
#include <algorithm>
#include <cmath>

#include "ui/theme/icon.h"

namespace scantrove {
namespace {

const QString kBrushSizeKey = QStringLiteral("image/brushSize");
constexpr int kUsualBrush_px = 12, kLargestBrush_px = 400;
constexpr double kBrushStep = 1.25;

void setKeyOf(QAction* action, const QKeySequence& key, const QString& help) {
  action->setShortcut(key);
  action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(help, key.toString(QKeySequence::NativeText)));
}

}  // namespace

PaintToolBar::PaintToolBar(QWidget* parent)
    : QToolBar(parent),
      smaller_(new QAction(tr("Smaller brush"), this)),
      larger_(new QAction(tr("Larger brush"), this)),
      toggle_new_(new QAction(tr("New region"), this)),
      reset_(new QAction(icon(QStringLiteral("reset-mask")), tr("Reset mask"), this)),
      size_(new QSpinBox),
      new_region_(new QCheckBox(tr("New region"))),
      this_image_(new QCheckBox(tr("This image only"))) {
  setObjectName(QStringLiteral("paintToolBar"));
  setIconSize({20, 20});
  auto* group = new QActionGroup(this);
  const auto add = [&](PaintTool tool, const char* picture, const QString& text, Qt::Key key,
                       const QString& help) { group->addAction(addTool(tool, picture, text, key, help)); };
  add(PaintTool::select, "select", tr("Select"), Qt::Key_S, tr("Select regions"));
  add(PaintTool::brush, "brush", tr("Brush"), Qt::Key_P, tr("Paint: these pixels are the region"));
  add(PaintTool::eraser, "eraser", tr("Eraser"), Qt::Key_E, tr("Erase: these pixels are not the region"));
  add(PaintTool::polygon, "polygon", tr("Polygon"), Qt::Key_L,
      tr("Click the corners of an outline; Return or a double click closes it"));
  add(PaintTool::magic_edge, "magic-edge", tr("Magic edge"), Qt::Key_W,
      tr("Draw around a thing; the outline snaps to its edge"));
  add(PaintTool::fill_hole, "fill-hole", tr("Fill hole"), Qt::Key_H, tr("Fill the hole under the pointer"));
  tools_.front()->setChecked(true);
  addSeparator();
  size_->setRange(1, kLargestBrush_px);
  size_->setSuffix(tr(" px"));
  size_->setToolTip(tr("Size of the brush ([ and ], or Ctrl + wheel)"));
  size_->setAccessibleName(tr("Size of the brush"));
  size_->setFocusPolicy(Qt::ClickFocus);
  size_->setValue(QSettings().value(kBrushSizeKey, kUsualBrush_px).toInt());
  addWidget(size_);
  connect(size_, &QSpinBox::valueChanged, this, [this](int pixels) {
    QSettings().setValue(kBrushSizeKey, pixels);
    emit brushSizeChanged(pixels);
  });
  setKeyOf(smaller_, QKeySequence(Qt::Key_BracketLeft), tr("Smaller brush"));
  setKeyOf(larger_, QKeySequence(Qt::Key_BracketRight), tr("Larger brush"));
  connect(smaller_, &QAction::triggered, this, [this] { stepBrush(-1); });
  connect(larger_, &QAction::triggered, this, [this] { stepBrush(1); });
  addSeparator();
  new_region_->setToolTip(tr("What is painted becomes a region of its own (Ins)"));
  this_image_->setToolTip(tr("Leave the regions behind and other images as they are"));
  for (QCheckBox* box : {new_region_, this_image_}) {
    box->setFocusPolicy(Qt::TabFocus);
    addWidget(box);
  }
  setKeyOf(toggle_new_, QKeySequence(Qt::Key_Insert), tr("New region"));
  connect(toggle_new_, &QAction::triggered, new_region_, &QCheckBox::toggle);
  // A new region needs its surface.
  connect(new_region_, &QCheckBox::toggled, this, [this](bool on) {
    this_image_->setEnabled(!on);
    if (on) this_image_->setChecked(false);
  });
  addSeparator();
  reset_->setToolTip(tr("Take back what was painted for the selected region in this image"));
  addAction(reset_);
  setCanPaint(false);
}

QAction* PaintToolBar::addTool(PaintTool tool, const char* picture, const QString& text, Qt::Key key,
                               const QString& help) {
  auto* action = new QAction(icon(QString::fromLatin1(picture)), text, this);
  action->setCheckable(true);
  setKeyOf(action, QKeySequence(key), help);
  connect(action, &QAction::triggered, this, [this, tool] { choose(tool); });
  tools_ << action;
  addAction(action);
  return action;
}

void PaintToolBar::choose(PaintTool tool) {
  tool_ = tool;
  toolAction(tool)->setChecked(true);
  emit toolChosen(tool);
}

int PaintToolBar::brushSize() const { return size_->value(); }
void PaintToolBar::setBrushSize(int pixels) { size_->setValue(pixels); }

void PaintToolBar::stepBrush(int steps) {
  const int now = brushSize();
  const int next = static_cast<int>(std::lround(now * std::pow(kBrushStep, steps)));
  setBrushSize(steps > 0 ? std::max(next, now + 1) : std::min(next, now - 1));
}

QList<QAction*> PaintToolBar::keyActions() const { return tools_ + QList{smaller_, larger_, toggle_new_}; }

void PaintToolBar::setCanPaint(bool can_paint) {
  for (QAction* action : tools_.mid(1) + QList{toggle_new_, reset_}) action->setEnabled(can_paint);
  new_region_->setEnabled(can_paint);
  this_image_->setEnabled(can_paint && !new_region_->isChecked());
}

}  // namespace scantrove
