#pragma once
#include <QThread>

namespace scantrove::test {

/// Introduces the thread that makes it to Qt before any other: Qt takes the first thread it meets for the
/// main one, and tidies up after it when the process ends, which must not be a worker that has ended long
/// before. A program does the same by making its application object first.
class QtMainThread {
 public:
  QtMainThread() : thread_(QThread::currentThread()) {}

 private:
  [[maybe_unused]] QThread* thread_;
};

}  // namespace scantrove::test
