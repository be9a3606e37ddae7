#include "core/session/frame_label_writer.h"

#include <future>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/first_error.h"
#include "core/base/thread_priority.h"
#include "core/compute/guarded.h"
#include "core/exchange/atomic_file.h"
#include "core/exchange/label_image_writer.h"
#include "core/exchange/part_name.h"
#include "core/image/png_encoder.h"
#include "core/labeling/label_smoothing.h"
#include "core/segmentation/upsample_segments.h"

namespace scantrove {

FrameLabelWriter::FrameLabelWriter(std::filesystem::path folder, RegionNumbers& numbers)
    : folder_(std::move(folder)), numbers_(numbers), thread_([this] { run(); }) {}

FrameLabelWriter::~FrameLabelWriter() { close(); }

Result<void> FrameLabelWriter::add(Frame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting || !outcome_; });
  SCANTROVE_TRY(outcome_);
  waiting_.push_back(std::move(frame));
  changed_.notify_all();
  return {};
}

void FrameLabelWriter::close() {
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void FrameLabelWriter::run() {
  lowerThreadPriority(Niceness::label_writer);
  std::unique_lock lock(mutex_);
  while (outcome_) {
    changed_.wait(lock, [this] { return !waiting_.empty() || is_closed_; });
    if (waiting_.empty()) return;
    const Frame frame = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    const Result<void> done = guarded("writing the label images", [&] { return write(frame); });
    lock.lock();
    outcome_ = done;
  }
  changed_.notify_all();
}

Result<void> FrameLabelWriter::write(const Frame& frame) {
  const SegmentMap& segments = frame.segments;
  const cv::Size size = frame.depth.size();
  const DepthGuide guide{size.width,
                         size.height,
                         {frame.depth.ptr<std::uint16_t>(), frame.depth.total()},
                         frame.meters_per_unit};
  const DepthUpsampler upsampler(segments.depths_m, segments.width, segments.height, guide);
  const std::string name = labelFileName(frame.index);
  SCANTROVE_TRY(writeLabelImage(folder_ / "segments" / name, upsampler.apply(segments.ids), size));
  SCANTROVE_TRY(
      writeLabelImage(folder_ / "labels" / name, numbers_.numbersOf(upsampler.apply(frame.regions)), size));
  // A temporary name: if this process is killed, the next scan into the folder removes the file.
  const std::filesystem::path depth_file = makePartName(folder_ / "labels-final" / name);
  SCANTROVE_TRY(writeFileAtomically(depth_file, encodePng(frame.depth), Durability::process));
  written_.push_back({{frame.index, checksumOfDepth(frame.depth), frame.meters_per_unit},
                      depth_file,
                      frame.T_world_camera,
                      frame.intrinsics});
  return {};
}

Result<void> FrameLabelWriter::finish(const RenderView& render) {
  close();
  std::future<Result<void>> writing;  // of the previous frame: encoded while the next one is rendered
  FirstError outcome;
  outcome.note(outcome_);
  bool written = true;
  const auto wait = [&] {
    if (!writing.valid()) return;
    const Result<void> done = writing.get();
    written = written && done.has_value();
    outcome.note(done);
  };
  for (Written& frame : written_) {
    Result<RenderedView> view = render(frame.T_world_camera, frame.intrinsics);
    wait();
    if (!view) outcome.note(fail(view.error()));
    if (!view || !written) break;
    writing = std::async(std::launch::async, [this, &frame, view = std::move(*view)] {
      return guarded("writing the final label images", [&] { return writeFinal(frame, view); });
    });
  }
  wait();
  for (const Written& frame : written_) {
    std::error_code ignored;
    std::filesystem::remove(frame.depth_file, ignored);
  }
  return outcome.result();
}

void FrameLabelWriter::discard() {
  close();
  for (const Written& frame : std::exchange(written_, {})) {
    const std::string name = labelFileName(frame.image.frame_index);
    for (const std::filesystem::path& file :
         {folder_ / "segments" / name, folder_ / "labels" / name, frame.depth_file}) {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }
  }
}

FinalLabelRecord FrameLabelWriter::written() const {
  FinalLabelRecord record;
  for (const Written& frame : written_) {
    if (frame.has_final) record.push_back(frame.image);
  }
  return record;
}

Result<std::string> FrameLabelWriter::drawFinal(const std::filesystem::path& file, const RenderedView& view,
                                                const cv::Mat& depth, float meters_per_unit,
                                                RegionNumbers& numbers) {
  const DepthGuide guide{
      depth.cols, depth.rows, {depth.ptr<std::uint16_t>(), depth.total()}, meters_per_unit};
  const cv::Mat z_m = view.depth().z_m;
  const DepthUpsampler upsampler({z_m.ptr<float>(), z_m.total()}, view.K.width, view.K.height, guide);
  std::vector<RegionId> regions = view.regions;
  removeIsolatedLabels(view.K.width, regions);
  regions = upsampler.apply(regions);
  removeIsolatedLabels(depth.cols, regions);
  return encodeLabelImage(file, numbers.numbersOf(regions), depth.size());
}

Result<void> FrameLabelWriter::writeFinal(Written& frame, const RenderedView& view) {
  const Result<cv::Mat> depth = readLabelImage(frame.depth_file);
  if (!depth) return fail(depth.error());
  const std::filesystem::path file = folder_ / "labels-final" / labelFileName(frame.image.frame_index);
  const Result<std::string> bytes = drawFinal(file, view, *depth, frame.image.meters_per_unit, numbers_);
  if (!bytes) return fail(bytes.error());
  SCANTROVE_TRY(writeFileAtomically(file, *bytes, Durability::process));
  frame.image.checksum = crc32Of({bytes->data(), bytes->size()});
  frame.has_final = true;
  return {};
}

}  // namespace scantrove
