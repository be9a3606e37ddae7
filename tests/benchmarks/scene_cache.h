#pragma once
#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "core/exchange/atomic_file.h"
#include "core/exchange/label_image_writer.h"
#include "core/exchange/recording_writer.h"
#include "core/image/image_file.h"
#include "core/scan/open_source.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::benchmarks {

/// Synthetic scenes stored as recordings with truth; each is rendered once.
class SceneCache {
 public:
  /// `frames`: number of frames of each scene, stored in a separate folder; 0: all.
  SceneCache(std::filesystem::path folder, int frames) : folder_(std::move(folder)), frames_(frames) {}

  /// `scene`: "room:7:uneven", as after "demo:". Renders it when it is missing, or when the first frame of
  /// the scene has changed.
  [[nodiscard]] Result<std::filesystem::path> recordingOf(const std::string& scene) const {
    std::string name = scene;
    std::replace(name.begin(), name.end(), ':', '-');
    if (frames_ > 0) name += "-first-" + std::to_string(frames_);
    const std::filesystem::path folder = folder_ / name;
    const auto isCurrent = checkIsCurrent(scene, folder);
    if (!isCurrent) return fail(isCurrent.error());
    if (!*isCurrent) SCANTROVE_TRY(render(scene, folder));
    return folder;
  }

 private:
  static std::filesystem::path lastFile(const std::filesystem::path& folder) { return folder / "complete"; }

  static Result<bool> checkIsCurrent(const std::string& scene, const std::filesystem::path& folder) {
    if (!std::filesystem::exists(lastFile(folder))) return false;
    SourceOptions first;
    first.frames = 1;
    const auto source = makeSyntheticSource(scene, first);
    if (!source) return fail(source.error());
    const RgbdFrame now = (*source)->next().frame;
    const auto depth = readDepthImage(folder / "frame-000000.depth.png");
    const auto instances = readLabelImage(folder / "frame-000000.instance.png");
    return depth && instances && cv::norm(now.depth, *depth, cv::NORM_INF) == 0 &&
           cv::norm(now.instances, *instances, cv::NORM_INF) == 0;
  }

  Result<void> render(const std::string& scene, const std::filesystem::path& folder) const {
    std::filesystem::remove_all(folder);
    SourceOptions which;
    if (frames_ > 0) which.frames = frames_;
    const auto source = openSource("demo:" + scene, which);
    if (!source) return fail(source.error());
    auto writer = RecordingWriter::create(folder, (*source)->info());
    if (!writer) return fail(writer.error());
    for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
         read = (*source)->next()) {
      SCANTROVE_TRY(writer->add(read.frame));
    }
    return writeFileAtomically(lastFile(folder), "");
  }

  std::filesystem::path folder_;
  int frames_;
};

}  // namespace scantrove::benchmarks
