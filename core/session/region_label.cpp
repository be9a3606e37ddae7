#include "core/session/region_label.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace scantrove {
namespace {

using LabelJson = nlohmann::ordered_json;
using State = RegionObject::State;

}  // namespace

RegionLabel labelOf(const RegionNote& note, const RegionObject& object, bool is_session_only) {
  RegionLabel label{note.name, note.category,   {},           !note.name.empty(), note.object,
                    false,     note.background, note.rejected};
  const bool is_of_catalogue = note.name.empty() || !is_session_only;
  if (object.state == State::deleted && is_of_catalogue) {
    label.name.clear();
    label.category.clear();
    label.is_object = label.is_named = false;
  } else if (object.state == State::known) {
    label.object = object.object;
    label.confirmed = object.confirmed;
    label.is_object = true;
    const bool is_user_name = object.named_by == NamedBy::user && is_of_catalogue;
    if ((is_user_name || note.name.empty()) && !object.name.empty()) {
      label.name = object.name;
      label.is_named = object.named_by == NamedBy::user;
    }
    if (object.class_id && (is_of_catalogue || note.category.empty())) {
      label.category = object.class_name;
      label.class_id = object.class_id;
    }
  }
  if (note.background || note.rejected) label.is_object = false;
  return label;
}

void shareClasses(std::map<RegionId, RegionLabel>& labels, const std::map<RegionId, RegionObject>& objects) {
  std::map<ObjectId, std::string> classes;
  for (const auto& [region, object] : objects) {
    const auto found = labels.find(region);
    if (object.is_merged || !object.object || found == labels.end()) continue;
    if (!found->second.category.empty()) classes.try_emplace(object.object, found->second.category);
  }
  for (auto& [region, label] : labels) {
    const auto of_object = classes.find(label.object);
    const auto object = objects.find(region);
    const bool is_merged = object != objects.end() && object->second.is_merged;
    if (of_object != classes.end() && !label.class_id && (is_merged || label.category.empty()))
      label.category = of_object->second;
  }
}

std::string rememberedToText(const RememberedObjects& objects) {
  if (objects.empty()) return {};
  LabelJson json = LabelJson::object();
  for (const auto& [region, remembered] : objects) {
    const RegionObject& object = remembered.object;
    json[std::to_string(region.value)] = {{"object", object.object.value},
                                          {"name", object.name},
                                          {"by_person", object.named_by == NamedBy::user},
                                          {"confirmed", object.confirmed},
                                          {"deleted", object.state == State::deleted},
                                          {"merged", object.is_merged},
                                          {"catalogue", remembered.catalogue}};
    if (!object.class_id && object.class_name.empty()) continue;
    json[std::to_string(region.value)]["class"] = object.class_name;
    json[std::to_string(region.value)]["class_id"] = object.class_id.value;
  }
  return json.dump(-1, ' ', false, LabelJson::error_handler_t::replace);
}

RememberedObjects rememberedFrom(const std::string& text) {
  RememberedObjects objects;
  if (text.empty()) return objects;
  try {
    const LabelJson all = LabelJson::parse(text);
    for (const auto& [region, json] : all.items()) {
      RememberedObject remembered;
      RegionObject& object = remembered.object;
      object.object = ObjectId{json.at("object").get<std::uint32_t>()};
      object.name = json.at("name").get<std::string>();
      object.named_by = json.at("by_person").get<bool>() ? NamedBy::user : NamedBy::program;
      object.confirmed = json.at("confirmed").get<bool>();
      object.state = json.at("deleted").get<bool>() ? State::deleted : State::known;
      object.is_merged = json.at("merged").get<bool>();
      remembered.catalogue = json.at("catalogue").get<std::string>();
      object.class_name = json.value("class", "");
      object.class_id = ClassId{json.value("class_id", std::uint32_t{0})};
      objects[RegionId{static_cast<std::uint32_t>(std::stoul(region))}] = std::move(remembered);
    }
  } catch (const std::exception&) {
    objects.clear();
  }
  return objects;
}

RememberedObjects remember(RememberedObjects before, const std::map<RegionId, RegionObject>& now,
                           const std::string& catalogue) {
  std::erase_if(before, [&](const auto& entry) {
    return entry.second.catalogue == catalogue || now.contains(entry.first);
  });
  for (const auto& [region, object] : now) {
    if (object.state != State::none) before[region] = {object, catalogue};
  }
  return before;
}

}  // namespace scantrove
