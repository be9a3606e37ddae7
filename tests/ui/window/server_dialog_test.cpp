#include "ui/panels/server_dialog.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTest>

namespace scantrove {
namespace {

constexpr int kAnswerWait_ms = 20000;

TEST(ServerDialog, AnswerThatIsLongerThanTheHintHasRoom) {
  // Nobody listens on port 1, and the long name makes more lines of the answer.
  ServerDialog dialog({QStringLiteral("postgresql://someone@127.0.0.1:1/a_name_that_%1")
                           .arg(QString(200, QLatin1Char('x')))});
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  const auto* answer = dialog.findChild<QLabel*>(QStringLiteral("serverAnswer"));
  auto* test = dialog.findChild<QPushButton*>(QStringLiteral("serverTest"));
  const auto* address = dialog.findChild<QComboBox*>(QStringLiteral("serverAddress"));
  ASSERT_TRUE(answer != nullptr && test != nullptr && address != nullptr);
  QTest::mouseClick(test, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([test] { return test->isEnabled(); }, kAnswerWait_ms));
  QTest::qWait(50);
  EXPECT_GE(answer->height(), answer->heightForWidth(answer->width())) << answer->text().toStdString();
  EXPECT_EQ(dialog.focusWidget(), address) << "the address is what has to be mended";
}

}  // namespace
}  // namespace scantrove
