#pragma once
#include <QString>
#include <functional>
#include <optional>

namespace scantrove {

/// What a typed name of an object or region leads to, for the field where it is typed.
struct TypedName {
  /// The user's answer if another object has the name already.
  enum class Answer { another, same };

  QString class_name;         ///< the class that the object gets
  bool is_new_class = false;  ///< it is to be made
  bool is_taken = false;      ///< another object has the name: the user answers
  QString another, same;      ///< texts of the answers

  /// "Class: chair".
  [[nodiscard]] QString classInWords() const;
};

/// Completes a text while it is typed; none: it is not valid as a name, or it removes the name.
using NameCheck = std::function<std::optional<TypedName>(const QString&)>;

/// "Another chair: “chair 2”".
[[nodiscard]] QString anotherInWords(const QString& class_name, const QString& free_name);
/// "The same chair: “chair”".
[[nodiscard]] QString sameInWords(const QString& class_name, const QString& name);

}  // namespace scantrove
