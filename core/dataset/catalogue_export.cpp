#include "core/dataset/catalogue_export.h"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/capture/intrinsics.h"
#include "core/catalogue/object_database.h"
#include "core/compute/guarded.h"
#include "core/dataset/export_text.h"
#include "core/dataset/staged_folder.h"
#include "core/exchange/atomic_file.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Number of attempts if others write into the catalogue during the export.
constexpr int kMaxExports = 3;

ExportJson toJson(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

ExportJson toJson(const Intrinsics& K) {
  return {{"fx", K.fx}, {"fy", K.fy}, {"cx", K.cx}, {"cy", K.cy}, {"width", K.width}, {"height", K.height}};
}

/// Intrinsics of a view's images: the part of the camera's image in its box, at their size.
Intrinsics cropOf(const Intrinsics& K, const ObjectView& view) {
  const cv::Rect& box = view.box_px;
  const Intrinsics part{
      K.fx, K.fy, K.cx - static_cast<float>(box.x), K.cy - static_cast<float>(box.y), box.width, box.height};
  return part.resizedTo(view.color.cols, view.color.rows);
}

ExportJson viewToJson(const ObjectView& view, const std::map<std::int64_t, Intrinsics>& cameras) {
  ExportJson T = ExportJson::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d numbers = view.T_world_camera.matrix().row(row);
    T.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  }
  ExportJson json{{"view", view.id},
                  {"session", view.session},
                  {"frame", view.frame_index},
                  {"T_world_camera", T},
                  {"direction", toJson(view.direction)},
                  {"size_m", toJson(view.size_m)},
                  {"box_px", nullptr},
                  {"frame_px", nullptr},
                  {"camera", nullptr},
                  {"crop_camera", nullptr}};
  const bool has_box = !view.frame_px.empty() && !view.box_px.empty();
  if (has_box) {
    const cv::Rect& box = view.box_px;
    json["box_px"] = {box.x, box.y, box.width, box.height};
    json["frame_px"] = {view.frame_px.width, view.frame_px.height};
  }
  const auto camera = cameras.find(view.session);
  if (camera == cameras.end()) return json;
  json["camera"] = toJson(camera->second);
  const cv::Size of_camera(camera->second.width, camera->second.height);
  if (has_box && of_camera == view.frame_px) json["crop_camera"] = toJson(cropOf(camera->second, view));
  return json;
}

ExportJson objectToJson(const ObjectRecord& object, const CatalogueModel& catalogue,
                        const std::string& folder, std::size_t views) {
  const ObjectClass* own = catalogue.classOf(object.classification);
  ExportJson answers = ExportJson::object();
  for (const auto& [name, value] : catalogue.answersOf(object.classification)) answers[name] = value;
  return {{"id", object.id.value},
          {"name", object.name},
          {"class", own != nullptr ? ExportJson(own->name) : ExportJson(nullptr)},
          {"class_id", own != nullptr ? ExportJson(own->id.value) : ExportJson(nullptr)},
          {"attributes", answers},
          {"folder", folder},
          {"views", views},
          {"named_by_person", object.named_by == NamedBy::user},
          {"confirmed", object.confirmed},
          {"size_m", toJson(object.size_m)},
          {"first_session", object.first_session_name},
          {"created", object.created}};
}

/// One export into `folder`.
class CatalogueExportJob {
 public:
  CatalogueExportJob(ObjectDatabase& database, fs::path folder)
      : database_(database), folder_(std::move(folder)) {}

  Result<CatalogueExportSummary> run(const std::string& name, const ExportProgressCallback& progress,
                                     const std::stop_token& cancel) {
    const auto objects = database_.objects();
    if (!objects) return fail(objects.error());
    if (objects->empty())
      return fail("The catalogue " + name + " has no objects: there is nothing to export.");
    SCANTROVE_TRY(moveInto(cameras_, database_.sessions().cameras()));
    SCANTROVE_TRY(moveInto(model_, database_.model()));
    const int total = static_cast<int>(objects->size());
    ExportJson index = ExportJson::array();
    for (const ObjectRecord& object : *objects) {
      if (cancel.stop_requested()) return fail("The export was cancelled; nothing was written.");
      if (progress) progress({summary_.objects, total, object.name});
      SCANTROVE_TRY(writeObject(object, index));
    }
    SCANTROVE_TRY(write("objects.json", jsonText(index)));
    if (progress) progress({total, total, "done"});
    return std::move(summary_);
  }

 private:
  Result<void> writeObject(const ObjectRecord& object, ExportJson& index) {
    const auto views = database_.views().of(object.id);
    if (!views) return fail(views.error());
    const std::string folder = safeFileName(object.id.value, object.name);
    std::error_code failure;
    fs::create_directories(folder_ / folder, failure);
    if (failure) {
      return fail("Cannot create the folder " + (folder_ / folder).string() + ": " + failure.message() + ".",
                  "Check that it can be written to and that the disk is not full.");
    }
    for (const ObjectView& view : *views) SCANTROVE_TRY(writeView(folder, view));
    if (const auto missing = object.views - static_cast<int>(views->size()); missing > 0)
      summary_.skipped.push_back(std::to_string(missing) + " of the views of " + object.name +
                                 " cannot be used and are left out.");
    index.push_back(objectToJson(object, model_, folder, views->size()));
    ++summary_.objects;
    return {};
  }

  Result<void> writeView(const std::string& folder, const ObjectView& view) {
    const std::string stem = folder + '/' + fmt::format("{:06}", view.id);
    if (!view.color.empty()) SCANTROVE_TRY(write(stem + ".color.png", encodePng(view.color)));
    if (!view.mask.empty()) SCANTROVE_TRY(write(stem + ".mask.png", encodePng(view.mask)));
    if (!view.depth_mm.empty()) SCANTROVE_TRY(write(stem + ".depth.png", encodePng(view.depth_mm)));
    ++summary_.views;
    return write(stem + ".json", jsonText(viewToJson(view, cameras_)));
  }

  Result<void> write(const std::string& name, const std::string& bytes) {
    summary_.bytes += bytes.size();
    return writeFileAtomically(folder_ / name, bytes, Durability::process);
  }

  ObjectDatabase& database_;
  fs::path folder_;
  std::map<std::int64_t, Intrinsics> cameras_;
  CatalogueModel model_;
  CatalogueExportSummary summary_;
};

/// None: somebody wrote into the catalogue meanwhile.
Result<std::optional<CatalogueExportSummary>> exportOnce(const std::string& database, const fs::path& folder,
                                                         const ExportProgressCallback& progress,
                                                         const std::stop_token& cancel) {
  const auto catalogue = ObjectDatabase::openToRead(database);
  if (!catalogue) return fail(catalogue.error());
  auto staged = StagedFolder::create(folder);
  if (!staged) return fail(staged.error());
  Result<CatalogueExportSummary> summary =
      CatalogueExportJob(**catalogue, staged->path()).run(database, progress, cancel);
  if (!(*catalogue)->isStill()) return std::nullopt;
  if (!summary) return fail(staged->inFinalWords(summary.error()));
  if (const auto committed = staged->commit(); !committed)
    return fail(staged->inFinalWords(committed.error()));
  summary->folder = staged->place();
  return std::move(*summary);
}

}  // namespace

Result<CatalogueExportSummary> exportCatalogue(const std::string& database, const fs::path& folder,
                                               const ExportProgressCallback& progress,
                                               const std::stop_token& cancel) {
  return guarded("exporting the catalogue", [&]() -> Result<CatalogueExportSummary> {
    for (int i = 0; i < kMaxExports; ++i) {
      auto summary = exportOnce(database, folder, progress, cancel);
      if (!summary) return fail(summary.error());
      if (*summary) return std::move(**summary);
    }
    return fail("Another program keeps writing into the catalogue " + database + ".",
                "Wait until it is done, or export a copy.");
  });
}

}  // namespace scantrove
