#include "core/catalog/object_name.h"

#include <QList>
#include <algorithm>

namespace scantrove {
namespace {

bool isControl(QChar c) {
  return c.category() == QChar::Other_Control || c.category() == QChar::Separator_Line ||
         c.category() == QChar::Separator_Paragraph;
}

}  // namespace

Result<QString> checkedObjectName(const std::string& name) {
  const QString text = QString::fromStdString(name);
  if (text.toStdString() != name) return fail("The name is not UTF-8 text.", "Type it again.");
  const QString trimmed = text.trimmed();
  if (trimmed.isEmpty()) return fail("An object needs a name.", "Type one.");
  if (std::ranges::any_of(trimmed, isControl)) {
    return fail("A name cannot have line breaks, tabs or other control characters in it.",
                "Type it in one line.");
  }
  if (const qsizetype length = trimmed.toUcs4().size(); length > kLongestObjectName) {
    return fail("The name is " + std::to_string(length) + " characters long.",
                "Use at most " + std::to_string(kLongestObjectName) + ".");
  }
  if (std::ranges::all_of(trimmed, [](QChar c) { return c.isDigit(); })) {
    return fail("'" + trimmed.toStdString() + "' cannot be a name: a number alone stands for an object's id.",
                "Add a letter, as in 'mug " + trimmed.toStdString() + "'.");
  }
  return trimmed;
}

}  // namespace scantrove
