#pragma once
#include <memory>
#include <mutex>
#include <utility>

namespace scantrove {

/// A mailbox for one immutable value; a newer value replaces an uncollected one. The writer never waits for
/// the reader, and nothing queues up. Any thread may call any function.
template <class T>
class LatestValue {
 public:
  void post(std::shared_ptr<const T> value) {
    const std::scoped_lock lock(mutex_);
    value_ = std::move(value);
  }

  /// Takes the newest uncollected value; null if empty.
  [[nodiscard]] std::shared_ptr<const T> collect() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(value_, nullptr);
  }

  [[nodiscard]] bool empty() const {
    const std::scoped_lock lock(mutex_);
    return value_ == nullptr;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace scantrove
