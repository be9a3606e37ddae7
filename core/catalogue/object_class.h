#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ids.h"
#include "core/base/result.h"

namespace scantrove {

inline constexpr std::uint32_t kLargestClassId = 2'147'483'647;  ///< as in COCO files
inline constexpr std::size_t kMostAttributes = 64;               ///< of one class
inline constexpr std::size_t kMostChoices = 256;                 ///< of one attribute

/// sRGB: red, green, blue.
using ClassColor = std::array<std::uint8_t, 3>;

enum class AttributeKind : std::uint8_t { text, choice, yes_no };

/// A question that a class asks about each of its objects.
struct ClassAttribute {
  std::string name;  ///< unique in its class
  AttributeKind kind = AttributeKind::text;
  std::vector<std::string> choices = {};  ///< of a choice

  bool operator==(const ClassAttribute&) const = default;
};

/// A class of objects, such as "chair". Nothing is ever deleted: an unused class can be hidden.
struct ObjectClass {
  ClassId id;        ///< never changes and is never given to another class: the category id of COCO files
  std::string name;  ///< unique among visible classes
  ClassColor color{};
  std::string supercategory = {};  ///< such as "furniture"; empty: none
  std::vector<ClassAttribute> attributes = {};
  bool hidden = false;       ///< unused and not offered, or merged into another one
  ClassId merged_into = {};  ///< none: not merged

  bool operator==(const ObjectClass&) const = default;
};

/// A class to add, or changes of one. What is not given keeps its value, or gets a default.
struct ClassDraft {
  ClassId id = {};        ///< none: the next free one
  std::string name = {};  ///< empty: as it is
  std::optional<ClassColor> color = {};
  std::optional<std::string> supercategory = {};
  std::optional<std::vector<ClassAttribute>> attributes = {};

  bool operator==(const ClassDraft&) const = default;
};

/// All that a class has, as a draft.
[[nodiscard]] ClassDraft draftOf(const ObjectClass& object_class);

/// Answers of an object, by the name of the attribute; a yes/no is "yes" or "no".
using AttributeValues = std::map<std::string, std::string>;

/// The class of an object and its answers. Answers to what the class does not ask are kept, and not shown.
struct Classification {
  ClassId class_id = {};  ///< perhaps merged into another one by now; none: not classified
  AttributeValues attributes = {};

  bool operator==(const Classification&) const = default;
};

/// The effect of classifying an object, to undo it.
struct Reclassified {
  ObjectId object;
  Classification before, after;

  bool operator==(const Reclassified&) const = default;
};

/// The effect of merging classes, to undo it.
struct ClassMerge {
  ClassId into;
  std::vector<ClassId> from;
};

/// The color of a class that nobody gave one: distant hues for neighboring ids.
[[nodiscard]] ClassColor defaultClassColor(ClassId id);
/// "#rrggbb".
[[nodiscard]] std::string hexOf(const ClassColor& color);
/// None: not "#rrggbb".
[[nodiscard]] std::optional<ClassColor> colorFromHex(std::string_view hex);

[[nodiscard]] std::string_view toString(AttributeKind kind);  ///< "text", "choice", "yes_no"
/// None if there is no such kind.
[[nodiscard]] std::optional<AttributeKind> attributeKindOf(std::string_view text);

/// Names without surrounding blanks. Error: a name is not valid (checkedLabelName; a supercategory may be
/// empty), two attributes or two choices are equal, a choice has none, or there are too many.
[[nodiscard]] Result<ClassDraft> checkedDraft(ClassDraft draft);
/// An answer without surrounding blanks; empty takes it back. Error: not one of the choices, or not one line
/// of text.
[[nodiscard]] Result<std::string> checkedAnswer(const ClassAttribute& attribute, std::string_view answer);

}  // namespace scantrove
