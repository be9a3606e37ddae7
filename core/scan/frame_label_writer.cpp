#include "core/scan/frame_label_writer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <future>
#include <utility>

#include "core/exchange/label_image_writer.h"
#include "core/scan/guarded.h"
#include "core/segmentation/upsample_segments.h"

namespace scantrove {
namespace {

constexpr int kNiceness = 10;

constexpr int kFinalWriters = 2;  // nothing else runs by then

std::string fileName(int frame_index) {
  std::array<char, 24> name{};
  std::snprintf(name.data(), name.size(), "%06d.png", frame_index);
  return name.data();
}

}  // namespace

FrameLabelWriter::FrameLabelWriter(std::filesystem::path folder, RegionNumbers& numbers)
    : folder_(std::move(folder)), numbers_(numbers), thread_([this] { run(); }) {}

FrameLabelWriter::~FrameLabelWriter() { close(); }

Result<void> FrameLabelWriter::add(Frame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || !outcome_; });
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
  // The scan comes first: this thread takes what the frames leave idle. On Linux a thread has a priority of
  // its own.
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness));
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
                         frame.metres_per_unit};
  const DepthUpsampler upsampler(segments.depths_m, segments.width, segments.height, guide);
  const std::string name = fileName(frame.index);
  SCANTROVE_TRY(writeLabelImage(folder_ / "segments" / name, upsampler.apply(segments.ids), size));
  SCANTROVE_TRY(
      writeLabelImage(folder_ / "labels" / name, numbers_.numbersOf(upsampler.apply(frame.regions)), size));
  written_.push_back(name);
  return {};
}

Result<void> FrameLabelWriter::finish(const RegionTable&) {
  close();
  std::vector<std::uint32_t> final_numbers(numbers_.count());
  for (std::uint32_t number = 0; number < final_numbers.size(); ++number) {
    final_numbers[number] = number;
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&]() -> Result<void> {
    return guarded("writing the final label images", [&]() -> Result<void> {
      for (std::size_t i = next++; i < written_.size(); i = next++) {
        SCANTROVE_TRY(writeFinal(written_[i], final_numbers));
      }
      return {};
    });
  };
  std::vector<std::future<Result<void>>> writers;
  for (int i = 0; i < kFinalWriters; ++i) writers.push_back(std::async(std::launch::async, work));
  for (std::future<Result<void>>& writer : writers) {
    const Result<void> done = writer.get();
    if (outcome_) outcome_ = done;
  }
  return outcome_;
}

Result<void> FrameLabelWriter::writeFinal(const std::string& name,
                                          const std::vector<std::uint32_t>& final_numbers) const {
  const Result<cv::Mat> image = readLabelImage(folder_ / "labels" / name);
  if (!image) return fail(image.error());
  std::vector<std::uint32_t> labels;
  labels.reserve(image->total());
  for (const std::uint16_t number : cv::Mat_<std::uint16_t>(*image)) {
    if (number >= final_numbers.size()) {
      return fail("The label image " + (folder_ / "labels" / name).string() + " was changed during the scan.",
                  "Scan again into another folder.");
    }
    labels.push_back(final_numbers[number]);
  }
  return writeLabelImage(folder_ / "labels-final" / name, labels, image->size());
}

}  // namespace scantrove
