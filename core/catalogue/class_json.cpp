#include "core/catalogue/class_json.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace scantrove {
namespace {

using ClassJson = nlohmann::ordered_json;

std::string textOf(const ClassJson& json) {
  return json.dump(-1, ' ', false, ClassJson::error_handler_t::replace);
}

AttributeValues answersFromJson(const ClassJson& json) {
  AttributeValues answers;
  for (const auto& [name, value] : json.get_ref<const ClassJson::object_t&>())
    answers[name] = value.get<std::string>();
  return answers;
}

ClassJson classificationToJson(const Classification& classification) {
  return {{"class", classification.class_id.value}, {"attributes", answersToJson(classification.attributes)}};
}

Classification classificationFromJson(const ClassJson& json) {
  return {ClassId{json.at("class").get<std::uint32_t>()}, answersFromJson(json.at("attributes"))};
}

/// `read` of the parsed text; empty for text of another form.
template <class Read>
auto readText(const std::string& text, Read&& read) -> decltype(read(ClassJson())) {
  try {
    if (!text.empty()) return read(ClassJson::parse(text));
  } catch (const ClassJson::exception&) {
    return {};
  }
  return {};
}

}  // namespace

ClassJson attributesToJson(const std::vector<ClassAttribute>& attributes) {
  ClassJson json = ClassJson::array();
  for (const ClassAttribute& attribute : attributes) {
    ClassJson one{{"name", attribute.name}, {"kind", toString(attribute.kind)}};
    if (attribute.kind == AttributeKind::choice) one["choices"] = attribute.choices;
    json.push_back(std::move(one));
  }
  return json;
}

std::vector<ClassAttribute> attributesFromJson(const ClassJson& json) {
  std::vector<ClassAttribute> attributes;
  for (const ClassJson& one : json.get_ref<const ClassJson::array_t&>()) {
    ClassAttribute attribute;
    attribute.name = one.at("name").get<std::string>();
    const std::optional<AttributeKind> kind = attributeKindOf(one.at("kind").get<std::string>());
    if (!kind) throw ClassJson::other_error::create(501, "no such kind of attribute", nullptr);
    attribute.kind = *kind;
    if (one.contains("choices")) attribute.choices = one.at("choices").get<std::vector<std::string>>();
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

std::string attributesToText(const std::vector<ClassAttribute>& attributes) {
  return textOf(attributesToJson(attributes));
}

std::vector<ClassAttribute> attributesFromText(const std::string& text) {
  return readText(text, [](const ClassJson& json) { return attributesFromJson(json); });
}

ClassJson answersToJson(const AttributeValues& answers) {
  ClassJson json = ClassJson::object();
  for (const auto& [name, value] : answers) json[name] = value;
  return json;
}

std::string answersToText(const AttributeValues& answers) {
  return answers.empty() ? std::string() : textOf(answersToJson(answers));
}

AttributeValues answersFromText(const std::string& text) {
  return readText(text, [](const ClassJson& json) { return answersFromJson(json); });
}

ClassJson reclassifiedToJson(const Reclassified& change) {
  return {{"object", change.object.value},
          {"before", classificationToJson(change.before)},
          {"after", classificationToJson(change.after)}};
}

Reclassified reclassifiedFromJson(const ClassJson& json) {
  return {ObjectId{json.at("object").get<std::uint32_t>()}, classificationFromJson(json.at("before")),
          classificationFromJson(json.at("after"))};
}

}  // namespace scantrove
