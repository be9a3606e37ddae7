#include "ui/panels/kept_scans.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QLabel>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>

#include "ui/main_window/kept_scan_list.h"

namespace scantrove {
namespace {

TEST(KeptScans, AClickOpensOneAndDelDeletesIt) {
  KeptScans list;
  EXPECT_TRUE(list.isHidden()) << "there are none";
  list.setScans({{QStringLiteral("/a"), QStringLiteral("kitchen"), QStringLiteral("5 frames"), {}},
                 {QStringLiteral("/b"), QStringLiteral("desk"), {}, {}}});
  EXPECT_FALSE(list.isHidden());
  list.show();
  list.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&list));
  const QSignalSpy chosen(&list, &KeptScans::chosen), deleted(&list, &KeptScans::deleteWanted);
  const QList<QToolButton*> cards = list.findChildren<QToolButton*>();
  ASSERT_EQ(cards.size(), 2);
  QTest::mouseClick(cards[0], Qt::LeftButton);
  ASSERT_EQ(chosen.count(), 1);
  EXPECT_EQ(chosen[0][0].toString(), QStringLiteral("/a"));
  cards[1]->setFocus();
  QTest::keyClick(cards[1], Qt::Key_Delete);
  ASSERT_EQ(deleted.count(), 1);
  EXPECT_EQ(deleted[0][0].toString(), QStringLiteral("/b"));
}

TEST(DeleteScan, GoesToTheTrashAndComesBack) {
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
}

TEST(DeleteScan, WhatCannotBeDeletedIsSaidAndNoStep) {
  QString failure;
  QUndoStack undo;
  undo.push(new DeleteScan(
      QStringLiteral("/nowhere/at all"), [] {}, [&](const QString& message) { failure = message; }));
  EXPECT_TRUE(failure.contains(QStringLiteral("/nowhere/at all")));
  EXPECT_FALSE(undo.canUndo());
}

}  // namespace
}  // namespace scantrove
