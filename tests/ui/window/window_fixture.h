#pragma once
#include <QLineEdit>
#include <QSettings>
#include <QTest>
#include <QToolButton>
#include <memory>

#include "tests/ui/scripted_worker.h"
#include "tests/ui/window/catalogue_fixture.h"
#include "ui/main_window/main_window.h"
#include "ui/models/object_list_model.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"

namespace scantrove::test {

/// The window with a fresh catalogue and a scripted worker.
class WindowTest : public CatalogueTest {
 protected:
  void SetUp() override {
    QSettings().clear();
    CatalogueTest::SetUp();
    restart();
  }

  /// A new window over the same catalogue, as after a restart of the program.
  void restart() { restartWith(file_); }

  /// As restart(), with `catalogue` or `project` on the command line; empty: none.
  void restartWith(const QString& catalogue, const QString& project = {}) {
    window_.reset();
    WindowOptions options;
    options.project = project.toStdString();
    options.database = catalogue.toStdString();
    options.width = 1280;
    options.height = 800;
    window_ = std::make_unique<MainWindow>(ScriptedWorker::factory(worker_), options);
    window_->show();
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }

  ObjectListView* list() { return window_->parts().objects->list(); }

  QModelIndex rowOf(ObjectId object) {
    for (int i = 0; i < list()->model()->rowCount(); ++i) {
      const QModelIndex index = list()->model()->index(i, 0);
      if (index.data(ObjectListModel::ObjectIdRole).toUInt() == object.value) return index;
    }
    return {};
  }

  void clickOn(ObjectId object, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseClick(list()->viewport(), Qt::LeftButton, modifiers,
                      list()->visualRect(rowOf(object)).center());
  }

  /// The open name field, or null.
  QLineEdit* nameEditor() {
    auto* field = list()->findChild<QLineEdit*>(QStringLiteral("objectNameEditor"));
    return field->isVisible() ? field : nullptr;
  }

  void pressButton(QAction* action) {
    for (QToolButton* button : window_->parts().objects->findChildren<QToolButton*>()) {
      if (button->defaultAction() != action) continue;
      QTest::mouseClick(button, Qt::LeftButton);
      return;
    }
    FAIL() << "no button for " << action->text().toStdString();
  }

  ScanSnapshot snapshotOf(int frame) {
    ScanSnapshot snapshot;
    snapshot.state = ScanState::scanning;
    snapshot.frame_index = frame;
    snapshot.frames.read = frame + 1;
    snapshot.frames_total = 100;
    snapshot.pose.state = TrackingState::tracking;
    snapshot.K = {290, 290, 160, 120, 320, 240};
    snapshot.color = cv::Mat(480, 640, CV_8UC3, cv::Scalar(40, 80, 120));
    snapshot.depth_raw_m = cv::Mat(240, 320, CV_32FC1, cv::Scalar(1.5));
    snapshot.depth_fused_m = snapshot.depth_raw_m;
    snapshot.segments = cv::Mat(240, 320, CV_32SC1, cv::Scalar(2));
    snapshot.regions = cv::Mat(240, 320, CV_32SC1, cv::Scalar(5));
    return snapshot;
  }

  ScriptedWorker* worker_ = nullptr;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace scantrove::test
