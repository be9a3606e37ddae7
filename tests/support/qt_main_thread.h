#pragma once
#include <QThread>

namespace scantrove::test {

/// Makes the current thread Qt's main thread. Qt takes the first thread that uses it for the main one and
/// cleans up for it at the end of the process; that must not be an ended worker. Programs make their
/// application object first instead.
class QtMainThread {
 public:
  QtMainThread() : thread_(QThread::currentThread()) {}

 private:
  [[maybe_unused]] QThread* thread_;
};

}  // namespace scantrove::test
