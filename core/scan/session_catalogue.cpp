#include "core/scan/session_catalogue.h"

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/catalog/object_database.h"
#include "core/scan/first_error.h"
#include "core/scan/guarded.h"
#include "core/scan/kept_namings.h"
#include "core/scan/region_views.h"
#include "core/scan/scan_pipeline.h"
#include "core/scan/session_joining.h"

namespace scantrove {
namespace {

/// Directions from which a new object has views.
constexpr std::size_t kMostDirections = 6;

Result<std::unique_ptr<ObjectDatabase>> openCatalogueOf(OpenSession& session) {
  const std::filesystem::path file = catalogueFileOf(session);
  if (file.empty()) return fail("The session " + session.folder().string() + " has no catalogue.");
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return fail("The catalogue " + file.string() + " of this session is not there.",
                "Put it back and say it again.");
  }
  Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(file.string());
  if (!database) return database;
  // Another file may lie there by now: what the session knows of objects is not of that one.
  const Result<bool> is_other = session.useCatalogue(**database);
  if (!is_other) return fail(is_other.error());
  return database;
}

/// The object that the region is now; none: it is none, or was deleted.
ObjectId presentObjectOf(const OpenSession& session, ObjectDatabase& database, RegionId region) {
  const ObjectId object = session.objectOf(region);
  return object ? database.resolve(object).value_or(ObjectId{}) : ObjectId{};
}

/// The object is called otherwise, by another of its regions.
bool isNamedByAnother(OpenSession& session, ObjectDatabase& database, RegionId region, ObjectId object,
                      const std::string& name) {
  const ScanPipeline& pipeline = session.pipeline();
  const auto& notes = pipeline.editor().notes().all();
  return std::ranges::any_of(notes, [&](const auto& entry) {
    const auto& [other, note] = entry;
    return other != region && !note.name.empty() && note.name != name &&
           !pipeline.regionTable().fragmentsOf(other).empty() &&
           presentObjectOf(session, database, other) == object;
  });
}

Result<ObjectId> makeFromKeyFrames(OpenSession& session, ObjectDatabase& database, RegionId region) {
  Result<std::vector<ObjectView>> views = viewsOfRegion(session, region, kMostDirections);
  if (!views) return fail(views.error());
  if (views->empty()) {
    return fail("No key frame of " + session.folder().string() + " shows region " +
                    std::to_string(region.value) + ".",
                "Scan on with --resume and show it to the camera.");
  }
  const Result<std::int64_t> begun = database.beginSession(session.setup().source, session.setup().K);
  if (!begun) return fail(begun.error());
  for (ObjectView& view : *views) view.session = *begun;
  const Result<ObjectRecord> object = database.addObject(views->front());
  if (!object) return fail(object.error());
  for (ObjectView& view : std::span(*views).subspan(1)) {
    view.object = object->id;
    const Result<std::int64_t> added = database.addView(view);
    if (!added) return fail(added.error());
  }
  SCANTROVE_TRY(database.endSession(*begun));
  return object->id;
}

/// A new object for the region; one that was made for it, and went with an undo, comes back.
Result<ObjectId> objectFor(OpenSession& session, ObjectDatabase& database, RegionId region) {
  const std::string fact = goneObjectFactOf(region);
  const ObjectId gone{static_cast<std::uint32_t>(parseFrameNumber(session.fact(fact)).value_or(0))};
  session.setFact(fact, "");
  if (gone && database.restore(std::array{gone}) && database.resolve(gone).value_or(ObjectId{}) == gone)
    return gone;
  return makeFromKeyFrames(session, database, region);
}

/// Names the region's object, or one that is made for it.
Result<KeptNaming> nameObjectOf(OpenSession& session, ObjectDatabase& database, RegionId region,
                                const std::string& name) {
  KeptNaming kept;
  kept.earlier = presentObjectOf(session, database, region);
  if (kept.earlier && !isNamedByAnother(session, database, region, kept.earlier, name)) {
    SCANTROVE_TRY(moveInto(kept.naming, database.nameByPerson(kept.earlier, name)));
    if (kept.naming.object) return kept;
    // This object and the one of that name are two. The region is not this one, then.
  }
  SCANTROVE_TRY(moveInto(kept.made, objectFor(session, database, region)));
  SCANTROVE_TRY(moveInto(kept.naming, database.nameByPerson(kept.made, name)));
  return kept;
}

std::vector<KeptNaming> keptOf(const OpenSession& session, RegionId region) {
  return namingsFromJson(session.fact(namingsFactOf(region)));
}

void keep(OpenSession& session, RegionId region, const std::vector<KeptNaming>& kept) {
  session.setFact(namingsFactOf(region), namingsToJson(kept));
}

/// The name that the newest naming gave and nobody took back; empty: there is none.
std::string newestNameOf(const OpenSession& session, RegionId region) {
  const std::vector<KeptNaming> kept = keptOf(session, region);
  const auto found = std::find_if(kept.rbegin(), kept.rend(),
                                  [](const KeptNaming& one) { return !one.naming.name.empty(); });
  return found == kept.rend() ? "" : found->naming.name;
}

/// Takes the newest entry of that name back.
Result<bool> takeBack(OpenSession& session, RegionId region, const std::string& name) {
  std::vector<KeptNaming> kept = keptOf(session, region);
  const auto found = std::find_if(kept.rbegin(), kept.rend(),
                                  [&](const KeptNaming& one) { return one.naming.name == name; });
  if (found == kept.rend()) return false;
  const KeptNaming newest = *found;
  const auto database = openCatalogueOf(session);
  if (!database) return fail(database.error());
  bool is_as_said = true;
  if (!name.empty()) SCANTROVE_TRY(moveInto(is_as_said, (*database)->takeNameBack(newest.naming)));
  ObjectId object = newest.earlier;
  if (newest.made && is_as_said) {
    const Result<ObjectRecord> made = (*database)->object(newest.made);
    if (made && !isSettled(*made)) {
      SCANTROVE_TRY((*database)->remove(std::array{newest.made}));
      session.setFact(goneObjectFactOf(region), std::to_string(newest.made.value));
    } else {
      object = newest.made;
    }
  } else if (!object) {
    object = newest.naming.object;
  }
  kept.erase(std::next(found).base());
  keep(session, region, kept);
  SCANTROVE_TRY(session.setObject(region, object));
  return true;
}

}  // namespace

std::filesystem::path catalogueFileOf(const OpenSession& session) {
  return databaseFileOf(session.setup(), session.folder());
}

Result<ObjectId> nameInCatalogue(OpenSession& session, RegionId region, const std::string& name) {
  return guarded("naming in the catalogue", [&]() -> Result<ObjectId> {
    const Result<std::string> checked = ObjectDatabase::checkedName(name);
    if (!checked) return fail(checked.error());
    const auto database = openCatalogueOf(session);
    if (!database) return fail(database.error());
    const Result<KeptNaming> naming = nameObjectOf(session, **database, region, *checked);
    if (!naming) return fail(naming.error());
    std::vector<KeptNaming> kept = keptOf(session, region);
    kept.push_back(*naming);
    keep(session, region, kept);
    SCANTROVE_TRY(session.setObject(region, naming->naming.object));
    return naming->naming.object;
  });
}

Result<bool> takeNameFromCatalogue(OpenSession& session, RegionId region, const std::string& name) {
  return guarded("taking a name back in the catalogue", [&]() -> Result<bool> {
    const Result<std::string> checked = ObjectDatabase::checkedName(name);
    return checked ? takeBack(session, region, *checked) : Result<bool>(false);
  });
}

Result<ObjectId> addToCatalogue(OpenSession& session, RegionId region) {
  return guarded("adding to the catalogue", [&]() -> Result<ObjectId> {
    const auto database = openCatalogueOf(session);
    if (!database) return fail(database.error());
    if (const ObjectId object = presentObjectOf(session, **database, region)) return object;
    KeptNaming added;
    SCANTROVE_TRY(moveInto(added.made, objectFor(session, **database, region)));
    added.naming.object = added.made;
    std::vector<KeptNaming> kept = keptOf(session, region);
    kept.push_back(added);
    keep(session, region, kept);
    SCANTROVE_TRY(session.setObject(region, added.made));
    return added.made;
  });
}

Result<bool> takeFromCatalogue(OpenSession& session, RegionId region) {
  return guarded("taking an object back in the catalogue", [&] { return takeBack(session, region, ""); });
}

Result<void> followInCatalogue(OpenSession& session, const RegionEditor::Outcome& outcome, SaidHow how) {
  SCANTROVE_TRY(mergeJoinedObjects(session));
  const Operation& operation = outcome.operation;
  const bool is_naming = isNaming(operation.kind);
  const bool is_adding = operation.kind == OperationKind::object && operation.on;
  if (!is_naming && !is_adding) return {};
  const bool is_undone = how == SaidHow::undone;
  std::vector<RegionId> regions = operation.regions;
  if (is_undone) std::ranges::reverse(regions);
  const auto follow = [&](RegionId region) -> Result<void> {
    if (is_adding && is_undone) return takeFromCatalogue(session, region).map([](bool) {});
    if (is_adding) return addToCatalogue(session, region).map([](ObjectId) {});
    // Removing a name takes the naming back; undoing that names the region again, as its note now says.
    const bool is_removal = operation.name.empty();
    const std::string given = is_removal && is_undone ? session.noteOf(region).name : operation.name;
    if (is_removal == is_undone) {
      if (given.empty()) return {};
      return nameInCatalogue(session, region, given).map([](ObjectId) {});
    }
    const std::string removed = is_removal ? newestNameOf(session, region) : operation.name;
    if (removed.empty()) return {};
    const Result<bool> taken = takeNameFromCatalogue(session, region, removed);
    if (!taken) return fail(taken.error());
    if (*taken || !session.objectOf(region)) return {};
    return fail("What the catalogue calls the object stays as it is.",
                "'scantrove objects rename' changes it.");
  };
  FirstError first;
  for (const RegionId region : regions) first.note(follow(region));
  return first.result();
}

}  // namespace scantrove
