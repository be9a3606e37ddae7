#include "ui/main_window/scene_pane.h"

#include <QAction>
#include <QFrame>
#include <QHBoxLayout>
#include <QToolButton>

#include "ui/main_window/view_actions.h"
#include "ui/panels/scene_overlay.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {

ScenePane::ScenePane(QWidget* parent)
    : QWidget(parent),
      view_(new SceneView(this)),
      overlay_(new SceneOverlay(this)),
      buttons_(new QFrame(this)),
      follow_(new QAction(icon(QStringLiteral("follow")), tr("&Follow the camera"), this)),
      fit_(new QAction(icon(QStringLiteral("fit")), tr("Show &all"), this)),
      grid_(new QAction(icon(QStringLiteral("grid")), tr("Ground &grid"), this)),
      view_actions_(new ViewActions(view_, this)) {
  follow_->setCheckable(true);
  follow_->setChecked(true);
  follow_->setShortcut(QKeySequence(Qt::Key_F));
  follow_->setToolTip(tr("Follow the camera (F)"));
  fit_->setShortcut(QKeySequence(tr("Ctrl+0")));
  fit_->setToolTip(tr("Show all (Home or double click in the view)"));
  grid_->setCheckable(true);
  grid_->setChecked(true);
  grid_->setShortcut(QKeySequence(Qt::Key_G));
  grid_->setToolTip(tr("Ground grid, half-metre squares (G)"));
  connect(follow_, &QAction::toggled, view_, &SceneView::setFollowing);
  connect(view_, &SceneView::followingChanged, follow_, &QAction::setChecked);
  connect(fit_, &QAction::triggered, view_, &SceneView::fitAll);
  connect(grid_, &QAction::toggled, view_, &SceneView::setGridVisible);

  buttons_->setObjectName(QStringLiteral("sceneButtons"));
  auto* row = new QHBoxLayout(buttons_);
  row->setContentsMargins(4, 4, 4, 4);
  row->setSpacing(2);
  row->addWidget(view_actions_->makeColoringButton());
  for (QAction* action : {view_actions_->backgroundAction(), view_actions_->clipAction(),
                          view_actions_->measureAction(), follow_, fit_, grid_}) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setIconSize({18, 18});
    button->setFocusPolicy(Qt::TabFocus);
    button->setAccessibleName(action->text().remove(QLatin1Char('&')));
    row->addWidget(button);
  }
  connect(&Theme::instance(), &Theme::changed, this, &ScenePane::paintTheme);
  paintTheme();
}

void ScenePane::resizeEvent(QResizeEvent* /*event*/) {
  view_->setGeometry(rect());
  overlay_->setGeometry(rect());
  overlay_->raise();
  buttons_->adjustSize();
  buttons_->move(width() - buttons_->width() - 12, 12);
  buttons_->raise();
}

void ScenePane::paintTheme() {
  const ThemeColors& colors = Theme::instance().colors();
  view_->setColors({colors.scene_top, colors.scene_bottom, colors.scene_grid, colors.scene_trail});
  buttons_->setStyleSheet(
      QStringLiteral("#sceneButtons { background: %1; border: 1px solid %2; border-radius: 9px; }")
          .arg(colors.surface.name(), colors.outline.name()));
}

}  // namespace scantrove
