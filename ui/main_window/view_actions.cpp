#include "ui/main_window/view_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QSettings>
#include <QToolButton>
#include <algorithm>
#include <array>

#include "ui/theme/icon.h"
#include "ui/view/clip_tool.h"
#include "ui/view/measure_tool.h"
#include "ui/view/scene_view.h"

namespace scantrove {
namespace {

const QString kColoringKey = QStringLiteral("view/coloring");
const QString kBackgroundKey = QStringLiteral("view/background");

/// Names in the settings, in the order of Coloring and BackgroundStyle.
const std::array kColoringWords{"scene", "regions", "blended", "normals", "height"};
const std::array kBackgroundWords{"shown", "dimmed", "hidden"};

/// Index of the stored name in `words`; `fallback` if it is missing.
template <std::size_t size>
std::size_t storedIndex(const QString& key, const std::array<const char*, size>& words,
                        std::size_t fallback) {
  const std::string word = QSettings().value(key).toString().toStdString();
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? fallback : static_cast<std::size_t>(found - words.begin());
}

void setKey(QAction* action, const QKeySequence& key, const QString& help) {
  action->setShortcut(key);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(help, key.toString(QKeySequence::NativeText)));
}

}  // namespace

ViewActions::ViewActions(SceneView* view, QObject* parent)
    : QObject(parent),
      view_(view),
      clip_(new ClipTool(view)),
      measure_(new MeasureTool(view)),
      colorings_(new QActionGroup(this)),
      next_coloring_(new QAction(tr("&Next colour mode"), this)),
      background_action_(new QAction(icon(QStringLiteral("backdrop")), {}, this)),
      clip_action_(new QAction(icon(QStringLiteral("cut")), tr("&Clip plane"), this)),
      measure_action_(new QAction(icon(QStringLiteral("ruler")), tr("&Measure"), this)) {
  makeColorings();
  makeStandardViews();
  setKey(background_action_, tr("Shift+B"), tr("Show, dim or hide the background"));
  background_action_->setCheckable(true);
  connect(background_action_, &QAction::triggered, this, [this] {
    setBackgroundStyle(static_cast<BackgroundStyle>((static_cast<int>(background_style_) + 1) %
                                                    static_cast<int>(kBackgroundWords.size())));
  });
  clip_action_->setCheckable(true);
  setKey(clip_action_, tr("X"), tr("Hide everything in front of a plane"));
  connect(clip_action_, &QAction::toggled, clip_, &ClipTool::setActive);
  measure_action_->setCheckable(true);
  setKey(measure_action_, tr("T"), tr("Measure between two points of the surface"));
  connect(measure_action_, &QAction::toggled, measure_, &MeasureTool::setActive);
  connect(measure_, &MeasureTool::ended, this, [this] { measure_action_->setChecked(false); });
  color(static_cast<Coloring>(storedIndex(kColoringKey, kColoringWords, 1)));
  setBackgroundStyle(static_cast<BackgroundStyle>(storedIndex(kBackgroundKey, kBackgroundWords, 0)));
}

void ViewActions::makeColorings() {
  const std::array names{tr("&Scene colours"), tr("&Regions"), tr("Scene and regions &blended"),
                         tr("Surface &direction"), tr("&Height")};
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto* action = new QAction(names[i], colorings_);
    action->setCheckable(true);
    setKey(action, QKeySequence(QStringLiteral("Alt+%1").arg(i + 1)), names[i].simplified().remove('&'));
    connect(action, &QAction::triggered, this, [this, coloring = kColorings[i]] { color(coloring); });
  }
  setKey(next_coloring_, tr("R"), tr("Switch to the next colour mode"));
  connect(next_coloring_, &QAction::triggered, this,
          [this] { color(kColorings[(static_cast<std::size_t>(coloring_) + 1) % kColorings.size()]); });
}

void ViewActions::makeStandardViews() {
  const std::array names{tr("&Front"), tr("&Back"), tr("&Left"), tr("&Right"), tr("&Top"), tr("B&ottom")};
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto* action = new QAction(names[i], this);
    action->setShortcut(QKeySequence(QStringLiteral("Ctrl+Alt+%1").arg(i + 1)));
    connect(action, &QAction::triggered, view_,
            [this, from = static_cast<StandardView>(i)] { view_->lookFrom(from); });
    standard_views_.append(action);
  }
}

void ViewActions::addTo(QMenu* menu) {
  QMenu* colorings = menu->addMenu(icon(QStringLiteral("palette")), tr("Colour &by"));
  colorings->addActions(colorings_->actions());
  colorings->addSeparator();
  colorings->addAction(next_coloring_);
  menu->addMenu(tr("&View from"))->addActions(standard_views_);
  menu->addActions({background_action_, clip_action_, measure_action_});
}

QToolButton* ViewActions::makeColoringButton() {
  auto* button = new QToolButton;
  button->setIcon(icon(QStringLiteral("palette")));
  button->setToolTip(tr("Colour mode (R: next)"));
  button->setAccessibleName(tr("Colour mode"));
  button->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(button);
  menu->addActions(colorings_->actions());
  button->setMenu(menu);
  return button;
}

QList<QAction*> ViewActions::coloringActions() const { return colorings_->actions(); }

void ViewActions::setBackground(const std::set<RegionId>& regions) {
  background_ = regions;
  view_->setBackground(background_, background_style_);
}

void ViewActions::color(Coloring coloring) {
  coloring_ = coloring;
  const auto index = static_cast<std::size_t>(coloring);
  colorings_->actions()[static_cast<int>(index)]->setChecked(true);
  QSettings().setValue(kColoringKey, QString::fromLatin1(kColoringWords.at(index)));
  view_->setColoring(coloring);
}

void ViewActions::setBackgroundStyle(BackgroundStyle style) {
  background_style_ = style;
  const std::array names{tr("Background: &shown"), tr("Background: &dimmed"), tr("Background: &hidden")};
  const auto index = static_cast<std::size_t>(style);
  background_action_->setText(names.at(index));
  background_action_->setChecked(style != BackgroundStyle::as_others);
  QSettings().setValue(kBackgroundKey, QString::fromLatin1(kBackgroundWords.at(index)));
  view_->setBackground(background_, style);
}

}  // namespace scantrove
