#include "tools/train/sample_folder.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/base/file_lock.h"

namespace scantrove::train {
namespace {

namespace fs = std::filesystem;

/// Keeps other processes from scanning the same scene. Its file vanishes with it.
class SceneClaim {
 public:
  /// Error: `taken`, or the folder cannot be used.
  static Result<SceneClaim> claim(const fs::path& samples, const Error& taken) {
    fs::path file = samples;
    file.replace_extension(".lock");
    Result<FileLock> lock = FileLock::take(file, taken);
    if (!lock) return fail(lock.error());
    return SceneClaim(std::move(file), std::move(*lock));
  }
  SceneClaim(SceneClaim&& other) noexcept
      : file_(std::exchange(other.file_, {})), lock_(std::move(other.lock_)) {}
  SceneClaim& operator=(SceneClaim&&) = delete;
  ~SceneClaim() {
    std::error_code ignored;
    if (!file_.empty()) fs::remove(file_, ignored);
  }

 private:
  SceneClaim(fs::path file, FileLock lock) : file_(std::move(file)), lock_(std::move(lock)) {}
  fs::path file_;
  FileLock lock_;
};

/// Whether the samples are there. Error: they cannot be used.
Result<bool> arePresent(const fs::path& file, const SampleOrigin& origin) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return false;
  const Result<SceneSamples> samples = readSamples(file);
  if (!samples) return fail(samples.error());
  if (samples->origin.scene == origin.scene && samples->origin.frames == origin.frames) return true;
  return fail(fmt::format("{} holds samples of {} frames of {}, not of {} frames of {}.", file.string(),
                          samples->origin.frames, samples->origin.scene, origin.frames, origin.scene),
              "Delete it, or choose another folder.");
}

/// All sample files of a folder.
Result<std::set<fs::path>> filesIn(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".txt") files.insert(entry->path());
  if (error) return fail("Cannot read the folder " + folder.string() + ": " + error.message() + ".");
  if (files.empty()) return fail(folder.string() + " holds no samples.", "Name the scenes to scan.");
  return files;
}

}  // namespace

fs::path sampleFileOf(const fs::path& folder, const std::string& scene) {
  std::string name = scene;
  std::ranges::replace_if(
      name, [](char letter) { return letter == ':' || letter == '/'; }, '-');
  return folder / (name + ".txt");
}

Result<Collected> collectSamples(const fs::path& folder, const SampleOrigin& origin,
                                 const std::function<Result<SceneSamples>(const std::string&)>& scan) {
  const fs::path file = sampleFileOf(folder, origin.scene);
  const auto before = arePresent(file, origin);
  if (!before) return fail(before.error());
  if (*before) return Collected::present;
  const Error taken{"Another process scans " + origin.scene + ".", "Wait until it ends."};
  const auto claim = SceneClaim::claim(file, taken);
  if (!claim && claim.error().what == taken.what) return Collected::busy;
  if (!claim) return fail(claim.error());
  // Another process may have finished the scene before this one claimed it.
  const auto meanwhile = arePresent(file, origin);
  if (!meanwhile) return fail(meanwhile.error());
  if (*meanwhile) return Collected::present;
  Result<SceneSamples> samples = scan(origin.scene);
  if (!samples) return fail(samples.error());
  samples->origin = origin;
  SCANTROVE_TRY(writeSamples(file, *samples));
  return Collected::scanned;
}

Result<std::vector<SceneSamples>> readSampleFolder(const fs::path& folder,
                                                   std::span<const std::string> scenes) {
  std::set<fs::path> files;
  for (const std::string& scene : scenes) files.insert(sampleFileOf(folder, scene));
  if (scenes.empty()) SCANTROVE_TRY(moveInto(files, filesIn(folder)));
  std::vector<SceneSamples> all;
  for (const fs::path& file : files) {
    Result<SceneSamples> samples = readSamples(file);
    if (!samples) return fail(samples.error());
    all.push_back(std::move(*samples));
    const int frames = all.back().origin.frames, of_others = all.front().origin.frames;
    if (frames != of_others)
      return fail(fmt::format("{} comes from {} frames, the files before it from {}.", file.string(), frames,
                              of_others),
                  "Delete the files that do not belong to the others; their scenes are scanned again.");
  }
  return all;
}

}  // namespace scantrove::train
