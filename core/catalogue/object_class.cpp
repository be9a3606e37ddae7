#include "core/catalogue/object_class.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "core/base/label_name.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

constexpr std::array<std::pair<AttributeKind, std::string_view>, 3> kAttributeKinds{
    {{AttributeKind::text, "text"}, {AttributeKind::choice, "choice"}, {AttributeKind::yes_no, "yes_no"}}};

/// One part of the HSV to RGB conversion; `hue` in sixths of a turn.
std::uint8_t channelOf(double hue, double shift) {
  constexpr double kSaturation = 0.65, kValue = 0.95;
  const double k = std::fmod(shift + hue, 6.0);
  const double share = std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(255 * kValue * (1 - kSaturation * share)));
}

Result<ClassAttribute> checkedAttribute(ClassAttribute attribute) {
  SCANTROVE_TRY(moveInto(attribute.name, checkedLabelName(attribute.name)));
  const std::string called = "The attribute '" + attribute.name + "'";
  if (attribute.kind != AttributeKind::choice) {
    if (attribute.choices.empty()) return attribute;
    return fail(called + " has choices, but is no choice.", "Make it a choice, or leave them out.");
  }
  if (attribute.choices.empty() || attribute.choices.size() > kMostChoices) {
    return fail(called + " has " + std::to_string(attribute.choices.size()) + " choices.",
                "Give 1 to " + std::to_string(kMostChoices) + ".");
  }
  std::set<std::string> choices;
  for (std::string& choice : attribute.choices) {
    SCANTROVE_TRY(moveInto(choice, checkedCategoryName(choice)));
    if (choice.empty()) return fail(called + " has an empty choice.", "Leave it out.");
    if (!choices.insert(choice).second)
      return fail(called + " has the choice '" + choice + "' twice.", "Leave one out.");
  }
  return attribute;
}

}  // namespace

ClassDraft draftOf(const ObjectClass& object_class) {
  return {object_class.id, object_class.name, object_class.color, object_class.supercategory,
          object_class.attributes};
}

ClassColor defaultClassColor(ClassId id) {
  constexpr double kGoldenAngle = 137.507764;  // degrees
  const double hue = std::fmod(id.value * kGoldenAngle, 360.0) / 60;
  return {channelOf(hue, 5), channelOf(hue, 3), channelOf(hue, 1)};
}

std::string hexOf(const ClassColor& color) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", unsigned{color[0]}, unsigned{color[1]},
                unsigned{color[2]});
  return text.data();
}

std::optional<ClassColor> colorFromHex(std::string_view hex) {
  if (hex.size() != 7 || hex.front() != '#') return std::nullopt;
  ClassColor color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    const char* begin = hex.data() + 1 + 2 * i;
    const auto [end, failure] = std::from_chars(begin, begin + 2, color[i], 16);
    if (failure != std::errc{} || end != begin + 2) return std::nullopt;
  }
  return color;
}

std::string_view toString(AttributeKind kind) {
  return std::ranges::find(kAttributeKinds, kind, &std::pair<AttributeKind, std::string_view>::first)->second;
}

std::optional<AttributeKind> attributeKindOf(std::string_view text) {
  const auto found =
      std::ranges::find(kAttributeKinds, text, &std::pair<AttributeKind, std::string_view>::second);
  return found == kAttributeKinds.end() ? std::nullopt : std::optional(found->first);
}

Result<ClassDraft> checkedDraft(ClassDraft draft) {
  if (draft.id.value > kLargestClassId) {
    return fail("A class cannot have the id " + std::to_string(draft.id.value) + ".",
                "Use 1 to " + std::to_string(kLargestClassId) + ".");
  }
  if (!trimmed(draft.name).empty()) {
    SCANTROVE_TRY(moveInto(draft.name, checkedLabelName(draft.name)));
  } else {
    draft.name.clear();
  }
  if (draft.supercategory)
    SCANTROVE_TRY(moveInto(*draft.supercategory, checkedCategoryName(*draft.supercategory)));
  if (!draft.attributes) return draft;
  if (draft.attributes->size() > kMostAttributes) {
    return fail("A class cannot have " + std::to_string(draft.attributes->size()) + " attributes.",
                "Use at most " + std::to_string(kMostAttributes) + ".");
  }
  std::set<std::string> names;
  for (ClassAttribute& attribute : *draft.attributes) {
    SCANTROVE_TRY(moveInto(attribute, checkedAttribute(attribute)));
    if (!names.insert(attribute.name).second)
      return fail("A class has the attribute '" + attribute.name + "' twice.", "Leave one out.");
  }
  return draft;
}

Result<std::string> checkedAnswer(const ClassAttribute& attribute, std::string_view answer) {
  Result<std::string> text = checkedCategoryName(answer);
  if (!text || text->empty() || attribute.kind == AttributeKind::text) return text;
  static const std::vector<std::string> kYesOrNo{"yes", "no"};
  const std::vector<std::string>& known =
      attribute.kind == AttributeKind::yes_no ? kYesOrNo : attribute.choices;
  if (std::ranges::find(known, *text) != known.end()) return text;
  std::string choices;
  for (const std::string& choice : known) choices += (choices.empty() ? "" : ", ") + choice;
  return fail("'" + *text + "' is no answer to '" + attribute.name + "'.", "Answer one of: " + choices + ".");
}

}  // namespace scantrove
