#include "core/catalogue/catalogue_jobs.h"

#include <sys/stat.h>

#include <QString>
#include <QUuid>
#include <array>
#include <new>
#include <utility>
#include <vector>

#include "core/compute/guarded.h"

namespace scantrove {

std::optional<std::pair<dev_t, ino_t>> CatalogueJobs::fileNow() const {
  // Does not open the file: only SQLite may (see ObjectDatabase).
  struct stat status {};
  if (::stat(options_.database.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

Result<void> CatalogueJobs::checkFile() const {
  if (!file_ || fileNow() == file_) return {};
  return fail("The catalogue " + options_.database + " was moved, removed or replaced while the scan ran.",
              "Put it back.");
}

Result<void> CatalogueJobs::open(CataloguePosition from) {
  SCANTROVE_TRY(moveInto(database_, ObjectDatabase::open(options_.database)));
  feed_.emplace(*database_, from);
  file_ = fileNow();
  return {};
}

void CatalogueJobs::close() {
  if (feed_) last_event_ = feed_->position().event;
  feed_.reset();
  database_.reset();
}

Result<CatalogueJobs::Outcome> CatalogueJobs::attempt(CatalogueJob& job) {
  constexpr const char* kActivity = "storing in the catalogue";
  try {
    SCANTROVE_TRY(checkFile());
    Outcome outcome;
    SCANTROVE_TRY(moveInto(outcome.events, std::visit([this](auto& one) { return execute(one); }, job)));
    token_.clear();
    return outcome;
  } catch (const std::bad_alloc&) {
    return fail(describeCurrentException(kActivity));
  } catch (const std::exception&) {
    // An encoding error of a library would occur again at each repetition.
    const Error error = describeCurrentException(kActivity);
    token_.clear();
    return Outcome{refuse(job, error), error};
  }
}

CatalogueJobs::Events CatalogueJobs::refuse(const CatalogueJob& job, const Error& error) {
  if (const auto* object = std::get_if<job::AddObject>(&job)) {
    ids_[object->view.object] = {};
    return Events{event::ObjectRefused{object->view.object}};
  }
  if (const auto* view = std::get_if<job::AddView>(&job))
    return Events{event::ViewDropped{view->view.object}};
  if (std::holds_alternative<job::Merge>(job)) return Events{event::MergeDropped{}};
  if (const auto* name = std::get_if<job::Name>(&job)) return Events{event::NameDropped{name->object, error}};
  return {};
}

ObjectId CatalogueJobs::idOf(ObjectId object) const {
  const auto found = ids_.find(object);
  return found == ids_.end() ? object : found->second;
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::BeginSession& /*job*/) {
  session_ = options_.session;
  if (session_ != 0) return Events{};
  SCANTROVE_TRY(moveInto(session_, database_->sessions().begin(options_.source, options_.camera)));
  return Events{};
}

Result<std::int64_t> CatalogueJobs::storeOnce(const std::function<Result<std::int64_t>()>& store) {
  if (!database_->isOnServer()) return store();
  if (token_.empty()) token_ = QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString();
  const Result<std::string> id = database_->applyOnce(token_, [&]() -> Result<std::string> {
    const Result<std::int64_t> stored = store();
    if (!stored) return fail(stored.error());
    return std::to_string(*stored);
  });
  if (!id) return fail(id.error());
  return QString::fromStdString(*id).toLongLong();
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(job::AddObject& job) {
  job.view.session = session_;
  std::optional<ObjectRecord> added;
  const Result<std::int64_t> id = storeOnce([&]() -> Result<std::int64_t> {
    SCANTROVE_TRY(moveInto(added, database_->addObject(job.view)));
    return added->id.value;
  });
  if (!id) return fail(id.error());
  const ObjectId stored{static_cast<std::uint32_t>(*id)};
  if (!added || added->id != stored) {
    // An earlier attempt stored it. Others may have removed it since, which the feed reports.
    const Result<ObjectId> root = database_->mergeRoot(stored);
    if (!root) return fail(root.error());
    added.emplace();
    added->id = stored;
    added->size_m = job.view.size_m;
    if (*root == stored) SCANTROVE_TRY(moveInto(added, database_->object(stored)));
  }
  ids_[job.view.object] = added->id;
  touched_.insert(added->id);
  feed_->expectObject(added->id);
  return Events{event::ObjectStored{job.view.object, std::move(*added)}};
}

// Edits of users count until the moment of storing. Therefore each check runs inside the transaction that
// stores: a job may have waited for the transaction of such an edit.

Result<CatalogueJobs::Events> CatalogueJobs::execute(job::AddView& job) {
  const ObjectId key = job.view.object, object = idOf(key);
  if (!object) return Events{event::ViewDropped{key}};
  ObjectId root;
  bool is_deleted = false;
  const auto check = [&]() -> Result<void> {
    SCANTROVE_TRY(moveInto(root, database_->mergeRoot(object)));
    is_deleted = !root;
    return is_deleted ? Result<void>(fail("Its object was deleted.")) : Result<void>();
  };
  ObjectView view = job.view;  // shares the images
  view.object = object;
  view.session = session_;
  const Result<std::int64_t> stored = storeOnce([&] { return database_->addView(view, check); });
  if (is_deleted) return Events{event::ViewDropped{key}};
  if (!stored) return fail(stored.error());
  // An earlier attempt stored it.
  if (!root) SCANTROVE_TRY(moveInto(root, database_->mergeRoot(object)));
  if (!root) return Events{event::ViewDropped{key}};
  touched_.insert(root);
  feed_->expectView(*stored);
  return Events{event::ViewStored{key, root}};
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::Merge& job) {
  constexpr int kMaxTries = 8;  // after concurrent edits by others
  for (int i = 0; i < kMaxTries; ++i) {
    const Result<std::vector<ObjectId>> pair = mergeRootsOf(job);
    if (!pair) return fail(pair.error());
    if (pair->size() < 2) break;
    bool has_changed = false, are_two = false;
    const auto check = [&]() -> Result<void> {
      const Result<std::vector<ObjectId>> now = mergeRootsOf(job);
      if (!now) return fail(now.error());
      has_changed = *now != *pair;
      if (has_changed) return fail("Others have changed it.");
      const Result<bool> may_merge = mayMerge(*pair);
      if (!may_merge) return fail(may_merge.error());
      // A user who joins regions may merge what the program may not.
      are_two = job.join == 0 && !*may_merge;
      return are_two ? Result<void>(fail("They are two.")) : Result<void>();
    };
    Result<ObjectMerge> merge = database_->merge(*pair, check);
    if (has_changed) continue;
    if (are_two) break;
    if (!merge) return fail(merge.error());
    touched_.insert(merge->into);
    feed_->expectMerge(*merge);
    if (job.join != 0) joined_[job.join].push_back(*merge);
    const Result<ObjectRecord> root = database_->object(merge->into);
    return Events{event::MergeStored{std::move(*merge), root ? std::optional(*root) : std::nullopt}};
  }
  const Result<std::vector<ObjectId>> pair = mergeRootsOf(job);
  if (!pair) return fail(pair.error());
  Result<CatalogueEdits> now = feed_->reread(*pair);
  if (!now) return fail(now.error());
  return Events{event::MergeDropped{}, event::Edited{std::move(*now)}};
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::Part& job) {
  const auto found = joined_.find(job.join);
  const std::vector<ObjectMerge>& merges = found != joined_.end() ? found->second : job.earlier;
  std::vector<ObjectId> changed;
  for (auto merge = merges.rbegin(); merge != merges.rend(); ++merge) {
    SCANTROVE_TRY(database_->revertMerge(*merge));
    changed.push_back(merge->into);
    changed.insert(changed.end(), merge->from.begin(), merge->from.end());
  }
  if (found != joined_.end()) joined_.erase(found);
  if (changed.empty()) return Events{};
  touched_.insert(changed.begin(), changed.end());
  Result<CatalogueEdits> now = feed_->reread(changed);
  if (!now) return Events{};
  return Events{event::Edited{std::move(*now)}};
}

Result<std::vector<ObjectId>> CatalogueJobs::mergeRootsOf(const job::Merge& job) {
  std::vector<ObjectId> merge_roots;
  for (const ObjectId key : {job.a, job.b}) {
    const ObjectId object = idOf(key);
    if (!object) continue;
    const Result<ObjectId> root = database_->mergeRoot(object);
    if (!root) return fail(root.error());
    if (*root && (merge_roots.empty() || merge_roots.front() != *root)) merge_roots.push_back(*root);
  }
  return merge_roots;
}

Result<bool> CatalogueJobs::mayMerge(const std::vector<ObjectId>& pair) {
  // A user may have undone such a merge by now.
  Result<CatalogueEdits> edits = feed_->readEdits();
  if (!edits) return fail(edits.error());
  if (!edits->isEmpty()) notify_({event::Edited{std::move(*edits)}});
  if (feed_->areKeptApart(pair[0], pair[1])) return false;
  const Result<CatalogueModel> catalogue = database_->model();
  if (!catalogue) return fail(catalogue.error());
  return catalogue->mayMerge(pair[0], pair[1]);
}

CatalogueJobs::Events CatalogueJobs::withRecords(CatalogueEvent event, std::span<const ObjectId> objects) {
  Events all{std::move(event)};
  Result<CatalogueEdits> now = feed_->reread(objects);
  if (now) all.push_back(event::Edited{std::move(*now)});
  return all;
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::Name& job) {
  const ObjectId object = idOf(job.object);
  if (!object) return Events{event::NameDropped{job.object, std::nullopt}};
  const Result<ObjectId> root = database_->mergeRoot(object);
  if (!root) return fail(root.error());
  if (!*root) return Events{event::NameDropped{job.object, std::nullopt}};
  if (overruled_.contains(job.again))
    return withRecords(event::NameDropped{job.object, std::nullopt}, std::array{object, *root});
  const Result<ObjectNaming> naming = database_->nameByUser(*root, job.given.name, job.given.class_name);
  if (!naming) return fail(naming.error());
  if (!naming->object) {
    return withRecords(
        event::NameDropped{
            job.object, Error{"Another object in " + options_.database + " is called " + job.given.name + ".",
                              "Choose another name, or merge the two if they are one."}},
        std::array{object, *root});
  }
  touched_.insert(naming->object);
  namings_[job.naming] = *naming;
  return withRecords(event::NameStored{job.object, job.naming, *naming},
                     std::array{object, *root, naming->object});
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::RevertNaming& job) {
  if (job.earlier) namings_.try_emplace(job.naming, *job.earlier);
  const auto found = namings_.find(job.naming);
  if (found == namings_.end()) return Events{};  // it was dropped
  const ObjectNaming naming = found->second;
  const Result<bool> done = database_->revertNaming(naming);
  if (!done) return fail(done.error());
  if (!*done) overruled_.insert(job.naming);
  namings_.erase(found);
  std::vector<ObjectId> changed{naming.object};
  if (naming.merge) changed.insert(changed.end(), naming.merge->from.begin(), naming.merge->from.end());
  return withRecords(event::NamingReverted{naming.object}, changed);
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::Withdraw& job) {
  const ObjectId object = idOf(job.object);
  if (!object) return Events{};
  const Result<bool> is_removed = database_->withdraw(object);
  if (!is_removed) return fail(is_removed.error());
  touched_.insert(object);
  Result<CatalogueEdits> now = feed_->reread(std::array{object});
  if (!now) return Events{};
  return Events{event::Edited{std::move(*now)}};
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::DiscardViews& job) {
  const ObjectId object = idOf(job.object);
  if (!object) return Events{};
  const Result<ObjectId> root = database_->mergeRoot(object);
  if (!root) return fail(root.error());
  if (!*root) return Events{};  // it was deleted
  const Result<bool> is_removed = database_->discardViews(object, session_, job.frames);
  if (!is_removed) return fail(is_removed.error());
  touched_.insert(object);
  return withRecords(event::ViewsDiscarded{*root, *is_removed}, std::array{*root});
}

Result<CatalogueJobs::Events> CatalogueJobs::execute(const job::EndSession& /*job*/) {
  SCANTROVE_TRY(database_->sessions().end(session_));
  // The final report on this scan's jobs; unreadable objects keep their last known state.
  Events events;
  Result<CatalogueEdits> edits = feed_->readEdits();
  if (edits && !edits->isEmpty()) events.push_back(event::Edited{std::move(*edits)});
  const std::vector<ObjectId> touched(touched_.begin(), touched_.end());
  edits = feed_->reread(touched);
  if (edits) events.push_back(event::Edited{std::move(*edits)});
  return events;
}

}  // namespace scantrove
