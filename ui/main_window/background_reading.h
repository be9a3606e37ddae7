#pragma once
#include <QFuture>
#include <QObject>
#include <QPromise>
#include <QThreadPool>
#include <memory>
#include <type_traits>
#include <utility>

namespace scantrove {

/// Calls `read` on another thread, then `use` with its result on the thread of `context`, which lives as long
/// as the window. What `use` needs besides may be gone by then: it checks that. `read` does not throw.
template <class Read, class Use>
void readInBackground(QObject* context, Read read, Use use) {
  using Value = std::invoke_result_t<Read>;
  const auto promise = std::make_shared<QPromise<Value>>();
  promise->start();
  QThreadPool::globalInstance()->start([promise, read = std::move(read)] {
    promise->addResult(read());
    promise->finish();
  });
  promise->future().then(context, std::move(use));
}

}  // namespace scantrove
