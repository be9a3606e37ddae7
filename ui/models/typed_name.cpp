#include "ui/models/typed_name.h"

#include <QCoreApplication>

namespace scantrove {
namespace {

QString trName(const char* text) { return QCoreApplication::translate("TypedName", text); }

}  // namespace

QString TypedName::classInWords() const {
  return (is_new_class ? trName("New class: %1") : trName("Class: %1")).arg(class_name);
}

QString anotherInWords(const QString& class_name, const QString& free_name) {
  return trName("Another %1: “%2”").arg(class_name, free_name);
}

QString sameInWords(const QString& class_name, const QString& name) {
  return trName("The same %1: “%2”").arg(class_name, name);
}

}  // namespace scantrove
