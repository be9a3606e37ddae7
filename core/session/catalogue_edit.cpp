#include "core/session/catalogue_edit.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/base/label_name.h"
#include "core/base/text.h"
#include "core/catalogue/region_object.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/region_views.h"

namespace scantrove {
namespace {

using OutcomeJson = nlohmann::ordered_json;

/// Maximum number of views of a new object, one per direction.
constexpr std::size_t kMaxDirections = 6;

}  // namespace

std::string CatalogueOutcome::toJson() const {
  OutcomeJson json{{"facts", OutcomeJson::object()},
                   {"objects", OutcomeJson::array()},
                   {"refusals", OutcomeJson::array()}};
  for (const auto& [name, value] : metadata) json["facts"][name] = value;
  for (const auto& [region, object] : objects) json["objects"].push_back({region.value, object.value});
  for (const Error& refusal : refusals) json["refusals"].push_back({refusal.what, refusal.advice});
  return json.dump(-1, ' ', false, OutcomeJson::error_handler_t::replace);
}

Result<CatalogueOutcome> CatalogueOutcome::fromJson(const std::string& text) {
  try {
    const OutcomeJson json = OutcomeJson::parse(text);
    CatalogueOutcome outcome;
    for (const auto& [name, value] : json.at("facts").items())
      outcome.metadata[name] = value.get<std::string>();
    for (const OutcomeJson& one : json.at("objects"))
      outcome.objects[RegionId{one.at(0).get<std::uint32_t>()}] = ObjectId{one.at(1).get<std::uint32_t>()};
    for (const OutcomeJson& one : json.at("refusals"))
      outcome.refusals.push_back({one.at(0).get<std::string>(), one.at(1).get<std::string>()});
    return outcome;
  } catch (const OutcomeJson::exception&) {
    return fail("What the catalogue did for an edit of the session cannot be read.",
                "Restore the catalogue from a backup.");
  }
}

Result<CatalogueOutcome> CatalogueEdit::carryOut(const PendingEdit& edit) {
  for (;;) {
    without_views_ = {};
    const Result<std::string> done = database_.applyOnce(edit.token, [&] { return run(edit); });
    if (done) return CatalogueOutcome::fromJson(*done);
    if (!without_views_) return fail(done.error());
    const RegionId region = without_views_;
    SCANTROVE_TRY(moveInto(views_[region], viewsOfRegion(session_, region, kMaxDirections)));
  }
}

Result<std::string> CatalogueEdit::run(const PendingEdit& edit) {
  outcome_ = {};
  for (const CatalogueStep& step : edit.steps) SCANTROVE_TRY(runStep(step));
  return outcome_.toJson();
}

Result<void> CatalogueEdit::runStep(const CatalogueStep& step) {
  switch (step.kind) {
    case CatalogueStep::Kind::name:
      keep(undoneNamingsKeyOf(step.region), {});
      return name(step);
    case CatalogueStep::Kind::redo_name:
      return redoName(step);
    case CatalogueStep::Kind::revert_name:
      return revertName(step);
    case CatalogueStep::Kind::add:
      return add(step.region);
    case CatalogueStep::Kind::revert_object:
      break;
  }
  return revert(step.region, "").map([](bool) {});
}

Result<void> CatalogueEdit::name(const CatalogueStep& step) {
  const Result<std::string> checked = checkedLabelName(step.name);
  if (!checked) {
    outcome_.refusals.push_back(checked.error());
    return {};
  }
  GivenName given{*checked};
  if (!step.class_name.empty()) {
    const Result<std::string> class_name = checkedLabelName(step.class_name);
    if (class_name) given.class_name = *class_name;
    if (!class_name)
      refuse("The catalogue has no such class. " + class_name.error().what, class_name.error().advice);
  }
  Result<std::optional<StoredNaming>> naming = nameObjectOf(step.region, given);
  if (!naming) return fail(naming.error());
  if (!*naming) return {};
  std::vector<StoredNaming> namings = kept(namingsKeyOf(step.region));
  namings.push_back(**naming);
  keep(namingsKeyOf(step.region), namings);
  setObject(step.region, (*naming)->naming.object);
  return {};
}

Result<void> CatalogueEdit::redoName(const CatalogueStep& step) {
  const std::string key = undoneNamingsKeyOf(step.region);
  std::vector<StoredNaming> undone = kept(key);
  if (!undone.empty()) {
    const StoredNaming newest = undone.back();
    undone.pop_back();
    keep(key, undone);
    // The undo left later changes by others alone, and so does this.
    if (newest.is_overruled && trimmed(step.name) == newest.naming.name) {
      std::vector<StoredNaming> namings = kept(namingsKeyOf(step.region));
      namings.push_back(newest);
      keep(namingsKeyOf(step.region), namings);
      setObject(step.region, newest.naming.object);
      return {};
    }
  }
  return name(step);
}

Result<void> CatalogueEdit::revertName(const CatalogueStep& step) {
  std::string removed = step.name;
  if (removed.empty()) {
    // The name from the newest naming that was not undone.
    const std::vector<StoredNaming> namings = kept(namingsKeyOf(step.region));
    const auto newest = std::find_if(namings.rbegin(), namings.rend(),
                                     [](const StoredNaming& one) { return !one.naming.name.empty(); });
    if (newest == namings.rend()) return {};
    removed = newest->naming.name;
  }
  const Result<std::string> checked = checkedLabelName(removed);
  const Result<bool> taken = checked ? revert(step.region, *checked) : Result<bool>(false);
  if (!taken) return fail(taken.error());
  if (!*taken && objectOf(step.region))
    refuse("What the catalogue calls the object stays as it is.", "'scantrove objects rename' changes it.");
  return {};
}

Result<void> CatalogueEdit::add(RegionId region) {
  if (presentObjectOf(region)) return {};
  StoredNaming added;
  SCANTROVE_TRY(moveInto(added.made, objectFor(region)));
  if (!added.made) return {};
  added.naming.object = added.made;
  std::vector<StoredNaming> namings = kept(namingsKeyOf(region));
  namings.push_back(added);
  keep(namingsKeyOf(region), namings);
  setObject(region, added.made);
  return {};
}

Result<bool> CatalogueEdit::revert(RegionId region, const std::string& name) {
  std::vector<StoredNaming> namings = kept(namingsKeyOf(region));
  const auto found = std::find_if(namings.rbegin(), namings.rend(),
                                  [&](const StoredNaming& one) { return one.naming.name == name; });
  if (found == namings.rend()) return false;
  StoredNaming newest = *found;
  bool is_reverted = true;
  if (!name.empty()) SCANTROVE_TRY(moveInto(is_reverted, database_.revertNaming(newest.naming)));
  ObjectId object = newest.earlier;
  if (newest.made && is_reverted) {
    const Result<bool> is_removed = database_.withdraw(newest.made);
    if (!is_removed) return fail(is_removed.error());
    if (*is_removed) outcome_.metadata[removedObjectKeyOf(region)] = std::to_string(newest.made.value);
    if (!*is_removed) object = newest.made;
  } else if (!object && !newest.made) {
    object = newest.naming.object;
  }
  if (!is_reverted)
    refuse("The catalogue keeps what it calls the object: others have changed it since.",
           "'scantrove objects' shows and changes it.");
  namings.erase(std::next(found).base());
  keep(namingsKeyOf(region), namings);
  newest.is_overruled = !is_reverted;
  if (!name.empty()) {
    std::vector<StoredNaming> undone = kept(undoneNamingsKeyOf(region));
    undone.push_back(newest);
    keep(undoneNamingsKeyOf(region), undone);
  }
  setObject(region, object);
  return true;
}

Result<std::optional<StoredNaming>> CatalogueEdit::nameObjectOf(RegionId region, const GivenName& given) {
  StoredNaming kept;
  kept.earlier = presentObjectOf(region);
  const Result<CatalogueModel> catalogue = database_.model();
  if (!catalogue) return fail(catalogue.error());
  if (kept.earlier &&
      !isAnotherObject(*catalogue, kept.earlier, given.name, namesOfOthers(region, kept.earlier))) {
    SCANTROVE_TRY(moveInto(kept.naming, database_.nameByUser(kept.earlier, given.name, given.class_name)));
    return kept;
  }
  SCANTROVE_TRY(moveInto(kept.made, objectFor(region)));
  if (!kept.made) return std::nullopt;
  SCANTROVE_TRY(moveInto(kept.naming, database_.nameByUser(kept.made, given.name, given.class_name)));
  return kept;
}

Result<ObjectId> CatalogueEdit::objectFor(RegionId region) {
  const std::string key = removedObjectKeyOf(region);
  const ObjectId gone{static_cast<std::uint32_t>(parseFrameNumber(metadata(key)).value_or(0))};
  outcome_.metadata[key] = "";
  if (gone && database_.restore(std::array{gone}) && database_.mergeRoot(gone).value_or(ObjectId{}) == gone)
    return gone;
  return makeFromKeyFrames(region);
}

Result<ObjectId> CatalogueEdit::makeFromKeyFrames(RegionId region) {
  const auto found = views_.find(region);
  if (found == views_.end()) {
    without_views_ = region;
    return fail("The views of region " + std::to_string(region.value) + " are still to be cut.");
  }
  std::vector<ObjectView> views = found->second;  // shares the images
  if (views.empty()) {
    refuse("No key frame of " + session_.folder().string() + " shows region " + std::to_string(region.value) +
               ".",
           "Scan on with --resume and show it to the camera.");
    return ObjectId{};
  }
  const Result<std::int64_t> begun = database_.sessions().begin(session_.setup().source, session_.setup().K);
  if (!begun) return fail(begun.error());
  for (ObjectView& view : views) view.session = *begun;
  const Result<ObjectRecord> object = database_.addObject(views.front());
  if (!object) return fail(object.error());
  for (ObjectView& view : std::span(views).subspan(1)) {
    view.object = object->id;
    const Result<std::int64_t> added = database_.addView(view);
    if (!added) return fail(added.error());
  }
  SCANTROVE_TRY(database_.sessions().end(*begun));
  return object->id;
}

std::vector<std::string> CatalogueEdit::namesOfOthers(RegionId region, ObjectId object) {
  const MappingPipeline& pipeline = session_.pipeline();
  std::vector<std::string> names;
  for (const auto& [other, note] : pipeline.labels().editor().notes().all()) {
    if (other != region && !note.name.empty() && !pipeline.labels().table().fragmentsOf(other).empty() &&
        presentObjectOf(other) == object)
      names.push_back(note.name);
  }
  return names;
}

ObjectId CatalogueEdit::presentObjectOf(RegionId region) {
  const ObjectId object = objectOf(region);
  return object ? database_.mergeRoot(object).value_or(ObjectId{}) : ObjectId{};
}

ObjectId CatalogueEdit::objectOf(RegionId region) const {
  const auto changed = outcome_.objects.find(region);
  return changed == outcome_.objects.end() ? session_.objectOf(region) : changed->second;
}

std::string CatalogueEdit::metadata(const std::string& name) const {
  const auto changed = outcome_.metadata.find(name);
  return changed == outcome_.metadata.end() ? session_.metadata(name) : changed->second;
}

}  // namespace scantrove
