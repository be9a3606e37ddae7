#include "core/capture/read_ahead.h"

#include <chrono>
#include <exception>
#include <utility>

#include "core/base/check.h"

namespace scantrove {

namespace {

using Status = FrameRead::Status;

constexpr std::chrono::seconds kLiveWait{1};

bool isLast(const FrameRead& read) { return read.status == Status::end || read.status == Status::failed; }

FrameRead readSafely(FrameSource& source) {
  FrameRead failed;
  failed.status = Status::failed;
  try {
    return source.next();
  } catch (const std::exception& exception) {
    failed.error = {"Reading " + source.info().name + " failed: " + exception.what() + ".", {}};
  } catch (...) {
    failed.error = {"Reading " + source.info().name + " failed.", {}};
  }
  return failed;
}

}  // namespace

ReadAhead::ReadAhead(std::unique_ptr<FrameSource> source, std::size_t capacity, std::optional<int> live_limit)
    : source_(std::move(source)), info_(source_->info()), capacity_(capacity), live_limit_(live_limit) {
  SCANTROVE_CHECK(capacity_ > 0);
  thread_ = std::jthread([this](const std::stop_token& stop) { readAll(stop); });
}

ReadAhead::~ReadAhead() { cancel(); }

void ReadAhead::cancel() {
  {
    const std::scoped_lock lock(mutex_);
    is_cancelled_ = true;
    queue_.clear();
  }
  thread_.request_stop();
  changed_.notify_all();
}

FrameRead ReadAhead::next() {
  std::unique_lock lock(mutex_);
  const auto has_result = [this] { return is_cancelled_ || is_over_ || !queue_.empty(); };
  if (!info_.is_live) {
    changed_.wait(lock, has_result);
  } else if (!changed_.wait_for(lock, kLiveWait, has_result)) {
    // A camera that is being opened again may take long; its scan can be stopped meanwhile.
    FrameRead read;
    read.status = Status::timeout;
    return read;
  }
  if (is_cancelled_ || is_over_) {
    return {};
  }
  FrameRead read = takeFirst();
  lock.unlock();
  changed_.notify_all();
  return read;
}

std::optional<FrameRead> ReadAhead::nextIfReady() {
  std::unique_lock lock(mutex_);
  if (is_cancelled_ || is_over_ || queue_.empty()) {
    return std::nullopt;
  }
  FrameRead read = takeFirst();
  lock.unlock();
  changed_.notify_all();
  return read;
}

FrameRead ReadAhead::takeFirst() {
  FrameRead read = std::move(queue_.front());
  queue_.pop_front();
  if (info_.is_live && read.status == Status::frame) {
    ++taken_;
  }
  is_over_ = isLast(read) || (live_limit_ && taken_ >= *live_limit_);
  return read;
}

void ReadAhead::readAll(const std::stop_token& stop) {
  bool is_last = false;
  while (!is_last && !stop.stop_requested()) {
    FrameRead read = readSafely(*source_);
    is_last = isLast(read);
    if (info_.is_live) {
      postLive(std::move(read));
    } else {
      postRecorded(std::move(read), stop);
    }
  }
}

void ReadAhead::postRecorded(FrameRead read, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (changed_.wait(lock, stop, [this] { return queue_.size() < capacity_; }) && !is_cancelled_) {
    queue_.push_back(std::move(read));
  }
  lock.unlock();
  changed_.notify_all();
}

void ReadAhead::postLive(FrameRead read) {
  {
    const std::scoped_lock lock(mutex_);
    if (is_cancelled_ || (read.status == Status::timeout && !queue_.empty())) {
      return;
    }
    if (read.status == Status::frame || read.status == Status::skipped) {
      for (const FrameRead& older : queue_) {
        read.dropped += older.dropped + (older.status == Status::timeout ? 0 : 1);
        read.is_reconnected = read.is_reconnected || older.is_reconnected;
      }
      queue_.clear();
    }
    queue_.push_back(std::move(read));
  }
  changed_.notify_all();
}

}  // namespace scantrove
