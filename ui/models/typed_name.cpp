#include "ui/models/typed_name.h"

#include <QCoreApplication>

namespace scantrove {

QString TypedName::classInWords() const {
  return (is_new_class ? QCoreApplication::translate("TypedName", "New class: %1")
                       : QCoreApplication::translate("TypedName", "Class: %1"))
      .arg(class_name);
}

QString anotherInWords(const QString& class_name, const QString& free_name) {
  return QCoreApplication::translate("TypedName", "Another %1: “%2”").arg(class_name, free_name);
}

QString sameInWords(const QString& class_name, const QString& name) {
  return QCoreApplication::translate("TypedName", "The same %1: “%2”").arg(class_name, name);
}

}  // namespace scantrove
