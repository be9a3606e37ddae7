#include "ui/main_window/dock_arrangement.h"

#include <QAbstractButton>
#include <QAction>
#include <QEvent>
#include <QLayout>
#include <QScreen>
#include <QSettings>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kLayoutVersion = 2;
/// On smaller screens docks are tabbed.
constexpr int kMinWidthForColumns = 1000;
constexpr int kMinHeightToStack = 640;
const QString kLayoutKey = QStringLiteral("window/docks");

QString widthKey(const QDockWidget* dock) { return QStringLiteral("window/width/") + dock->objectName(); }

/// Qt's icon does not follow the theme and returns with each change of style.
void drawCloseButton(const QDockWidget& dock) {
  if (auto* button = dock.findChild<QAbstractButton*>(QStringLiteral("qt_dockwidget_closebutton"))) {
    button->setIcon(icon(QStringLiteral("close")));
    button->setToolTip(DockArrangement::tr("Close (%1)")
                           .arg(dock.toggleViewAction()->shortcut().toString(QKeySequence::NativeText)));
  }
}

}  // namespace

DockArrangement::DockArrangement(QMainWindow& window) : QObject(&window), window_(window) {
  window_.setDockNestingEnabled(true);
  window_.installEventFilter(this);
}

QDockWidget* DockArrangement::add(const Dock& dock, QWidget* content) {
  auto* widget = new QDockWidget(dock.title, &window_);
  widget->setObjectName(QString::fromLatin1(dock.name));
  widget->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable);
  widget->setWidget(content);
  widget->toggleViewAction()->setShortcut(QKeySequence(dock.key));
  // A dock that the user opened or closed keeps that state during a scan.
  connect(widget->toggleViewAction(), &QAction::triggered, this,
          [this, widget] { waiting_for_scan_.removeAll(widget); });
  connect(&Theme::instance(), &Theme::changed, widget, [widget] { drawCloseButton(*widget); });
  drawCloseButton(*widget);
  window_.addDockWidget(dock.area, widget);
  docks_ << widget;
  defaults_.emplace(widget, dock);
  preferred_widths_[widget] = dock.default_width;
  return widget;
}

void DockArrangement::restore() {
  resetLayout();
  const QSettings settings;
  for (QDockWidget* dock : docks_) {
    preferred_widths_[dock] = settings.value(widthKey(dock), preferred_widths_[dock]).toInt();
  }
  window_.restoreState(settings.value(kLayoutKey).toByteArray(), kLayoutVersion);
  applyWidthsSoon();
}

void DockArrangement::save() {
  QSettings settings;
  for (QDockWidget* dock : docks_) settings.setValue(widthKey(dock), preferred_widths_[dock]);
  for (QDockWidget* dock : waiting_for_scan_) dock->show();
  settings.setValue(kLayoutKey, window_.saveState(kLayoutVersion));
}

void DockArrangement::resetLayout() { arrangeFor(window_.screen()->availableSize()); }

void DockArrangement::arrangeFor(const QSize& room) {
  const bool has_columns = room.width() >= kMinWidthForColumns;
  const bool is_folded = !has_columns || room.height() < kMinHeightToStack;
  std::map<Qt::DockWidgetArea, QDockWidget*> above;
  for (QDockWidget* dock : docks_) {
    const Qt::DockWidgetArea area = has_columns ? defaults_.at(dock).area : Qt::LeftDockWidgetArea;
    window_.addDockWidget(area, dock);
    dock->show();
    if (!above.contains(area)) {
      above[area] = dock;
    } else if (is_folded) {
      window_.tabifyDockWidget(above[area], dock);
    } else {
      window_.splitDockWidget(std::exchange(above[area], dock), dock, Qt::Vertical);
    }
    preferred_widths_[dock] = std::min(defaults_.at(dock).default_width, room.width() / 2);
  }
  if (is_folded) {
    for (const auto& [area, dock] : above) dock->raise();
  }
  if (!is_scan_shown_) setScanShown(false);
  applyWidths();
}

void DockArrangement::setScanShown(bool shown) {
  is_scan_shown_ = shown;
  if (shown) {
    for (QDockWidget* dock : std::exchange(waiting_for_scan_, {})) dock->show();
    docks_.first()->raise();  // if the docks are tabbed
    applyWidths();
    return;
  }
  for (QDockWidget* dock : docks_) {
    if (!defaults_.at(dock).only_with_scan || dock->isHidden()) continue;
    waiting_for_scan_.removeAll(dock);
    waiting_for_scan_ << dock;
    dock->hide();
  }
}

std::map<QDockWidget*, int> DockArrangement::presentWidths() const {
  std::map<QDockWidget*, int> widths;
  for (QDockWidget* dock : docks_) {
    if (dock->isVisible() && !dock->isFloating()) widths[dock] = dock->width();
  }
  return widths;
}

void DockArrangement::applyWidths() {
  QList<QDockWidget*> shown;
  QList<int> widths;
  for (QDockWidget* dock : docks_) {
    if (dock->isHidden()) continue;
    shown << dock;
    widths << preferred_widths_[dock];
  }
  window_.resizeDocks(shown, widths, Qt::Horizontal);
  // resizeDocks() takes effect with the next layout.
  window_.layout()->invalidate();
  window_.layout()->activate();
}

void DockArrangement::applyWidthsSoon() { QTimer::singleShot(0, this, &DockArrangement::applyWidths); }

void DockArrangement::recordWidths() {
  for (const auto& [dock, width] : presentWidths()) {
    const auto before = widths_at_press_.find(dock);
    if (before != widths_at_press_.end() && before->second != width) preferred_widths_[dock] = width;
  }
}

bool DockArrangement::eventFilter(QObject* watched, QEvent* event) {
  // The separators of docks are no widgets, so the window gets their mouse events.
  if (event->type() == QEvent::MouseButtonPress) widths_at_press_ = presentWidths();
  if (event->type() == QEvent::MouseButtonRelease)
    QTimer::singleShot(0, this, &DockArrangement::recordWidths);
  if (event->type() == QEvent::Resize) applyWidthsSoon();
  return QObject::eventFilter(watched, event);
}

}  // namespace scantrove
