#include <gtest/gtest.h>

#include <QTest>

#include "ui/panels/elided_label.h"

namespace scantrove {
namespace {

TEST(ElidedLabel, ShortensTheText_AndShowsAllInTheTooltip) {
  ElidedLabel label;
  const QString text = QStringLiteral("a name that is a good deal longer than there is room");
  label.setFullText(text);
  label.resize(label.sizeHint());
  label.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&label));
  EXPECT_EQ(label.text(), text);
  EXPECT_TRUE(label.toolTip().isEmpty());
  label.resize(90, 20);
  EXPECT_TRUE(label.text().endsWith(QStringLiteral("…")));
  EXPECT_EQ(label.toolTip(), text);
  EXPECT_LT(label.minimumSizeHint().width(), 90);
}

}  // namespace
}  // namespace scantrove
