#include "ui/models/attribute_text.h"

#include <QStringList>
#include <utility>

namespace scantrove {
namespace {

const QString kYesNo = QStringLiteral("yes/no");

}  // namespace

QString attributesToText(const std::vector<ClassAttribute>& attributes) {
  QStringList parts;
  for (const ClassAttribute& attribute : attributes) {
    QString part = QString::fromStdString(attribute.name);
    if (attribute.kind == AttributeKind::yes_no) part += QStringLiteral(": ") + kYesNo;
    if (attribute.kind == AttributeKind::choice) {
      QStringList choices;
      for (const std::string& choice : attribute.choices) choices << QString::fromStdString(choice);
      part += QStringLiteral(": ") + choices.join(QStringLiteral(", "));
    }
    parts << part;
  }
  return parts.join(QStringLiteral("; "));
}

Result<std::vector<ClassAttribute>> attributesFromText(const QString& text) {
  std::vector<ClassAttribute> attributes;
  for (const QString& part : text.split(QLatin1Char(';'), Qt::SkipEmptyParts)) {
    if (part.trimmed().isEmpty()) continue;
    const auto colon = part.indexOf(QLatin1Char(':'));
    const QString name = part.left(colon).trimmed();
    if (name.isEmpty()) {
      return fail("The attribute '" + part.trimmed().toStdString() + "' has no name.",
                  "Type attributes like: material: wood, steel; broken: yes/no; remark");
    }
    ClassAttribute attribute{name.toStdString()};
    const QString kind = colon < 0 ? QString() : part.mid(colon + 1).trimmed();
    if (kind == kYesNo) {
      attribute.kind = AttributeKind::yes_no;
    } else if (!kind.isEmpty()) {
      attribute.kind = AttributeKind::choice;
      for (const QString& choice : kind.split(QLatin1Char(',')))
        attribute.choices.push_back(choice.trimmed().toStdString());
    }
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

}  // namespace scantrove
