#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/catalogue/object_class.h"

namespace scantrove {

// Classes as JSON. The ...FromJson functions throw nlohmann's exceptions for another form; names are not
// checked (checkedDraft).

/// `[{"name": ..., "kind": "text", "choice" or "yes_no", "choices": [...]}]`; "choices" only of a choice.
[[nodiscard]] nlohmann::ordered_json attributesToJson(const std::vector<ClassAttribute>& attributes);
[[nodiscard]] std::vector<ClassAttribute> attributesFromJson(const nlohmann::ordered_json& json);
/// The same as text, as the catalogue stores it. Empty for text of another form.
[[nodiscard]] std::string attributesToText(const std::vector<ClassAttribute>& attributes);
[[nodiscard]] std::vector<ClassAttribute> attributesFromText(const std::string& text);

/// `{"<attribute>": "<answer>"}`, likewise; empty text for none.
[[nodiscard]] nlohmann::ordered_json answersToJson(const AttributeValues& answers);
[[nodiscard]] std::string answersToText(const AttributeValues& answers);
[[nodiscard]] AttributeValues answersFromText(const std::string& text);

/// `{"object", "before": {"class", "attributes"}, "after": {...}}`.
[[nodiscard]] nlohmann::ordered_json reclassifiedToJson(const Reclassified& change);
[[nodiscard]] Reclassified reclassifiedFromJson(const nlohmann::ordered_json& json);

}  // namespace scantrove
