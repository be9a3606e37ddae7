#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>

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

TEST(MessageBar, KeepsPercentSignsOfARepeatedText) {
  QWidget parent;
  MessageBar bar(&parent);
  const QString text = QStringLiteral("The server db.example/my%2Fobjects does not answer.");
  bar.show(MessageBar::Kind::warning, text);
  bar.show(MessageBar::Kind::warning, text);
  EXPECT_TRUE(bar.findChild<QLabel*>(QStringLiteral("messageText"))->text().startsWith(text));
}

TEST(MessageBar, OffersAnAction_UntilTheNextMessage) {
  QWidget parent;
  MessageBar bar(&parent);
  auto* const button = bar.findChild<QPushButton*>(QStringLiteral("messageButton"));
  ASSERT_NE(button, nullptr);
  int calls = 0;
  bar.show(MessageBar::Kind::warning, QStringLiteral("The depth scale seems wrong."),
           QStringLiteral("Use 10000 units per metre"), [&calls] { ++calls; });
  EXPECT_FALSE(button->isHidden());
  EXPECT_EQ(button->text(), QStringLiteral("Use 10000 units per metre"));
  button->click();
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(bar.isHidden());
  bar.show(MessageBar::Kind::warning, QStringLiteral("Frame 3 cannot be read."));
  EXPECT_TRUE(button->isHidden());
  button->click();
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace scantrove
