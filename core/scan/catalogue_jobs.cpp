// What CatalogueWriter does on its own thread: one job after the other.
#include <sys/stat.h>

#include <new>
#include <utility>

#include "core/scan/catalogue_writer.h"
#include "core/scan/guarded.h"

namespace scantrove {

std::optional<std::pair<dev_t, ino_t>> CatalogueWriter::fileNow() const {
  // Without opening it, which is SQLite's business alone (see ObjectDatabase).
  struct stat status {};
  if (::stat(options_.database.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

Result<void> CatalogueWriter::checkFile() const {
  if (!file_ || fileNow() == file_) return {};
  return fail("The catalogue " + options_.database + " was moved, removed or replaced while the scan ran.",
              "Put it back.");
}

Result<CatalogueWriter::News> CatalogueWriter::attempt(Job& job) {
  constexpr const char* kActivity = "storing in the catalogue";
  try {
    SCANTROVE_TRY(checkFile());
    return std::visit([this](auto& one) { return execute(one); }, job);
  } catch (const std::bad_alloc&) {
    return fail(describeCurrentException(kActivity));
  } catch (const std::exception&) {
    // A library cannot encode this; it would say the same the next time.
    return refuse(job, describeCurrentException(kActivity));
  }
}

CatalogueWriter::News CatalogueWriter::refuse(const Job& job, const Error& error) {
  {
    const std::scoped_lock lock(mutex_);
    refused_.count(job);
    last_refusal_ = error;
  }
  if (const auto* object = std::get_if<AddObject>(&job)) {
    ids_[object->view.object] = {};
    return News{news::ObjectRefused{object->view.object}};
  }
  if (const auto* view = std::get_if<AddView>(&job)) return News{news::ViewDropped{view->view.object}};
  if (std::holds_alternative<Merge>(job)) return News{news::MergeDropped{}};
  return {};
}

ObjectId CatalogueWriter::idOf(ObjectId object) const {
  const auto found = ids_.find(object);
  return found == ids_.end() ? object : found->second;
}

Result<CatalogueWriter::News> CatalogueWriter::execute(const BeginSession& /*job*/) {
  SCANTROVE_TRY(moveInto(session_, database_->beginSession(options_.source)));
  return News{};
}

Result<CatalogueWriter::News> CatalogueWriter::execute(AddObject& job) {
  job.view.session = session_;
  Result<ObjectRecord> added = database_->addObject(job.view);
  if (!added) return fail(added.error());
  ids_[job.view.object] = added->id;
  touched_.insert(added->id);
  feed_->expectObject(added->id);
  return News{news::ObjectStored{job.view.object, std::move(*added)}};
}

Result<CatalogueWriter::News> CatalogueWriter::execute(AddView& job) {
  const ObjectId key = job.view.object, object = idOf(key);
  const News dropped{news::ViewDropped{key}};
  if (!object) return dropped;
  const Result<ObjectId> holder = database_->resolve(object);
  if (!holder) return fail(holder.error());
  if (!*holder) return dropped;
  ObjectView view = job.view;  // images are shared
  view.object = object;
  view.session = session_;
  const Result<std::int64_t> stored = database_->addView(view);
  if (!stored) return fail(stored.error());
  touched_.insert(*holder);
  feed_->expectView(*stored);
  return News{news::ViewStored{key, *holder}};
}

Result<CatalogueWriter::News> CatalogueWriter::execute(const Merge& job) {
  // A person may have undone such a merge by now.
  Result<CatalogueEdits> edits = feed_->follow();
  if (!edits) return fail(edits.error());
  if (!edits->isEmpty()) tell({news::Edited{std::move(*edits)}});
  std::vector<ObjectId> pair;  // that are there
  int settled = 0;
  for (const ObjectId key : {job.a, job.b}) {
    const ObjectId object = idOf(key);
    const Result<ObjectId> holder = object ? database_->resolve(object) : ObjectId{};
    if (!holder) return fail(holder.error());
    if (!*holder) continue;
    const Result<ObjectRecord> record = database_->object(*holder);
    if (!record) return fail(record.error());
    pair.push_back(*holder);
    settled += isSettled(*record) ? 1 : 0;
  }
  if (pair.size() < 2 || pair[0] == pair[1] || settled == 2 || feed_->areKeptApart(pair[0], pair[1])) {
    Result<CatalogueEdits> now = feed_->reread(pair);
    if (!now) return fail(now.error());
    return News{news::MergeDropped{}, news::Edited{std::move(*now)}};
  }
  Result<ObjectMerge> merge = database_->merge(pair);
  if (!merge) return fail(merge.error());
  touched_.insert(merge->into);
  feed_->expectMerge(*merge);
  const Result<ObjectRecord> holder = database_->object(merge->into);
  return News{news::MergeStored{std::move(*merge), holder ? std::optional(*holder) : std::nullopt}};
}

Result<CatalogueWriter::News> CatalogueWriter::execute(const EndSession& /*job*/) {
  SCANTROVE_TRY(database_->endSession(session_));
  // The last word on what this scan did; what cannot be read now is as it was known.
  News news;
  Result<CatalogueEdits> edits = feed_->follow();
  if (edits && !edits->isEmpty()) news.push_back(news::Edited{std::move(*edits)});
  const std::vector<ObjectId> touched(touched_.begin(), touched_.end());
  edits = feed_->reread(touched);
  if (edits) news.push_back(news::Edited{std::move(*edits)});
  return news;
}

}  // namespace scantrove
