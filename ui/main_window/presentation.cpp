#include "ui/main_window/presentation.h"

#include <QAction>
#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>
#include <utility>

#include "ui/main_window/dock_arrangement.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/project_choice.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/message_bar.h"

namespace scantrove {
namespace {

constexpr int kTurnEach_ms = 60;
constexpr int kIdle_ms = 4000;
constexpr int kCaption_ms = 6000;
constexpr int kRepeatAfter_ms = 12000;
constexpr float kTurn_rad = 0.006F;

}  // namespace

Presentation::Presentation(MainWindow& window)
    : QObject(&window), window_(window), caption_(new QLabel(window.parts().scene)) {
  caption_->setObjectName(QStringLiteral("presentationCaption"));
  caption_->setAttribute(Qt::WA_TransparentForMouseEvents);
  caption_->setAlignment(Qt::AlignCenter);
  caption_->setTextFormat(Qt::PlainText);
  caption_->setStyleSheet(
      QStringLiteral("background: rgba(12, 14, 18, 200); color: #ffffff; border-radius: 14px; padding: 14px "
                     "30px; font-size: 30pt;"));
  caption_->hide();
  turning_.setInterval(kTurnEach_ms);
  connect(&turning_, &QTimer::timeout, this, &Presentation::turn);
  caption_timer_.setSingleShot(true);
  connect(&caption_timer_, &QTimer::timeout, caption_, &QWidget::hide);
  repeat_timer_.setSingleShot(true);
  connect(&repeat_timer_, &QTimer::timeout, this, [this] {
    if (is_on_) window_.controller().start();
  });
  ScanBridge& bridge = window_.controller().bridge();
  bridge.on<ObjectAdded>(this, [this](const ObjectAdded& added) {
    showCaption(tr("Object found: %1").arg(QString::fromStdString(added.name)));
  });
  bridge.on<ObjectRecognized>(this, [this](const ObjectRecognized& known) {
    showCaption(tr("Recognised: %1").arg(QString::fromStdString(known.name)));
  });
  bridge.on<PreparingDevice>(this, [this] { showCaption(tr("Preparing the OpenCL device (once)")); });
  bridge.on<StateChanged>(this, [this] {
    if (is_on_) hideOthers();
    removeEndedCatalogues();
  });
  bridge.on<ScanFinished>(this, [this] { scanHasEnded(); });
  bridge.on<ScanFailed>(this, [this] { scanHasEnded(); });
}

void Presentation::begin() {
  if (std::exchange(is_on_, true)) return;
  was_maximized_ = window_.isMaximized();
  window_.parts().actions->image_mode->setChecked(false);  // it shows the scene
  hideOthers();
  window_.showFullScreen();
  ScanController& controller = window_.controller();
  if (window_.onStartPage()) {
    catalogue_ = std::make_unique<QTemporaryDir>();
    controller.setCatalogue(catalogue_->filePath(QStringLiteral("catalogue.sqlite")));
    controller.setSavesScans(false);
  }
  qApp->installEventFilter(this);
  since_input_.start();
  turning_.start();
  showCaption(tr("Scantrove"));
}

void Presentation::hideOthers() {
  QList<QWidget*> others{window_.menuBar(), window_.statusBar()};
  for (QToolBar* bar : window_.findChildren<QToolBar*>()) others << bar;
  for (QDockWidget* dock : window_.docks().docks()) others << dock;
  for (QWidget* widget : others) {
    if (widget->isHidden()) continue;
    hidden_ << widget;
    widget->hide();
  }
}

void Presentation::end() {
  if (!std::exchange(is_on_, false)) return;
  qApp->removeEventFilter(this);
  turning_.stop();
  repeat_timer_.stop();
  caption_->hide();
  for (QWidget* widget : std::exchange(hidden_, {})) widget->show();
  if (catalogue_ != nullptr) {
    window_.closeScan();
    window_.controller().setSavesScans(true);
    window_.controller().setProject(window_.project().project());
    ended_catalogues_.push_back(std::move(catalogue_));
  }
  was_maximized_ ? window_.showMaximized() : window_.showNormal();
}

QString Presentation::caption() const { return caption_->isVisible() ? caption_->text() : QString(); }

void Presentation::showCaption(const QString& text) {
  if (!is_on_) return;
  caption_->setText(text);
  caption_->adjustSize();
  placeCaption();
  caption_->show();
  caption_->raise();
  caption_timer_.start(kCaption_ms);
}

void Presentation::placeCaption() {
  const QWidget* const room = caption_->parentWidget();
  caption_->move((room->width() - caption_->width()) / 2, room->height() - caption_->height() - 40);
}

void Presentation::turn() {
  if (since_input_.elapsed() < kIdle_ms) return;
  window_.parts().scene->view()->turn(kTurn_rad);
}

void Presentation::scanHasEnded() {
  if (!is_on_ || catalogue_ == nullptr) return;
  window_.parts().messages->dismiss();
  repeat_timer_.start(kRepeatAfter_ms);
}

void Presentation::removeEndedCatalogues() {
  if (!window_.controller().bridge().busy()) ended_catalogues_.clear();
}

bool Presentation::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::KeyPress:
    case QEvent::ShortcutOverride:
      if (static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        if (event->type() == QEvent::KeyPress) end();
        event->accept();
        return true;
      }
      since_input_.start();
      break;
    case QEvent::MouseMove:
    case QEvent::MouseButtonPress:
    case QEvent::Wheel:
      since_input_.start();
      break;
    case QEvent::Resize:
      if (watched == caption_->parentWidget()) placeCaption();
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace scantrove
