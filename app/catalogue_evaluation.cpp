#include "app/catalogue_evaluation.h"

#include <cmath>
#include <set>

#include "app/core_application.h"
#include "app/json_output.h"
#include "app/true_objects.h"
#include "core/capture/pose_files.h"
#include "core/catalogue/object_database.h"
#include "core/exchange/label_image_writer.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
struct Entry {
  ObjectRecord record;
  std::vector<ObjectView> views;  // of the evaluated session
};

constexpr const char* wordFor(CatalogueVerdict verdict) {
  switch (verdict) {
    case CatalogueVerdict::complete:
      return "whole";
    case CatalogueVerdict::part:
      return "part";
    case CatalogueVerdict::merger:
      return "merger";
    case CatalogueVerdict::background:
      break;
  }
  return "background";
}

/// Numbers of the frames that a scan tracked, from the times in its trajectory. Empty if a time is not a
/// multiple of 1/30 s.
Result<std::set<long>> scannedFrames(const fs::path& scan) {
  constexpr double kFramesPerSecond = 30;
  const auto trajectory = readTumTrajectory(scan / "trajectory.txt");
  if (!trajectory) return fail(trajectory.error());
  std::set<long> frames;
  for (const StampedPose& pose : *trajectory) {
    const double frame = pose.timestamp_s * kFramesPerSecond;
    if (std::abs(frame - std::round(frame)) > 0.01 || frame > 1e6) return std::set<long>{};
    frames.insert(std::lround(frame));
  }
  return frames;
}

/// Entries that have views from the newest session with views, and that session.
Result<std::vector<Entry>> readEntries(ObjectDatabase& database, std::int64_t& session) {
  const auto records = database.objects();
  if (!records) return fail(records.error());
  std::vector<Entry> entries;
  session = 0;
  for (const ObjectRecord& record : *records) {
    Entry entry{record, {}};
    SCANTROVE_TRY(moveInto(entry.views, database.views().of(record.id)));
    for (const ObjectView& view : entry.views) session = std::max(session, view.session);
    entries.push_back(std::move(entry));
  }
  for (Entry& entry : entries) {
    std::erase_if(entry.views, [&](const ObjectView& view) { return view.session != session; });
  }
  std::erase_if(entries, [](const Entry& entry) { return entry.views.empty(); });
  return entries;
}

/// The view's box in the ground truth image, whose size may differ from the frame's.
cv::Rect boxIn(const cv::Size& image, const ObjectView& view) {
  const double sx = static_cast<double>(image.width) / view.frame_px.width;
  const double sy = static_cast<double>(image.height) / view.frame_px.height;
  const cv::Point first(cvRound(view.box_px.x * sx), cvRound(view.box_px.y * sy));
  const cv::Point last(cvRound(view.box_px.br().x * sx), cvRound(view.box_px.br().y * sy));
  return {first, last};
}

Result<EntryJudgment> judge(const Entry& entry, const TrueScene& scene, const std::set<int>& objects) {
  std::vector<ViewJudgment> views;
  for (const ObjectView& view : entry.views) {
    const auto image = scene.images.find(view.frame_index);
    if (image == scene.images.end()) continue;
    if (view.frame_px.empty()) {
      return fail("The views of " + entry.record.name + " have no position in their frame.",
                  "An older version stored them. Scan again.");
    }
    const auto truth = readLabelImage(image->second);
    if (!truth) return fail(truth.error());
    views.push_back(judgeView(view.mask, boxIn(truth->size(), view), *truth, objects));
  }
  return judgeEntry(views);
}

Json namesOf(const std::vector<int>& instances, const TrueScene& scene) {
  Json names = Json::array();
  for (const int instance : instances) {
    const auto name = scene.names.find(instance);
    names.push_back(name != scene.names.end() ? name->second : std::to_string(instance));
  }
  return names;
}

Json toJson(const Entry& entry, const EntryJudgment& judgment, const TrueScene& scene) {
  return {{"id", entry.record.id.value},
          {"name", entry.record.name},
          {"verdict", wordFor(judgment.verdict)},
          {"of", namesOf(judgment.instances, scene)},
          {"views", judgment.views},
          {"whole_views", judgment.complete_views}};
}

}  // namespace

Result<Json> evaluateCatalogueOf(const std::string& scan, const std::string& truth,
                                 const std::string& database) {
  const fs::path file = database.empty() ? fs::path(scan) / "catalogue.sqlite" : fs::path(database);
  if (!mayCatalogueExist(file)) {
    return fail("There is no catalogue " + file.string() + ".",
                "Give --database if the scan used another one.");
  }
  const auto scanned = scannedFrames(scan);
  if (!scanned) return fail(scanned.error());
  const auto scene =
      readTrueScene(truth, [&](long frame) { return scanned->empty() || scanned->contains(frame); });
  if (!scene) return fail(scene.error());
  const CoreApplication qt;
  const auto catalogue = ObjectDatabase::open(file.string());
  if (!catalogue) return fail(catalogue.error());
  std::int64_t session = 0;
  const auto entries = readEntries(**catalogue, session);
  if (!entries) return fail(entries.error());

  std::set<int> objects;
  for (const auto& [id, object] : scene->objects) objects.insert(id);
  std::vector<EntryJudgment> judgments;
  Json each = Json::array();
  for (const Entry& entry : *entries) {
    const auto judgment = judge(entry, *scene, objects);
    if (!judgment) return fail(judgment.error());
    if (judgment->views == 0) continue;
    judgments.push_back(*judgment);
    each.push_back(toJson(entry, *judgment, *scene));
  }
  const CatalogueMetrics metrics = evaluateCatalogue(judgments, scene->objects);
  return Json{{"purity", metrics.purity},
              {"completeness", metrics.completeness},
              {"seen_entirely", metrics.seen_entirely},
              {"completeness_of_entire", metrics.completeness_of_entire},
              {"entries", metrics.entries},
              {"whole", metrics.complete},
              {"duplicates", metrics.duplicates},
              {"expected", metrics.expected},
              {"missing", namesOf(metrics.missing, *scene)},
              {"frames", scene->images.size()},
              {"session", session},
              {"each", each}};
}

}  // namespace scantrove
