#include "core/catalogue/object_name.h"

#include "core/base/label_name.h"

namespace scantrove {

Result<QString> checkedObjectName(const std::string& name) {
  return checkedLabelName(name).map([](const std::string& text) { return QString::fromStdString(text); });
}

}  // namespace scantrove
