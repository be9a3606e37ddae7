// A user types, selects and reads while a scan reports objects: nothing newly reported may disturb that.
#include <QApplication>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QMenuBar>
#include <QScrollBar>
#include <QTimer>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/recent_sources.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/views_strip.h"

namespace scantrove {
namespace {

constexpr int kReportInterval_ms = 33;
constexpr int kKeyInterval_ms = 40;

/// A scan that reports 30 times a second: a snapshot, and in turn a new object, another view of an old one,
/// or a rename and confirmation of the newest object by another program.
class AppearedObjectsTest : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    auto opened = ObjectDatabase::open(file_.toStdString());
    ASSERT_TRUE(opened);
    other_ = std::move(*opened);
    window_->open(QStringLiteral("demo"));
    QObject::connect(&timer_, &QTimer::timeout, [this] { reportNext(); });
    timer_.start(kReportInterval_ms);
  }

  void reportNext() {
    ++reports_;
    if (reports_ % 3 == 1) {
      const auto added = other_->addObject(test::discView({0, 200, 255}));
      ASSERT_TRUE(added) << added.error().message();
      newest_ = added->id;
      worker_->report(ObjectAdded{added->id, added->name});
    } else if (reports_ % 3 == 2) {
      ObjectView view = test::discView({40, 90, 160});
      view.object = objects_[static_cast<std::size_t>(reports_) % 2];  // the third object keeps one view
      ASSERT_TRUE(other_->addView(view));
      worker_->report(ViewAdded{view.object});
    } else if (newest_) {
      ASSERT_TRUE(other_->rename(newest_, "other " + std::to_string(reports_)));
      ASSERT_TRUE(other_->setConfirmed(std::vector{newest_}, true));
    }
    ScanSnapshot snapshot = snapshotOf(reports_);
    snapshot.frames_total = 100'000;
    SeenObject seen;
    seen.object = objects_[static_cast<std::size_t>(reports_) % 3];
    seen.box = {0.3F, 0.3F, 0.2F, 0.2F};
    snapshot.objects = {seen};
    worker_->report(std::move(snapshot));
  }

  /// Waits until `count` more reports were sent and delivered.
  void awaitReports(int count) {
    const int requested = reports_ + count;
    ASSERT_TRUE(QTest::qWaitFor([&] { return reports_ >= requested; }, 30'000));
    QTest::qWait(150);
  }

  /// Types letter by letter, with reports in between.
  void type(QWidget* field, const QString& text) {
    for (const QChar letter : text) {
      QTest::keyClicks(field, QString(letter));
      QTest::qWait(kKeyInterval_ms);
    }
  }

  void beginName(ObjectId object) {
    list()->scrollTo(rowOf(object));
    clickOn(object);
    QTest::keyClick(list(), Qt::Key_F2);
    ASSERT_NE(nameEditor(), nullptr);
  }

  void awaitRowRemoved(ObjectId object) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !rowOf(object).isValid(); }, 5000));
  }

  std::unique_ptr<ObjectDatabase> other_;
  QTimer timer_;
  int reports_ = 0;
  ObjectId newest_;
};

TEST_F(AppearedObjectsTest, TypedNameIsStoredForItsObject) {
  const QStringList names = {QStringLiteral("Green cup with a handle"), QStringLiteral("Kettle 2"),
                             QStringLiteral("Box of tea, half empty")};
  for (qsizetype i = 0; i < names.size(); ++i) {
    const ObjectId object = objects_[static_cast<std::size_t>(i)];
    beginName(object);
    type(nameEditor(), names[i]);
    EXPECT_EQ(nameEditor()->text(), names[i]);
    QTest::keyClick(nameEditor(), Qt::Key_Return);
    EXPECT_EQ(nameEditor(), nullptr);
    EXPECT_EQ(stored(object).name, names[i].toStdString());
  }
  for (qsizetype i = 0; i < names.size(); ++i) {
    EXPECT_EQ(stored(objects_[static_cast<std::size_t>(i)]).name, names[i].toStdString());
  }
  EXPECT_GE(reports_, 30);
}

TEST_F(AppearedObjectsTest, EscapeKeepsTheName) {
  beginName(objects_[1]);
  type(nameEditor(), QStringLiteral("something"));
  QTest::keyClick(nameEditor(), Qt::Key_Escape);
  EXPECT_EQ(nameEditor(), nullptr);
  EXPECT_TRUE(list()->hasFocus());
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
}

TEST_F(AppearedObjectsTest, NameIsStored_WhenTheFieldLosesFocusButNotTheWindow) {
  beginName(objects_[1]);
  type(nameEditor(), QStringLiteral("Green"));
  QFocusEvent away(QEvent::FocusOut, Qt::ActiveWindowFocusReason);
  QCoreApplication::sendEvent(nameEditor(), &away);
  ASSERT_NE(nameEditor(), nullptr);
  EXPECT_EQ(stored(objects_[1]).name, "Obj_2");
  type(nameEditor(), QStringLiteral(" cup"));
  clickOn(objects_[0]);
  EXPECT_EQ(nameEditor(), nullptr);
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
}

TEST_F(AppearedObjectsTest, NameGoesToTheMergedObject_WhenItsObjectWasMerged) {
  ASSERT_TRUE(other_->rename(objects_[0], "Kept"));
  beginName(objects_[1]);
  type(nameEditor(), QStringLiteral("Gre"));
  const auto merged = other_->merge(std::vector{objects_[0], objects_[1]});
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->into, objects_[0]);
  awaitRowRemoved(objects_[1]);
  type(nameEditor(), QStringLiteral("en cup"));
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  EXPECT_EQ(stored(objects_[0]).name, "Green cup");
}

TEST_F(AppearedObjectsTest, NameStaysInItsField_WhenItsObjectWasDeleted) {
  beginName(objects_[1]);
  type(nameEditor(), QStringLiteral("Green"));
  ASSERT_TRUE(other_->remove(std::vector{objects_[1]}));
  awaitRowRemoved(objects_[1]);
  type(nameEditor(), QStringLiteral(" cup"));
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  ASSERT_NE(nameEditor(), nullptr);
  EXPECT_EQ(nameEditor()->text(), QStringLiteral("Green cup"));
  EXPECT_TRUE(window_->parts().messages->isVisible());
  EXPECT_TRUE(window_->parts().messages->text().contains(QStringLiteral("Green cup")));
  // Neither closing the window nor naming another object discards it.
  EXPECT_FALSE(window_->close());
  list()->editName(objects_[0]);
  EXPECT_EQ(nameEditor()->text(), QStringLiteral("Green cup"));
  ASSERT_TRUE(other_->restore(std::vector{objects_[1]}));
  ASSERT_TRUE(QTest::qWaitFor([&] { return rowOf(objects_[1]).isValid(); }, 5000));
  QTest::keyClick(nameEditor(), Qt::Key_Return);
  EXPECT_EQ(nameEditor(), nullptr);
  EXPECT_EQ(stored(objects_[1]).name, "Green cup");
}

TEST_F(AppearedObjectsTest, ReturnConfirmsTheSelectedObject) {
  clickOn(objects_[2]);
  awaitReports(12);
  EXPECT_EQ(list()->selection(), std::vector{objects_[2]});
  QTest::keyClick(list(), Qt::Key_Return);
  EXPECT_TRUE(stored(objects_[2]).confirmed);
  EXPECT_FALSE(stored(objects_[0]).confirmed);
  EXPECT_FALSE(stored(objects_[1]).confirmed);
}

TEST_F(AppearedObjectsTest, SelectionIsKept_AndFollowsAMerge) {
  clickOn(objects_[1]);
  clickOn(objects_[2], Qt::ControlModifier);
  awaitReports(12);
  EXPECT_EQ(list()->selection(), (std::vector{objects_[1], objects_[2]}));
  ASSERT_TRUE(other_->rename(objects_[0], "Kept"));
  ASSERT_TRUE(other_->merge(std::vector{objects_[0], objects_[2]}));
  awaitRowRemoved(objects_[2]);
  EXPECT_EQ(list()->selection(), (std::vector{objects_[0], objects_[1]}));
  QTest::keyClick(list(), Qt::Key_Return);
  EXPECT_TRUE(stored(objects_[0]).confirmed);
  EXPECT_TRUE(stored(objects_[1]).confirmed);
}

TEST_F(AppearedObjectsTest, KeysChangeNoOtherObject_WhenTheSelectedOneIsDeleted) {
  clickOn(objects_[1]);
  ASSERT_TRUE(other_->remove(std::vector{objects_[1]}));
  awaitRowRemoved(objects_[1]);
  for (const Qt::Key key : {Qt::Key_Return, Qt::Key_F2, Qt::Key_Delete}) QTest::keyClick(list(), key);
  EXPECT_EQ(nameEditor(), nullptr);
  for (const ObjectId object : {objects_[0], objects_[2]}) {
    EXPECT_FALSE(stored(object).confirmed);
    EXPECT_EQ(stored(object).id, object);
  }
}

TEST_F(AppearedObjectsTest, OpenMenuKeepsItsTextAndItsObject) {
  const QPoint point = list()->visualRect(rowOf(objects_[1])).center();
  QTest::mousePress(list()->viewport(), Qt::RightButton, {}, point);
  QContextMenuEvent event(QContextMenuEvent::Mouse, point, list()->viewport()->mapToGlobal(point));
  QCoreApplication::sendEvent(list()->viewport(), &event);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_NE(menu, nullptr);
  QTest::mouseRelease(list()->viewport(), Qt::RightButton, {}, point);
  QAction* confirm = window_->parts().objects->actions().confirm;
  const QString text = confirm->text();
  // Another program confirms it: the text under the mouse must not change to its opposite.
  ASSERT_TRUE(other_->setConfirmed(std::vector{objects_[1]}, true));
  awaitReports(12);
  EXPECT_EQ(QApplication::activePopupWidget(), menu);
  EXPECT_EQ(confirm->text(), text);
  QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(confirm).center());
  EXPECT_TRUE(stored(objects_[1]).confirmed);
  EXPECT_FALSE(stored(objects_[0]).confirmed);
  ASSERT_TRUE(QTest::qWaitFor([&] { return confirm->text() != text; }, 3000));
}

TEST_F(AppearedObjectsTest, VisibleRowsStayInPlace) {
  awaitReports(60);
  list()->verticalScrollBar()->setValue(100);
  const QModelIndex row = list()->indexAt(QPoint(20, 20));
  const ObjectId object{row.data(ObjectListModel::ObjectIdRole).toUInt()};
  const int top = list()->visualRect(row).top();
  ASSERT_TRUE(other_->remove(std::vector{objects_[0]}));
  awaitRowRemoved(objects_[0]);
  EXPECT_EQ(list()->visualRect(rowOf(object)).top(), top);
  awaitReports(12);
  EXPECT_EQ(list()->visualRect(rowOf(object)).top(), top);
  EXPECT_GT(list()->newBelow(), 0);
}

TEST_F(AppearedObjectsTest, RowsAreNotRemoved_WhileTheMouseIsPressed) {
  QTest::mousePress(list()->viewport(), Qt::LeftButton, {}, list()->visualRect(rowOf(objects_[1])).center());
  ASSERT_TRUE(other_->remove(std::vector{objects_[0]}));
  awaitReports(12);
  EXPECT_TRUE(rowOf(objects_[0]).isValid());
  QTest::mouseRelease(list()->viewport(), Qt::LeftButton, {},
                      list()->visualRect(rowOf(objects_[1])).center());
  awaitRowRemoved(objects_[0]);
}

TEST_F(AppearedObjectsTest, VisibleViewsStayInPlace) {
  awaitReports(90);
  const ObjectId object = objects_[0];
  clickOn(object);
  ViewsStrip* strip = window_->parts().objects->viewsStrip();
  strip->setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(strip, Qt::Key_Right);
  const int offset = strip->offset();
  const std::size_t count = strip->count();
  ASSERT_GT(offset, 0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return strip->count() > count; }, 5000));
  EXPECT_GT(strip->offset(), offset);
}

TEST_F(AppearedObjectsTest, TypedNumberIsKeptAndUsed) {
  auto* fields = window_->findChild<QToolButton*>(QStringLiteral("moreSettings"));
  ASSERT_NE(fields, nullptr);
  QTest::mouseClick(fields, Qt::LeftButton);
  auto* number = window_->findChild<QDoubleSpinBox*>(QStringLiteral("discovery.min_size_m"));
  ASSERT_NE(number, nullptr);
  number->setFocus();
  number->selectAll();
  type(number, QStringLiteral("0.17"));
  awaitReports(6);
  EXPECT_EQ(number->cleanText(), QStringLiteral("0.17"));
  window_->open(QStringLiteral("demo"));
  EXPECT_FLOAT_EQ(worker_->last_request.params.discovery.min_size_m, 0.17F);
}

TEST_F(AppearedObjectsTest, OpenMenuOfRecentSourcesDoesNotChange) {
  addRecentSource(QStringLiteral("demo:room"));
  QMenu* file = nullptr;
  for (QAction* action : window_->menuBar()->actions()) {
    if (action->text() == QStringLiteral("&File")) file = action->menu();
  }
  ASSERT_NE(file, nullptr);
  file->popup(window_->mapToGlobal(QPoint(10, 40)));
  const QList<QAction*> before = window_->findChild<QMenu*>(QStringLiteral("recentMenu"))->actions();
  ASSERT_GE(before.size(), 2);
  window_->open(QStringLiteral("demo"));
  awaitReports(6);
  EXPECT_EQ(window_->findChild<QMenu*>(QStringLiteral("recentMenu"))->actions(), before);
  file->hide();
}

TEST_F(AppearedObjectsTest, EachPressOfSpacePausesOrResumes) {
  ASSERT_TRUE(QTest::qWaitFor([&] { return window_->parts().actions->pause->isEnabled(); }, 3000));
  worker_->commands.clear();
  for (int i = 0; i < 3; ++i) QTest::keyClick(window_.get(), Qt::Key_Space);
  QTest::keyClick(window_.get(), Qt::Key_N);
  EXPECT_EQ(worker_->commands, (std::vector<std::string>{"pause", "resume", "pause", "step"}));
}

}  // namespace
}  // namespace scantrove
