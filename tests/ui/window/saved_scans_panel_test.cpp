#include "ui/panels/saved_scans_panel.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QLabel>
#include <QSignalSpy>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>
#include <iostream>

#include "core/base/file_lock.h"
#include "ui/main_window/saved_scan_list.h"
#include "ui/panels/start_page.h"

namespace scantrove {
namespace {

TEST(SavedScansPanel, ClickOpensAScan_AndDeleteKeyDeletesIt) {
  SavedScansPanel list;
  EXPECT_TRUE(list.isHidden()) << "no saved scans";
  list.setScans({{QStringLiteral("/a"), QStringLiteral("kitchen"), QStringLiteral("5 frames"), {}},
                 {QStringLiteral("/b"), QStringLiteral("desk"), {}, {}}});
  EXPECT_FALSE(list.isHidden());
  list.show();
  list.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&list));
  const QSignalSpy chosen(&list, &SavedScansPanel::chosen), deleted(&list, &SavedScansPanel::deleteRequested);
  const QList<QToolButton*> cards = list.findChildren<QToolButton*>(QStringLiteral("startCard"));
  ASSERT_EQ(cards.size(), 2);
  QTest::mouseClick(cards[0], Qt::LeftButton);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen[0][0].toString(), QStringLiteral("/a"));
  cards[1]->setFocus();
  QTest::keyClick(cards[1], Qt::Key_Delete);
  ASSERT_EQ(deleted.count(), 1);
  EXPECT_EQ(deleted[0][0].toString(), QStringLiteral("/b"));
}

TEST(SavedScansPanel, PutsCardsBelowEachOther_WhereTwoHaveNoRoom) {
  SavedScansPanel list;
  list.setScans({{QStringLiteral("/a"), QStringLiteral("kitchen"), QStringLiteral("5 frames"), {}},
                 {QStringLiteral("/b"), QStringLiteral("desk"), QStringLiteral("5 frames"), {}}});
  list.resize(820, 200);
  list.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&list));
  const QList<QToolButton*> cards = list.findChildren<QToolButton*>(QStringLiteral("startCard"));
  ASSERT_EQ(cards.size(), 2);
  EXPECT_EQ(cards[0]->y(), cards[1]->y());
  list.resize(440, 300);
  QTest::qWait(50);
  EXPECT_EQ(cards[0]->x(), cards[1]->x());
  EXPECT_GT(cards[1]->y(), cards[0]->y());
  EXPECT_GT(cards[0]->width(), 400) << "the empty second column takes no room";
}

/// Texts of labels that are cut off, leave their card or overlap another label.
QStringList cutLabels(const QWidget& page) {
  QStringList cut;
  for (const QToolButton* card : page.findChildren<QToolButton*>(QStringLiteral("startCard"))) {
    const QList<QLabel*> labels = card->findChildren<QLabel*>();
    for (const QLabel* label : labels) {
      const QRect area(label->mapTo(card, QPoint()), label->size());
      const int needed =
          label->hasHeightForWidth() ? label->heightForWidth(label->width()) : label->sizeHint().height();
      const int width = label->wordWrap() ? 0 : label->fontMetrics().horizontalAdvance(label->text());
      if (!card->rect().contains(area) || label->height() < needed || label->width() < width)
        cut << label->text();
      for (const QLabel* other : labels) {
        if (other != label && area.intersects(QRect(other->mapTo(card, QPoint()), other->size())))
          cut << label->text() + QStringLiteral(" over ") + other->text();
      }
    }
  }
  return cut;
}

TEST(StartPage, CardsShowTheirTextsCompletely) {
  StartPage page;
  const QString long_title = QStringLiteral("a recording of the whole kitchen from the door to the window");
  const QString details = QStringLiteral(
      "29 Nov, 01:23 · in use · recovered\n1,300 frames · 112 objects · 1,099 MB\nthe large blue mug, the "
      "red "
      "tin, the lunch box, …");
  page.savedScans()->setScans(
      {{QStringLiteral("/scans/a"), long_title, details, {}},
       {QStringLiteral("/scans/b"), QStringLiteral("demo:room:31"), details, {}},
       {QStringLiteral("/scans/c"),
        QStringLiteral("damaged"),
        QStringLiteral("The file /scans/c/session.sqlite is not a database. Give another folder."),
        {}}});
  for (const QSize size : {QSize(1366, 660), QSize(683, 330)}) {
    page.resize(size);
    page.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&page));
    QTest::qWait(50);
    EXPECT_EQ(cutLabels(page).join(QStringLiteral(" | ")).toStdString(), "");
  }
  const QString tip = page.savedScans()->findChild<QToolButton*>()->toolTip();
  EXPECT_TRUE(tip.contains(long_title)) << "the tooltip has the complete title";
  EXPECT_TRUE(tip.contains(QStringLiteral("the lunch box")));
  EXPECT_TRUE(tip.contains(QStringLiteral("/scans/a")));
}

TEST(DeleteScan, MovesTheFolderToTheTrash_AndUndoRestoresIt) {
  const QTemporaryDir home(QDir::homePath() + QStringLiteral("/scantrove-test-XXXXXX"));
  const QString folder = home.filePath(QStringLiteral("scan"));
  ASSERT_TRUE(QDir().mkpath(folder));
  QFile file(folder + QStringLiteral("/session.sqlite"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("x");
  file.close();
  QString failure;
  int steps = 0;
  QUndoStack undo;
  undo.push(new DeleteScan(
      folder, [&] { ++steps; }, [&](const QString& message) { failure = message; }));
  EXPECT_TRUE(failure.isEmpty()) << failure.toStdString();
  EXPECT_FALSE(QDir(folder).exists());
  undo.undo();
  EXPECT_TRUE(QFile::exists(folder + QStringLiteral("/session.sqlite")));
  EXPECT_EQ(steps, 2);
  const QDir notes(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) +
                   QStringLiteral("/Trash/info"));
  for (const QFileInfo& entry : notes.entryInfoList(QDir::Files)) {
    QFile note(entry.filePath());
    EXPECT_FALSE(note.open(QIODevice::ReadOnly) && note.readAll().contains(folder.toUtf8()))
        << "the trash has no note of a folder that is not there";
  }
}

TEST(DeleteScan, ReportsAFailure_WhichIsNoUndoStep) {
  QString failure;
  QUndoStack undo;
  undo.push(new DeleteScan(
      QStringLiteral("/nowhere/at all"), [] {}, [&](const QString& message) { failure = message; }));
  EXPECT_TRUE(failure.contains(QStringLiteral("/nowhere/at all")));
  EXPECT_FALSE(undo.canUndo());
}

// What another program writes into an open scan would be lost with the trash.
TEST(DeleteScan, LeavesAScanThatIsInUse) {
  if (!QFile::exists(QStringLiteral("/proc/locks"))) {
    std::cerr << "NOT TESTED: whether a scan is in use, for this system does not tell.\n";
    return;
  }
  const QTemporaryDir home(QDir::homePath() + QStringLiteral("/scantrove-test-XXXXXX"));
  const QString folder = home.filePath(QStringLiteral("scan"));
  ASSERT_TRUE(QDir().mkpath(folder));
  const Result<FileLock> lock =
      FileLock::take((folder + QStringLiteral("/session.lock")).toStdString(), {"It is in use.", ""});
  ASSERT_TRUE(lock);
  QString failure;
  QUndoStack undo;
  undo.push(new DeleteScan(
      folder, [] {}, [&](const QString& message) { failure = message; }));
  EXPECT_TRUE(failure.contains(folder)) << failure.toStdString();
  EXPECT_TRUE(QDir(folder).exists());
  EXPECT_FALSE(undo.canUndo());
}

}  // namespace
}  // namespace scantrove
