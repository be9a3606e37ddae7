#include <QAction>
#include <QLabel>
#include <QRegularExpression>
#include <QScreen>
#include <QScrollArea>
#include <set>

#include "tests/ui/window/window_fixture.h"
#include "ui/panels/help_dialog.h"

namespace scantrove {
namespace {

using test::WindowTest;

/// The keys listed in the dialog; "Alt+1 … Alt+3" gives three.
std::set<QString> keysIn(const HelpDialog& help) {
  static const QRegularExpression between(QStringLiteral(", (?:then )?| and "));
  static const QRegularExpression range(QStringLiteral("^(.*)(\\d) … \\1(\\d)$"));
  std::set<QString> keys;
  for (const QLabel* label : help.findChildren<QLabel*>()) {
    if (!label->property("keys").toBool()) continue;
    for (const QString& key : label->text().split(between)) {
      const QRegularExpressionMatch found = range.match(key);
      if (!found.hasMatch()) keys.insert(key);
      for (int i = found.captured(2).toInt(); found.hasMatch() && i <= found.captured(3).toInt(); ++i)
        keys.insert(found.captured(1) + QString::number(i));
    }
  }
  return keys;
}

/// The label on a key; Qt's names differ.
QString nameOf(const QKeySequence& sequence) {
  QString name = sequence.toString(QKeySequence::PortableText);
  name.replace(QStringLiteral("PgUp"), QStringLiteral("Page up"));
  name.replace(QStringLiteral("PgDown"), QStringLiteral("Page down"));
  if (name == QStringLiteral("Esc")) return QStringLiteral("Escape");
  return name == QStringLiteral("-") ? QStringLiteral("−") : name;
}

TEST_F(WindowTest, HelpListsTheKeysOfAllActions) {
  const HelpDialog help;
  const std::set<QString> named = keysIn(help);
  int actions = 0;
  for (const QAction* action : window_->findChildren<QAction*>()) {
    if (action->shortcuts().isEmpty()) continue;
    ++actions;
    bool any = false;
    QString all;
    for (const QKeySequence& key : action->shortcuts()) {
      any = any || named.contains(nameOf(key));
      all += nameOf(key) + QLatin1Char(' ');
    }
    EXPECT_TRUE(any) << all.toStdString() << action->text().toStdString();
  }
  EXPECT_GT(actions, 40);
}

TEST_F(WindowTest, HelpFitsTheScreen_AndScrolls) {
  HelpDialog help(window_.get());
  help.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&help));
  EXPECT_LE(help.height(), help.screen()->availableSize().height());
  const auto* scroll = help.findChild<QScrollArea*>();
  EXPECT_GE(scroll->viewport()->width(), scroll->widget()->minimumSizeHint().width()) << "nothing is cut off";
  help.resize(help.width(), 300);
  EXPECT_EQ(help.height(), 300);
}

}  // namespace
}  // namespace scantrove
