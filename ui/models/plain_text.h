#pragma once
#include <QString>
#include <QTextDocument>

namespace scantrove {

/// A tooltip that shows `text` as it is: Qt reads a tooltip as HTML if a name in it looks like a tag.
[[nodiscard]] inline QString plainTip(const QString& text) {
  return Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text) : text;
}

}  // namespace scantrove
