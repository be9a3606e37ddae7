// Messages and suggestions lie over the view: what is under the pointer stays there.
#include "ui/panels/floating_bars.h"

#include <QLabel>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/region_operations.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/next_step_strip.h"
#include "ui/panels/proposal_bar.h"
#include "ui/panels/time_line.h"

namespace scantrove::test {
namespace {

class FloatingBarsTest : public PointingTest {
 protected:
  static void settle() {
    QCoreApplication::sendPostedEvents();
    QTest::qWait(100);
  }
  QRect inWindow(const QWidget& widget) { return {widget.mapTo(window_.get(), QPoint(0, 0)), widget.size()}; }
  QRect scene() { return inWindow(*view()); }
  void suggest() {
    RegionAppearance style;
    style.size_m = {0.4F, 0.4F, 0.8F};
    proposals().propose(RegionId{5}, QStringLiteral("chair"), {},
                        {{RegionId{5}, style}, {RegionId{7}, style}});
    ASSERT_NE(proposals().first(), nullptr);
    settle();
  }
  void tell(const QString& text) {
    messages().show(MessageBar::Kind::warning, text);
    settle();
  }
  RegionProposals& proposals() { return window_->regions().operations().proposals(); }
  MessageBar& messages() { return *window_->parts().messages; }
  ProposalBar& suggestion() { return *window_->findChild<ProposalBar*>(); }
  /// Whether nothing covers the middle of the bar.
  bool isOnTop(const QWidget& bar) {
    const QWidget* const top = window_->childAt(inWindow(bar).center());
    return top == &bar || bar.isAncestorOf(top);
  }
};

TEST_F(FloatingBarsTest, AMessageLeavesTheViewWhereItIs) {
  const QRect before = scene();
  tell(QStringLiteral("Frame 3 cannot be read."));
  ASSERT_TRUE(messages().isVisible());
  EXPECT_EQ(scene(), before);
  EXPECT_TRUE(isOnTop(messages()));
  EXPECT_TRUE(before.intersects(inWindow(messages())));
  messages().dismiss();
  settle();
  EXPECT_EQ(scene(), before);
}

TEST_F(FloatingBarsTest, ASuggestionLeavesTheViewWhereItIs) {
  const QRect before = scene();
  suggest();
  ASSERT_TRUE(suggestion().isVisible());
  EXPECT_EQ(scene(), before);
  EXPECT_TRUE(isOnTop(suggestion()));
  proposals().withdraw();
  settle();
  EXPECT_FALSE(suggestion().isVisible());
  EXPECT_EQ(scene(), before);
}

TEST_F(FloatingBarsTest, AMessageLiesAboveASuggestion) {
  suggest();
  tell(QStringLiteral("Frame 3 cannot be read."));
  EXPECT_FALSE(inWindow(messages()).intersects(inWindow(suggestion())));
  EXPECT_LT(inWindow(messages()).bottom(), inWindow(suggestion()).top());
  EXPECT_TRUE(isOnTop(messages()) && isOnTop(suggestion()));
  const int with_suggestion = inWindow(messages()).bottom();
  proposals().withdraw();
  settle();
  EXPECT_GT(inWindow(messages()).bottom(), with_suggestion) << "a hidden bar leaves no gap";
}

TEST_F(FloatingBarsTest, ALongMessageIsShownWhole_AtEachWidthOfTheWindow) {
  tell(QStringLiteral("The depth of the recording does not fit its camera. ").repeated(8));
  const auto* const label = messages().findChild<QLabel*>(QStringLiteral("messageText"));
  for (const QSize& size : {QSize(1500, 800), QSize(1000, 700), QSize(1280, 800)}) {
    window_->resize(size);
    settle();
    EXPECT_GE(label->height(), label->heightForWidth(label->width()));
    EXPECT_EQ(messages().width(), messages().parentWidget()->width());
    EXPECT_LE(scene().bottom(), inWindow(messages()).bottom());
  }
}

TEST_F(FloatingBarsTest, ASuggestionCoversNeitherNextStepsNorTheTimeLine) {
  worker_->finish();
  ScanSnapshot snapshot = twoRegions(90);
  snapshot.state = ScanState::finished;
  snapshot.key_frames = std::make_shared<const std::vector<int>>(std::vector{0, 30});
  snapshot.shown_key_frame = 0;
  worker_->report(std::move(snapshot));
  worker_->report(ReviewOpened{});
  TimeLine& time_line = *window_->parts().time_line;
  NextStepStrip& steps = *window_->parts().next_steps;
  ASSERT_TRUE(QTest::qWaitFor([&] { return time_line.isVisible() && steps.isVisible(); }, kPatience_ms));
  settle();
  const QRect before = scene();
  suggest();
  EXPECT_EQ(scene(), before);
  EXPECT_TRUE(steps.isVisible());
  EXPECT_TRUE(isOnTop(time_line));
  EXPECT_TRUE(isOnTop(steps));
}

}  // namespace
}  // namespace scantrove::test
