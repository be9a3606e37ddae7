#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalogue/object_class.h"

namespace scantrove {

/// The classes of a catalogue, with hidden and merged ones. It answers questions; CatalogueModel decides
/// changes.
class ClassTable {
 public:
  /// Adds a class, or replaces its state.
  void put(ObjectClass object_class);
  [[nodiscard]] const std::map<ClassId, ObjectClass>& all() const { return classes_; }
  /// Visible classes, by id.
  [[nodiscard]] std::vector<ObjectClass> visible() const;
  /// Null: no such class.
  [[nodiscard]] const ObjectClass* find(ClassId id) const;
  /// The visible class of that name, or null.
  [[nodiscard]] const ObjectClass* named(std::string_view name) const;
  /// The oldest hidden class of that name that is not merged, or null.
  [[nodiscard]] const ObjectClass* hiddenNamed(std::string_view name) const;
  /// The class that `id` is merged into, even if that is hidden; itself: it is not merged. Null: no such
  /// class. Where merges in a damaged file are circular or dangling, the last one reached.
  [[nodiscard]] const ObjectClass* rootOf(ClassId id) const;
  /// All classes with that root.
  [[nodiscard]] std::vector<ClassId> familyOf(ClassId root) const;
  /// The attributes of a root and of the classes merged into it; of equal names the root's, then the
  /// older class's.
  [[nodiscard]] std::vector<ClassAttribute> attributesOf(ClassId root) const;
  /// The id after the largest one, or else the smallest that no class ever had.
  [[nodiscard]] ClassId nextId() const;
  /// The visible class that a name of an object suggests: "chair", "chair 2" and "red chair" suggest
  /// "chair", the longest class name at the end wins. Null: none.
  [[nodiscard]] const ObjectClass* suggestedBy(std::string_view name) const;

 private:
  std::map<ClassId, ObjectClass> classes_;
  std::map<std::string, ClassId, std::less<>> ids_;  // of visible classes, by name
};

/// A name without the number of "chair 2"; itself: it has none.
[[nodiscard]] std::string_view withoutNumber(std::string_view name);

}  // namespace scantrove
