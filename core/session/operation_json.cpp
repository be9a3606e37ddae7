#include "core/session/operation_json.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace scantrove {
namespace {

using Json = nlohmann::ordered_json;

template <class Tag>
Json numbersOf(const std::vector<Id<Tag>>& ids) {
  Json numbers = Json::array();
  for (const Id<Tag> id : ids) numbers.push_back(id.value);
  return numbers;
}

Json placesOf(const std::vector<Eigen::Vector3f>& places) {
  Json list = Json::array();
  for (const Eigen::Vector3f& place : places) list.push_back({place.x(), place.y(), place.z()});
  return list;
}

/// Rejects numbers that no float holds: JSON has no infinity, but 1e99.
float coordinateFrom(const Json& number) {
  const auto value = number.get<double>();
  if (!(std::abs(value) <= std::numeric_limits<float>::max()))
    throw Json::other_error::create(501, "no coordinate", nullptr);
  return static_cast<float>(value);
}

std::vector<Eigen::Vector3f> placesFrom(const Json& list) {
  std::vector<Eigen::Vector3f> places;
  for (const Json& place : list)
    places.emplace_back(coordinateFrom(place.at(0)), coordinateFrom(place.at(1)),
                        coordinateFrom(place.at(2)));
  return places;
}

Json maskToJson(const MaskCorrection& correction) {
  Json json{{"key_frame", correction.key_frame},
            {"image", correction.image},
            {"size", {correction.added.width, correction.added.height}}};
  if (correction.this_image_only) json["this_image_only"] = true;
  if (correction.makes_region) json["makes_region"] = true;
  return json;
}

int countFrom(const Json& number) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() > INT32_MAX)
    throw Json::other_error::create(501, "no count", nullptr);
  return number.get<int>();
}

MaskCorrection maskFrom(const Json& json) {
  MaskCorrection correction{.key_frame = countFrom(json.at("key_frame")),
                            .image = countFrom(json.at("image"))};
  for (PaintedPixels* pixels : {&correction.added, &correction.removed})
    *pixels = {countFrom(json.at("size").at(0)), countFrom(json.at("size").at(1)), {}};
  correction.this_image_only = json.value("this_image_only", false);
  correction.makes_region = json.value("makes_region", false);
  return correction;
}

Json noteToJson(const RegionNote& note) {
  return {note.name, note.category, note.background, note.object, note.rejected};
}

RegionNote noteFrom(const Json& list) {
  return {list.at(0).get<std::string>(), list.at(1).get<std::string>(), list.at(2).get<bool>(),
          list.at(3).get<bool>(), list.at(4).get<bool>()};
}

/// Rejects numbers that are negative, fractional or too large, which get() alone would convert.
std::uint32_t numberFrom(const Json& number) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() > UINT32_MAX)
    throw Json::other_error::create(501, "no number of a fragment or region", nullptr);
  return number.get<std::uint32_t>();
}

/// Requires a list, because get() would accept an object's values.
const Json& listAt(const Json& json, const char* name) {
  const Json& list = json.at(name);
  if (!list.is_array()) throw Json::other_error::create(501, "no list", nullptr);
  return list;
}

LinkConstraint constraintFrom(const Json& json) {
  const std::uint32_t number = numberFrom(json);
  if (number > 2) throw Json::other_error::create(501, "no constraint", nullptr);
  return static_cast<LinkConstraint>(number);
}

/// Calls `read` on text that may not be JSON, or not of that form.
template <class Read>
auto readJson(const std::string& text, Read&& read) -> std::optional<decltype(read(Json()))> {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string operationToJson(const Operation& operation) {
  Json json{{"kind", toString(operation.kind)}, {"regions", numbersOf(operation.regions)}};
  if (!operation.name.empty()) json["name"] = operation.name;
  if (!operation.category.empty()) json["category"] = operation.category;
  if (!operation.on) json["on"] = false;
  if (!operation.here_world.empty()) json["here"] = placesOf(operation.here_world);
  if (!operation.there_world.empty()) json["there"] = placesOf(operation.there_world);
  if (operation.frame >= 0) json["frame"] = operation.frame;
  if (operation.correction) json["mask"] = maskToJson(*operation.correction);
  if (operation.review) json["image"] = operation.review->image;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Operation> operationFromJson(const std::string& text) {
  return readJson(text, [](const Json& json) {
    Operation operation;
    const auto kind = operationKindOf(json.at("kind").get<std::string>());
    if (!kind) throw Json::other_error::create(501, "no such operation", nullptr);
    operation.kind = *kind;
    for (const Json& number : listAt(json, "regions"))
      operation.regions.push_back(RegionId{numberFrom(number)});
    operation.name = json.value("name", "");
    operation.category = json.value("category", "");
    operation.on = json.value("on", true);
    operation.here_world = placesFrom(json.value("here", Json::array()));
    operation.there_world = placesFrom(json.value("there", Json::array()));
    operation.frame = json.value("frame", -1);
    if (json.contains("mask")) operation.correction = maskFrom(json.at("mask"));
    if (operation.kind == OperationKind::review)
      operation.review = FrameReview{.image = countFrom(json.at("image"))};
    return operation;
  });
}

std::string effectToJson(const OperationEffect& effect) {
  Json json{{"moves", Json::array()}, {"said", Json::array()}, {"notes", Json::array()}};
  for (const RegionMove& move : effect.moves)
    json["moves"].push_back({move.fragment.value, move.before.value, move.after.value});
  for (const auto& constraint : effect.constraints)
    json["said"].push_back({constraint.a.value, constraint.b.value, static_cast<int>(constraint.before),
                            static_cast<int>(constraint.after)});
  for (const auto& note : effect.notes)
    json["notes"].push_back({note.region.value, noteToJson(note.before), noteToJson(note.after)});
  if (effect.anchor) json["anchor"] = effect.anchor.value;
  if (!effect.created.empty()) json["created"] = numbersOf(effect.created);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<OperationEffect> effectFromJson(const std::string& text) {
  return readJson(text, [](const Json& json) {
    OperationEffect effect;
    const auto number = numberFrom;
    for (const Json& move : listAt(json, "moves"))
      effect.moves.push_back(
          {FragmentId{number(move.at(0))}, RegionId{number(move.at(1))}, RegionId{number(move.at(2))}});
    for (const Json& constraint : listAt(json, "said"))
      effect.constraints.push_back({FragmentId{number(constraint.at(0))},
                                    FragmentId{number(constraint.at(1))}, constraintFrom(constraint.at(2)),
                                    constraintFrom(constraint.at(3))});
    for (const Json& note : listAt(json, "notes"))
      effect.notes.push_back({RegionId{number(note.at(0))}, noteFrom(note.at(1)), noteFrom(note.at(2))});
    if (json.contains("anchor")) effect.anchor = FragmentId{number(json.at("anchor"))};
    if (json.contains("created")) {
      for (const Json& region : listAt(json, "created")) effect.created.push_back(RegionId{number(region)});
    }
    return effect;
  });
}

}  // namespace scantrove
