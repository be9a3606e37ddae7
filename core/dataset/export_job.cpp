#include "core/dataset/export_job.h"

#include <system_error>
#include <utility>

#include "core/dataset/region_choice.h"
#include "core/dataset/staged_folder.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {

namespace fs = std::filesystem;

ExportJob::ExportJob(ExportScans scans, const ExportOptions& options, fs::path folder,
                     const ExportProgressCallback& progress, const std::stop_token& cancel)
    : scans_(std::move(scans)),
      options_(options),
      folder_(std::move(folder)),
      progress_(progress),
      cancel_(cancel),
      record_(datasetFormatNames().at(static_cast<std::size_t>(options.format))) {}

Result<void> ExportJob::readRegions() {
  const auto before = [this](int done, int total, const std::string& what) {
    return step(done, total, what);
  };
  SCANTROVE_TRY(scans_.read(options_, hasImages(options_.format), before, summary().notes));
  for (const DatasetPart& part : scans_.parts()) {
    summary().regions += static_cast<int>(part.chosen.size());
    if (part.split) counts_.beginScan(*part.split);
  }
  summary().scans = static_cast<int>(scans_.parts().size());
  noteUnlabeled();
  return {};
}

void ExportJob::noteUnlabeled() {
  const ExportChoices& choices = options_.choices;
  int left_out = 0, own_classes = 0;
  for (const DatasetPart& part : scans_.parts()) {
    left_out += static_cast<int>(part.unlabeled.size());
    for (const LabeledRegion& region : part.chosen) {
      const bool is_set_aside = region.background || region.rejected;
      own_classes += !is_set_aside && !isNamed(region) ? 1 : 0;
    }
  }
  summary().unlabeled = left_out + own_classes;
  std::vector<std::string>& notes = summary().notes;
  if (left_out > 0 && choices.unlabeled == UnlabeledObjects::ignore && !hasIgnoreRegions(options_.format)) {
    notes.push_back(std::to_string(left_out) + " unlabelled objects are left out: the format " +
                    record_.format() + " has no regions to ignore.");
  }
  if (choices.unlabeled != UnlabeledObjects::warn || !hasImages(options_.format)) return;
  if (left_out > 0) {
    notes.push_back(std::to_string(left_out) +
                    " objects have no label here, but images may show them. Label them, or mark "
                    "them as regions to ignore (--unlabeled ignore).");
  }
  if (own_classes > 0) {
    notes.push_back(std::to_string(own_classes) +
                    " objects have no name; each is a class of its own. Name them, or export named ones only "
                    "(--only named).");
  }
}

Result<void> ExportJob::needRegions() const {
  if (scans_.isProject() || !scans_.chosen().empty()) return {};
  return fail(nothingToExport(scans_.title(), options_));
}

Result<void> ExportJob::forEachScan(const std::function<Result<void>()>& use) {
  return scans_.forEach([&]() -> Result<void> {
    frames_.reset();
    return use();
  });
}

Result<void> ExportJob::step(int done, int total, const std::string& what) const {
  if (cancel_.stop_requested()) return fail("The export was cancelled; nothing was written.");
  if (!progress_) return {};
  const auto count = static_cast<int>(scans_.parts().size());
  if (count < 2 || !scans_.isOpen()) {
    progress_({done, total, what});
  } else {
    progress_({(part().number - 1) * total + done, count * total, part().name + ": " + what});
  }
  return {};
}

Result<void> ExportJob::write(const fs::path& name, std::string_view bytes) {
  summary().bytes += bytes.size();
  if (options_.dry_run) return {};
  const fs::path path = pathOf(name);
  std::error_code failure;
  fs::create_directories(path.parent_path(), failure);
  if (failure) {
    return fail("Cannot create the folder " + path.parent_path().string() + ": " + failure.message() + ".",
                "Check that it can be written to and that the disk is not full.");
  }
  SCANTROVE_TRY(writeFileAtomically(path, bytes, Durability::process));
  record_.add(inner_folder_ / name, bytes);
  return {};
}

Result<void> ExportJob::noteWritten(const fs::path& name) {
  const fs::path inner = inner_folder_ / name;
  if (auto added = record_.addWritten(folder_, inner); !added)
    return readBackFailure(name, added.error().what);
  summary().bytes += record_.files().at(inner).bytes;
  return {};
}

tl::unexpected<Error> ExportJob::readBackFailure(const fs::path& name, const std::string& why) const {
  return fail("What was written to " + (folder_ / name).string() + " does not read back: " + why + ".",
              "Check the disk, and export again or to another one.");
}

Result<void> ExportJob::checkFiles() const {
  std::error_code failure;
  std::size_t found = 0;
  for (fs::recursive_directory_iterator entry(folder_, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (entry->is_directory()) continue;
    const fs::path name = entry->path().lexically_relative(folder_);
    if (name == StagedFolder::kMarker) continue;
    const auto written = record_.files().find(name);
    if (written == record_.files().end()) return readBackFailure(name, "nobody wrote it");
    if (entry->file_size() != written->second.bytes) return readBackFailure(name, "its length differs");
    ++found;
  }
  if (failure) return readBackFailure({}, failure.message());
  if (found != record_.files().size()) return readBackFailure({}, "files are missing");
  return {};
}

}  // namespace scantrove
