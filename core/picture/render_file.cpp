#include "core/picture/render_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <string_view>
#include <system_error>

#include "core/exchange/part_name.h"
#include "core/image/png_encoder.h"
#include "core/picture/surface_renderer.h"
#include "core/picture/video_writer.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannotWritePicture(const fs::path& file, int code) {
  return fail("Cannot write " + file.string() + ": " + std::generic_category().message(code) + ".",
              "Check that the folder can be written to and that the disk is not full.");
}

tl::unexpected<Error> existsAlready(const fs::path& file) {
  return fail(file.string() + " exists already and stays as it is.", "Choose another name.");
}

/// A file in progress beside its name, locked so that no other run takes it for abandoned; removed unless it
/// was published.
class UnfinishedPicture {
 public:
  explicit UnfinishedPicture(const fs::path& file)
      : file_(file),
        part_(makePartName(file)),
        descriptor_(::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) error_ = errno;
    if (descriptor_ >= 0) (void)::flock(descriptor_, LOCK_EX | LOCK_NB);  // not every file system has locks
  }
  UnfinishedPicture(const UnfinishedPicture&) = delete;
  UnfinishedPicture& operator=(const UnfinishedPicture&) = delete;
  ~UnfinishedPicture() {
    std::error_code ignored;
    if (descriptor_ < 0) return;  // the name may belong to another program
    if (!is_published_) fs::remove(part_, ignored);
    ::close(descriptor_);
  }

  [[nodiscard]] const fs::path& path() const { return part_; }
  [[nodiscard]] Result<void> check() const {
    if (descriptor_ < 0) return cannotWritePicture(file_, error_);
    return {};
  }
  [[nodiscard]] Result<void> write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return cannotWritePicture(file_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
  }

  /// Gives the file its name. Error: something else has it now.
  [[nodiscard]] Result<void> publish() {
    if (::fsync(descriptor_) != 0) return cannotWritePicture(file_, errno);
    // A link never replaces anything; file systems without links have no such step.
    if (::link(part_.c_str(), file_.c_str()) == 0) return {};
    if (errno == EEXIST) return existsAlready(file_);
    if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS) return cannotWritePicture(file_, errno);
    std::error_code failure;
    if (fs::symlink_status(file_, failure).type() != fs::file_type::not_found) return existsAlready(file_);
    fs::rename(part_, file_, failure);
    if (failure) return cannotWritePicture(file_, failure.value());
    is_published_ = true;
    return {};
  }

 private:
  fs::path file_, part_;
  int descriptor_;
  int error_ = 0;
  bool is_published_ = false;  // the part itself has the name now
};

bool isVideo(const RenderOptions& options) { return options.file.extension() == ".webm"; }

Result<void> drawVideo(const PictureScene& scene, const RenderOptions& options, int frames,
                       const fs::path& path, const RenderProgress& progress, const std::stop_token& cancel) {
  const TurntableCamera orbit(scene.surface, scene.up_world, scene.front_world, options.width,
                              options.height);
  auto video = VideoWriter::create(path, options.width, options.height, options.frames_per_second);
  if (!video) return fail(video.error());
  for (int i = 0; i < frames; ++i) {
    if (cancel.stop_requested()) return fail("The video was cancelled.");
    const double azimuth_deg = options.azimuth_deg + 360.0 * i / frames;
    SCANTROVE_TRY(video->add(renderSurface(scene.surface, orbit.at(azimuth_deg, options.elevation_deg))));
    if (progress) progress(i + 1, frames);
  }
  return video->finish();
}

std::string drawPicture(const PictureScene& scene, const RenderOptions& options) {
  const TurntableCamera orbit(scene.surface, scene.up_world, scene.front_world, options.width,
                              options.height);
  return encodePng(renderSurface(scene.surface, orbit.at(options.azimuth_deg, options.elevation_deg)));
}

}  // namespace

Result<int> renderFrameCount(const RenderOptions& options) {
  const auto isSide = [](int side) { return side >= kLeastPictureSide_px && side <= kLargestPictureSide_px; };
  if (!isSide(options.width) || !isSide(options.height))
    return fail("A picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                    " pixels cannot be drawn.",
                "Choose sides of " + std::to_string(kLeastPictureSide_px) + " to " +
                    std::to_string(kLargestPictureSide_px) + " pixels.");
  if (!(std::abs(options.elevation_deg) <= 90) || !std::isfinite(options.azimuth_deg))
    return fail("The direction of the camera is no direction.", "Choose an elevation of -90 to 90 degrees.");
  if (options.file.extension() == ".png") return 1;
  if (!isVideo(options))
    return fail(options.file.string() + " is neither a picture nor a video.",
                "End the name with .png or .webm.");
  const double frames = std::round(options.seconds * options.frames_per_second);
  if (!(frames >= 1 && frames <= kMostVideoFrames))
    return fail("A video has 1 to " + std::to_string(kMostVideoFrames) + " frames.",
                "Choose other seconds or another number of frames per second.");
  return static_cast<int>(frames);
}

Result<void> renderScan(LabeledScan& scan, const RenderOptions& options, const RenderProgress& progress,
                        const std::stop_token& cancel) {
  const Result<int> frames = renderFrameCount(options);
  if (!frames) return fail(frames.error());
  std::error_code ignored;
  if (fs::symlink_status(options.file, ignored).type() != fs::file_type::not_found)
    return existsAlready(options.file);
  SCANTROVE_TRY(
      UnfinishedPicture(options.file).check());  // before the work, but nothing lies there meanwhile
  const Result<PictureScene> scene = makePictureScene(scan, options.colors, options.object);
  if (!scene) return fail(scene.error());
  if (cancel.stop_requested()) return fail("The picture was cancelled.");
  UnfinishedPicture unfinished(options.file);
  SCANTROVE_TRY(unfinished.check());
  if (isVideo(options)) {
    SCANTROVE_TRY(drawVideo(*scene, options, *frames, unfinished.path(), progress, cancel));
  } else {
    SCANTROVE_TRY(unfinished.write(drawPicture(*scene, options)));
    if (progress) progress(1, 1);
  }
  return unfinished.publish();
}

}  // namespace scantrove
