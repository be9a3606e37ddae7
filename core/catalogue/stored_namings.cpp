#include "core/catalogue/stored_namings.h"

#include <nlohmann/json.hpp>

#include "core/catalogue/class_json.h"

namespace scantrove {
namespace {

using NamingJson = nlohmann::ordered_json;

NamingJson namingToJson(const StoredNaming& kept) {
  const ObjectNaming& naming = kept.naming;
  NamingJson json{{"object", naming.object.value},
                  {"name", naming.name},
                  {"earlier_name", naming.earlier_name},
                  {"earlier_by_person", naming.earlier_named_by == NamedBy::user},
                  {"earlier_confirmed", naming.earlier_confirmed},
                  {"earlier_object", kept.earlier.value},
                  {"made_object", kept.made.value}};
  if (kept.is_overruled) json["overruled"] = true;
  if (naming.reclassified) json["class"] = reclassifiedToJson(*naming.reclassified);
  if (naming.made_class) json["made_class"] = naming.made_class.value;
  if (!naming.merge) return json;
  json["merged"] = NamingJson::array();
  for (const ObjectId from : naming.merge->from) json["merged"].push_back(from.value);
  json["merge_confirmed"] = naming.merge->has_confirmed;
  if (naming.merge->reclassified) json["merge_class"] = reclassifiedToJson(*naming.merge->reclassified);
  return json;
}

StoredNaming namingFromJson(const NamingJson& json) {
  const auto idAt = [&](const char* name) { return ObjectId{json.at(name).get<std::uint32_t>()}; };
  StoredNaming kept;
  kept.naming.object = idAt("object");
  kept.naming.name = json.at("name").get<std::string>();
  kept.naming.earlier_name = json.at("earlier_name").get<std::string>();
  kept.naming.earlier_named_by = json.at("earlier_by_person").get<bool>() ? NamedBy::user : NamedBy::program;
  kept.naming.earlier_confirmed = json.at("earlier_confirmed").get<bool>();
  kept.earlier = idAt("earlier_object");
  kept.made = idAt("made_object");
  kept.is_overruled = json.value("overruled", false);
  if (json.contains("class")) kept.naming.reclassified = reclassifiedFromJson(json.at("class"));
  kept.naming.made_class = ClassId{json.value("made_class", std::uint32_t{0})};
  if (!json.contains("merged")) return kept;
  ObjectMerge merge{kept.naming.object, {}, json.at("merge_confirmed").get<bool>()};
  if (json.contains("merge_class")) merge.reclassified = reclassifiedFromJson(json.at("merge_class"));
  for (const NamingJson& from : json.at("merged")) merge.from.push_back(ObjectId{from.get<std::uint32_t>()});
  if (!merge.from.empty()) kept.naming.merge = merge;
  return kept;
}

}  // namespace

std::string namingsKeyOf(RegionId region) { return "namings " + std::to_string(region.value); }

std::string undoneNamingsKeyOf(RegionId region) { return "undone namings " + std::to_string(region.value); }

std::string removedObjectKeyOf(RegionId region) { return "gone object " + std::to_string(region.value); }

std::string namingsToJson(const std::vector<StoredNaming>& namings) {
  if (namings.empty()) return {};
  NamingJson json = NamingJson::array();
  for (const StoredNaming& kept : namings) json.push_back(namingToJson(kept));
  return json.dump(-1, ' ', false, NamingJson::error_handler_t::replace);
}

std::vector<StoredNaming> namingsFromJson(const std::string& text) {
  std::vector<StoredNaming> namings;
  try {
    if (text.empty()) return namings;
    for (const NamingJson& one : NamingJson::parse(text)) namings.push_back(namingFromJson(one));
  } catch (const NamingJson::exception&) {
    namings.clear();
  }
  return namings;
}

}  // namespace scantrove
