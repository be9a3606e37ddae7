#pragma once
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/catalogue/catalogue_model.h"

namespace scantrove {

/// What a text that a user typed says about an object.
struct NameCompletion {
  std::string name;        ///< no other visible object has it
  std::string class_name;  ///< of the class to use, or to make
  ClassId class_id = {};   ///< none: it is to be made
  /// The other visible object that is called exactly as typed. Ask the user: the same object (name it
  /// `typed`), or another one (name it `name`). None: nothing to ask.
  ObjectId same = {};
  std::string typed;  ///< the name as typed, without a class in front

  [[nodiscard]] GivenName given() const { return {name, class_name}; }
};

/// Completes "chair", "chair 2", "red chair" or "chair/red one" to a name and a class:
/// - A class in front of a slash is the class.
/// - Else the class of that name; else that of the object of that name; else the class that the name suggests
///   (ClassTable::suggestedBy); else a new class called like the text, without its number.
/// - A name that another object than `own` has already becomes the next free "name 2", "name 3", ...
/// `own`: the object that gets the name; none: a new one. Error: not valid as a name or a class
/// (checkedLabelName).
[[nodiscard]] Result<NameCompletion> completeName(const CatalogueModel& catalogue, std::string_view text,
                                                  ObjectId own = {});

}  // namespace scantrove
