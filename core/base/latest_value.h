#pragma once
#include <memory>
#include <mutex>
#include <utility>

namespace scantrove {

/// A mailbox for one immutable value: a newer one replaces what was not collected. The writer never waits
/// for the reader, and nothing queues up. Any thread may call anything.
template <class T>
class LatestValue {
 public:
  void post(std::shared_ptr<const T> value) {
    const std::scoped_lock lock(mutex_);
    value_ = std::move(value);
  }

  /// The newest value not yet collected, or null. Empties the box.
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
