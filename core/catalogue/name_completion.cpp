#include "core/catalogue/name_completion.h"

#include <set>

#include "core/base/label_name.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

/// The first free of "name 2", "name 3", ... without the number of `name`.
std::string freeName(const CatalogueModel& catalogue, const std::string& name) {
  const std::string start = std::string(withoutNumber(name)) + ' ';
  std::set<std::string> taken;
  for (const auto& [id, object] : catalogue.objects()) {
    if (!object.hidden && object.name.starts_with(start)) taken.insert(object.name);
  }
  int number = 2;
  while (taken.contains(start + std::to_string(number))) ++number;
  return start + std::to_string(number);
}

/// The class of a name without a class in front; null: a new one.
const ObjectClass* classFor(const CatalogueModel& catalogue, const std::string& name) {
  const ClassTable& classes = catalogue.classes();
  if (const ObjectClass* known = classes.named(name)) return known;
  const ObjectState* object = catalogue.named(name);
  const ObjectClass* own = object != nullptr ? catalogue.classOf(object->classification) : nullptr;
  return own != nullptr ? own : classes.suggestedBy(name);
}

}  // namespace

Result<NameCompletion> completeName(const CatalogueModel& catalogue, std::string_view text, ObjectId own) {
  NameCompletion completion;
  const std::size_t slash = text.find('/');
  const bool has_class = slash != std::string_view::npos && !trimmed(text.substr(0, slash)).empty() &&
                         !trimmed(text.substr(slash + 1)).empty();
  SCANTROVE_TRY(moveInto(completion.typed, checkedLabelName(has_class ? text.substr(slash + 1) : text)));
  completion.name = completion.typed;
  const ObjectState* same = catalogue.named(completion.typed);
  if (same != nullptr && same->id != own) {
    completion.same = same->id;
    SCANTROVE_TRY(moveInto(completion.name, checkedLabelName(freeName(catalogue, completion.typed))));
  }
  const ObjectClass* known = nullptr;
  if (has_class) {
    SCANTROVE_TRY(moveInto(completion.class_name, checkedLabelName(text.substr(0, slash))));
    known = catalogue.classes().named(completion.class_name);
  } else {
    known = classFor(catalogue, completion.typed);
    const Result<std::string> base = checkedLabelName(withoutNumber(completion.typed));
    completion.class_name = base ? *base : completion.typed;
  }
  if (known == nullptr) return completion;
  completion.class_id = known->id;
  completion.class_name = known->name;
  return completion;
}

}  // namespace scantrove
