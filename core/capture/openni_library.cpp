#include "core/capture/openni_library.h"

#include <OpenNI.h>

#include <algorithm>
#include <mutex>

namespace scantrove {

std::string openNiError() {
  std::string text = openni::OpenNI::getExtendedError();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
    text.pop_back();
  }
  return text.empty() ? "no reason given" : text;
}

Result<void> initializeOpenNi() {
  static std::mutex mutex;
  static bool is_ready = false;
  const std::scoped_lock lock(mutex);
  if (is_ready) {
    return {};
  }
  openni::OpenNI::setLogConsoleOutput(false);
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    return fail("OpenNI2 cannot start: " + openNiError() + ".",
                "Check that the package libopenni2-0 and its drivers are installed.");
  }
  is_ready = true;
  return {};
}

}  // namespace scantrove
