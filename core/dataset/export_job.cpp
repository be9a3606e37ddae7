#include "core/dataset/export_job.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/dataset/region_choice.h"
#include "core/dataset/staged_folder.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {

namespace fs = std::filesystem;

ExportJob::ExportJob(LabeledScan& scan, const ExportOptions& options, fs::path folder,
                     const ExportProgressCallback& progress, const std::stop_token& cancel)
    : scan_(scan), options_(options), folder_(std::move(folder)), progress_(progress), cancel_(cancel) {}

Result<void> ExportJob::readRegions() {
  SCANTROVE_TRY(moveInto(all_, scan_.regions()));
  std::sort(all_.begin(), all_.end(),
            [](const LabeledRegion& a, const LabeledRegion& b) { return a.id < b.id; });
  chosen_ = chooseRegions(all_, options_.background);
  summary_.regions = static_cast<int>(chosen_.size());
  return {};
}

Result<void> ExportJob::needRegions() const {
  if (!chosen_.empty()) return {};
  return fail(
      "No region of the scan " + scan_.name() + " has a name or is an object: there is nothing to export.",
      options_.background ? "Give one a name first." : "Give one a name first, or export with --background.");
}

Result<void> ExportJob::step(int done, int total, const std::string& what) const {
  if (cancel_.stop_requested()) return fail("The export was cancelled; nothing was written.");
  if (progress_) progress_({done, total, what});
  return {};
}

Result<void> ExportJob::write(const fs::path& name, std::string_view bytes) {
  const fs::path path = pathOf(name);
  std::error_code failure;
  fs::create_directories(path.parent_path(), failure);
  if (failure) {
    return fail("Cannot create the folder " + path.parent_path().string() + ": " + failure.message() + ".",
                "Check that it can be written to and that the disk is not full.");
  }
  SCANTROVE_TRY(writeFileAtomically(path, bytes, Durability::process));
  written_[name] = bytes.size();
  summary_.bytes += bytes.size();
  return {};
}

Result<void> ExportJob::noteWritten(const fs::path& name) {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(pathOf(name), failure);
  if (failure) return readBackFailure(name, failure.message());
  written_[name] = size;
  summary_.bytes += size;
  return {};
}

ClassCount& ExportJob::countOf(const std::string& class_name) {
  std::vector<ClassCount>& classes = summary_.classes;
  const auto found =
      std::lower_bound(classes.begin(), classes.end(), class_name,
                       [](const ClassCount& count, const std::string& name) { return count.name < name; });
  if (found != classes.end() && found->name == class_name) return *found;
  return *classes.insert(found, {class_name, 0, 0, 0});
}

void ExportJob::countMask(const std::string& class_name, int pixels) {
  ClassCount& count = countOf(class_name);
  count.images += in_image_.insert(class_name).second ? 1 : 0;
  ++count.instances;
  count.pixels += static_cast<std::uint64_t>(pixels);
  ++summary_.annotations;
}

void ExportJob::countObject(const std::string& class_name) {
  ++countOf(class_name).instances;
  ++summary_.annotations;
}

tl::unexpected<Error> ExportJob::readBackFailure(const fs::path& name, const std::string& why) const {
  return fail("What was written to " + pathOf(name).string() + " does not read back: " + why + ".",
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
    const auto written = written_.find(name);
    if (written == written_.end()) return readBackFailure(name, "nobody wrote it");
    if (entry->file_size() != written->second) return readBackFailure(name, "its length differs");
    ++found;
  }
  if (failure) return readBackFailure({}, failure.message());
  if (found != written_.size()) return readBackFailure({}, "files are missing");
  return {};
}

}  // namespace scantrove
