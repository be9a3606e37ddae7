#include <gtest/gtest.h>

#include <QAction>
#include <QProgressBar>
#include <QTest>
#include <QToolButton>

#include "ui/panels/progress_strip.h"

namespace scantrove {
namespace {

/// Counts the paint events of a widget.
class PaintCounter : public QObject {
 public:
  explicit PaintCounter(QWidget* widget) { widget->installEventFilter(this); }
  int paints = 0;

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    paints += event->type() == QEvent::Paint ? 1 : 0;
    return false;
  }
};

// Drawing a window with a 3D view takes tens of milliseconds, so it is drawn once per snapshot, not per
// panel.
TEST(ProgressStrip, IsDrawnLater_NotOnEachSnapshot) {
  QAction skip;
  ProgressStrip strip(&skip);
  strip.resize(400, 40);
  strip.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&strip));
  ScanSnapshot snapshot;
  snapshot.frames_total = 100;
  snapshot.frames.read = 1;
  strip.showSnapshot(snapshot);
  auto* bar = strip.findChild<QProgressBar*>();
  ASSERT_NE(bar, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bar->isVisible(); }));
  QTest::qWait(50);
  PaintCounter counter(bar);
  snapshot.frames.read = 60;
  strip.showSnapshot(snapshot);
  EXPECT_EQ(counter.paints, 0);
  EXPECT_EQ(bar->value(), 60);
  EXPECT_TRUE(QTest::qWaitFor([&] { return counter.paints > 0; }));
}

TEST(ProgressStrip, ShowsTheProgressOfTheRefinement) {
  QAction skip;
  ProgressStrip strip(&skip);
  strip.begin(QStringLiteral("kitchen"));
  ScanSnapshot snapshot;
  snapshot.frames_total = 100;
  snapshot.frames.read = 100;
  strip.showSnapshot(snapshot);
  const auto* bar = strip.findChild<QProgressBar*>();
  const auto* button = strip.findChild<QToolButton*>(QStringLiteral("skipRefinement"));
  EXPECT_TRUE(button->isHidden());
  strip.showState(ScanState::refining);
  EXPECT_FALSE(button->isHidden());
  strip.showRefinement({0, 140, 40});
  EXPECT_EQ(bar->value(), 0);
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 1 of 40"));
  strip.showRefinement({70, 140, 40});
  EXPECT_EQ(bar->value() * 2, bar->maximum());
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 21 of 40"));
  strip.showSnapshot(snapshot);
  EXPECT_EQ(strip.text(), QStringLiteral("key frame 21 of 40"));
  strip.showState(ScanState::finishing);
  EXPECT_TRUE(button->isHidden());
}

}  // namespace
}  // namespace scantrove
