#include "ui/models/region_names.h"

#include <QCoreApplication>
#include <algorithm>
#include <optional>
#include <set>

#include "core/catalogue/name_completion.h"

namespace scantrove {
namespace {

/// Ids of stand-ins; those of the catalogue stay far below.
constexpr std::uint32_t kFirstStandIn = 1U << 31U;
constexpr std::size_t kMostNamesInWords = 3;

ObjectId standInFor(RegionId region) { return ObjectId{kFirstStandIn + region.value}; }

/// Gives an object or stand-in a name and a class, in the copy alone.
void putName(CatalogueModel& catalogue, ObjectId object, const GivenName& given) {
  ClassId class_id;
  if (const ObjectClass* known = catalogue.classes().named(given.class_name)) {
    class_id = known->id;
  } else if (!given.class_name.empty()) {
    class_id = catalogue.addClass({.name = given.class_name}).value_or(ClassId{});
  }
  ObjectState state;
  state.id = object;
  state.name = given.name;
  state.named_by = NamedBy::user;
  state.classification.class_id = class_id;
  catalogue.put(std::move(state));
}

QString differentInWords(const std::vector<RegionName>& names) {
  QStringList quoted;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamesInWords); ++i)
    quoted << QStringLiteral("“%1”").arg(QString::fromStdString(names[i].given.name));
  if (names.size() > kMostNamesInWords) quoted << QStringLiteral("…");
  return QCoreApplication::translate("RegionNames", "%1 different things: %2")
      .arg(names.size())
      .arg(quoted.join(QStringLiteral(", ")));
}

}  // namespace

void RegionNames::begin(CatalogueModel catalogue, std::vector<RegionId> regions) {
  catalogue_ = std::move(catalogue);
  regions_ = std::move(regions);
  addNamesOfRegions();
}

void RegionNames::addNamesOfRegions() {
  const auto isNamedNow = [this](RegionId region) {
    return std::ranges::find(regions_, region) != regions_.end();
  };
  for (const RegionInfo& info : selection_.infos()) {
    const bool is_of_catalogue = catalogue_.visible(info.object) != nullptr;
    if (info.name().empty() || is_of_catalogue || given_.contains(info.region) || isNamedNow(info.region))
      continue;
    if (catalogue_.named(info.name()) == nullptr)
      putName(catalogue_, standInFor(info.region), {info.name(), info.category()});
  }
  for (const auto& [region, given] : given_) {
    if (!isNamedNow(region) && catalogue_.named(given.name.name) == nullptr)
      putName(catalogue_, standInFor(region), given.name);
  }
}

ObjectId RegionNames::objectOf(const CatalogueModel& catalogue, RegionId region) const {
  const RegionInfo* const info = selection_.info(region);
  const ObjectId root = info != nullptr ? catalogue.mergeRoot(info->object) : ObjectId{};
  return root ? root : standInFor(region);
}

Result<RegionNames::Completion> RegionNames::complete(const QString& text) const {
  Completion completion;
  // Names of several regions are given one after the other.
  std::optional<CatalogueModel> changed;
  if (regions_.size() > 1) changed = catalogue_;
  const CatalogueModel& catalogue = changed ? *changed : catalogue_;
  for (const RegionId region : regions_) {
    const ObjectId own = objectOf(catalogue, region);
    const Result<NameCompletion> one = completeName(catalogue, text.toStdString(), own);
    if (!one) return fail(one.error());
    TypedName& typed = completion.typed;
    if (completion.another.empty()) {
      typed.class_name = QString::fromStdString(one->class_name);
      typed.is_new_class = !one->class_id;
    }
    const std::string class_name = typed.class_name.toStdString();
    completion.another.push_back({region, {one->name, class_name}});
    completion.same.push_back({region, {one->typed, class_name}});
    typed.is_taken = typed.is_taken || one->same;
    typed.same = sameInWords(typed.class_name, QString::fromStdString(one->typed));
    if (changed) putName(*changed, own, completion.another.back().given);
  }
  if (completion.another.size() == 1) {
    completion.typed.another =
        anotherInWords(completion.typed.class_name, QString::fromStdString(completion.another[0].given.name));
  } else {
    completion.typed.another = differentInWords(completion.another);
  }
  return completion;
}

QStringList RegionNames::known() const {
  std::set<std::string> names;
  for (const ObjectClass& one : catalogue_.classes().visible()) names.insert(one.name);
  for (const auto& [id, object] : catalogue_.objects()) {
    if (!object.hidden && isSettled(object)) names.insert(object.name);
  }
  QStringList list;
  for (const std::string& name : names) list << QString::fromStdString(name);
  return list;
}

void RegionNames::noteDone(const Operation& operation) {
  if (!isNaming(operation.kind)) return;
  for (const RegionId region : operation.regions) {
    const auto found = given_.find(region);
    if (found != given_.end() && found->second.name.name == operation.name) found->second.is_done = true;
  }
}

void RegionNames::noteUpdated() {
  std::erase_if(given_, [](const auto& entry) { return entry.second.is_done; });
}

}  // namespace scantrove
