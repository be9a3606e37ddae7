#include <gtest/gtest.h>

#include <QLabel>

#include "ui/panels/message_bar.h"

namespace scantrove {
namespace {

TEST(MessageBar, CountsRepetitionsAndKeepsErrors) {
  QWidget parent;
  MessageBar bar(&parent);
  EXPECT_TRUE(bar.isHidden());
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 3 cannot be read."));
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 3 cannot be read."));
  EXPECT_TRUE(
      bar.findChild<QLabel*>(QStringLiteral("messageText"))->text().contains(QStringLiteral("2 times")));
  bar.show(MessageBar::Kind::error, QStringLiteral("The disk is full."));
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 4 cannot be read."));
  EXPECT_EQ(bar.text(), QStringLiteral("The disk is full."));
  bar.dismiss();
  EXPECT_TRUE(bar.isHidden());
}

}  // namespace
}  // namespace scantrove
