#include "core/session/final_label_images.h"

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/regular_file.h"
#include "core/capture/open_input.h"
#include "core/exchange/atomic_file.h"
#include "core/session/key_frame_files.h"

namespace scantrove {
namespace {

/// Images between two entries in the session's record: bounds memory (0.5 MB) and entries.
constexpr std::size_t kMaxDrawn = 64;

std::uint32_t crcOfBytes(const std::string& bytes) { return crc32Of({bytes.data(), bytes.size()}); }

std::string countOf(std::size_t images) {
  return std::to_string(images) + (images == 1 ? " image" : " images");
}

}  // namespace

void FinalLabelImages::begin(const SavedScan& earlier) {
  earlier_.frames = earlier.frames;
  earlier_.key_frames = earlier.key_frames;
  earlier_.recordings = earlier.recordings;
  record_ = finalLabelsFrom(earlier.metadata);
}

std::filesystem::path FinalLabelImages::fileOf(int frame_index) const {
  return folder_ / "labels-final" / labelFileName(frame_index);
}

Result<void> FinalLabelImages::redraw(const FinalLabelRecord& own, RegionNumbers& numbers,
                                      const FrameLabelWriter::RenderView& render, const StoreRecord& store) {
  numbers_ = &numbers;
  render_ = &render;
  store_ = &store;
  remarks_.clear();
  obstacle_.clear();
  std::set<int> own_frames;
  for (const FinalLabelImage& image : own) own_frames.insert(image.frame_index);
  std::erase_if(record_, [&](const auto& image) { return own_frames.contains(image.frame_index); });
  record_.insert(record_.end(), own.begin(), own.end());
  std::ranges::sort(record_, {}, &FinalLabelImage::frame_index);
  findUnchanged(own_frames);
  const Result<void> from_session = drawFromKeyFrames();
  const Result<void> drawn = from_session ? drawFromRecordings() : from_session;
  Result<void> written = writeDrawn();
  remarkOnRest();
  pending_.clear();
  if (!record_.empty()) SCANTROVE_TRY(store(record_));
  SCANTROVE_TRY(drawn);
  return written;
}

void FinalLabelImages::findUnchanged(const std::set<int>& own_frames) {
  std::size_t changed = 0;
  std::set<int> known;
  for (FinalLabelImage& image : record_) {
    known.insert(image.frame_index);
    if (own_frames.contains(image.frame_index)) continue;
    const Result<std::string> bytes = readFile(fileOf(image.frame_index));
    if (!bytes) continue;  // somebody removed it
    const std::uint32_t checksum = crcOfBytes(*bytes);
    if (checksum == image.checksum || checksum == image.next_checksum) {
      image.checksum = checksum;
      pending_[image.frame_index] = &image;
    } else {
      ++changed;
    }
  }
  const auto unknown = std::ranges::count_if(earlier_.frames, [&](const SavedFrame& frame) {
    std::error_code ignored;
    return !known.contains(frame.source_index) &&
           std::filesystem::exists(fileOf(frame.source_index), ignored);
  });
  changed += static_cast<std::size_t>(unknown);
  if (changed == 0) return;
  remarks_.push_back({"The scan did not write " + countOf(changed) + " in " +
                          (folder_ / "labels-final").string() + " as found now, and replaces none of them.",
                      ""});
}

Result<void> FinalLabelImages::drawFromKeyFrames() {
  for (const SavedKeyFrame& key : earlier_.key_frames) {
    const auto frame = std::ranges::find(earlier_.frames, key.frame, &SavedFrame::number);
    if (frame == earlier_.frames.end() || !pending_.contains(frame->source_index)) continue;
    const Result<RgbdFrame> seen = readKeyFrame(folder_, key, *frame);
    if (seen) SCANTROVE_TRY(draw(frame->source_index, seen->depth));
  }
  return {};
}

Result<void> FinalLabelImages::drawFromRecordings() {
  const std::vector<SavedRecording>& recordings = earlier_.recordings;
  for (std::size_t i = 0; i < recordings.size() && !pending_.empty(); ++i) {
    const int end =
        i + 1 < recordings.size() ? recordings[i + 1].first_frame : std::numeric_limits<int>::max();
    std::vector<int> requested;
    for (const SavedFrame& frame : earlier_.frames) {
      const bool is_of_it = frame.number >= recordings[i].first_frame && frame.number < end;
      if (is_of_it && pending_.contains(frame.source_index)) requested.push_back(frame.source_index);
    }
    if (!requested.empty()) SCANTROVE_TRY(drawFrom(recordings[i], requested));
  }
  return {};
}

Result<void> FinalLabelImages::drawFrom(const SavedRecording& recording, const std::vector<int>& requested) {
  const auto note = [&](std::string obstacle) {
    if (obstacle_.empty()) obstacle_ = std::move(obstacle);
  };
  if (isCameraName(recording.source)) {
    note("only key frames of a camera are kept");
    return {};
  }
  const Result<std::unique_ptr<FrameSource>> source = open_(recording.source);
  if (!source) {
    note("the recording " + recording.source + " cannot be read any more");
    return {};
  }
  std::set<int> left(requested.begin(), requested.end());
  while (!left.empty()) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) break;
    if (read.status != FrameRead::Status::frame) continue;
    const int frame_index = read.frame.index + recording.index_shift;
    if (left.erase(frame_index) > 0) SCANTROVE_TRY(draw(frame_index, read.frame.depth));
  }
  const auto is_pending = [this](int frame_index) { return pending_.contains(frame_index); };
  if (std::ranges::any_of(requested, is_pending))
    note("the recording " + recording.source + " has other frames than when it was scanned");
  return {};
}

Result<void> FinalLabelImages::draw(int frame_index, const cv::Mat& depth) {
  const auto found = pending_.find(frame_index);
  const auto frame = std::ranges::find(earlier_.frames, frame_index, &SavedFrame::source_index);
  if (found == pending_.end() || frame == earlier_.frames.end()) return {};
  FinalLabelImage& image = *found->second;
  if (checksumOfDepth(depth) != image.depth_checksum) return {};
  const Result<RenderedView> view = (*render_)(frame->T_world_camera, frame->intrinsics);
  if (!view) return fail(view.error());
  Result<std::string> bytes =
      FrameLabelWriter::drawFinal(fileOf(frame_index), *view, depth, image.meters_per_unit, *numbers_);
  if (!bytes) return fail(bytes.error());
  image.next_checksum = crcOfBytes(*bytes);
  drawn_.push_back({&image, std::move(*bytes)});
  pending_.erase(found);
  return drawn_.size() < kMaxDrawn ? Result<void>() : writeDrawn();
}

/// Records the new files before they are written: after a crash they would otherwise seem to belong to
/// somebody.
Result<void> FinalLabelImages::writeDrawn() {
  if (drawn_.empty()) return {};
  SCANTROVE_TRY((*store_)(record_));
  for (const Drawn& one : std::exchange(drawn_, {})) {
    SCANTROVE_TRY(writeFileAtomically(fileOf(one.image->frame_index), one.bytes, Durability::process));
    one.image->checksum = std::exchange(one.image->next_checksum, 0);
  }
  return {};
}

void FinalLabelImages::remarkOnRest() {
  if (pending_.empty()) return;
  const std::string why = obstacle_.empty() ? "the frames' depth is not kept" : obstacle_;
  remarks_.push_back({"The final regions are missing in " + countOf(pending_.size()) + " of " +
                          (folder_ / "labels-final").string() + ": " + why + ".",
                      "Scan the recording anew to get all images."});
}

}  // namespace scantrove
