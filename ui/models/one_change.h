#pragma once
#include <QUuid>
#include <functional>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/catalogue/object_database.h"

namespace scantrove {

/// `change` as one transaction: a failure in the middle of it changes nothing.
[[nodiscard]] inline std::function<Result<void>(ObjectDatabase&)> asOneChange(
    std::function<Result<void>(ObjectDatabase&)> change) {
  return [change = std::move(change)](ObjectDatabase& database) -> Result<void> {
    const std::string token = QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString();
    const Result<std::string> done =
        database.applyOnce(token, [&] { return change(database).map([] { return std::string(); }); });
    if (!done) return fail(done.error());
    return {};
  };
}

}  // namespace scantrove
