#pragma once
#include <QRegularExpression>
#include <QString>

namespace scantrove {

/// A message as the window shows it: parentheses with an option of the command line are left out. Messages of
/// core name options in parentheses only where the window has another way, such as "Use all frames
/// (--all-frames)."
[[nodiscard]] inline QString shownMessage(QString message) {
  static const QRegularExpression option(QStringLiteral(R"( \([^()]*--[a-z][^()]*\))"));
  return message.remove(option);
}

}  // namespace scantrove
