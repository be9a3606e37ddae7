// Replaces freenect_source.cpp where libfreenect is not installed.
#include "core/capture/freenect_source.h"

namespace scantrove {

bool hasFreenect() { return false; }

Result<std::vector<CameraInfo>> listFreenectCameras() { return std::vector<CameraInfo>{}; }

Result<std::unique_ptr<FrameSource>> openFreenectCamera(const std::string& uri, const SourceOptions&) {
  return fail("Cannot open " + uri + ": this Scantrove was built without libfreenect.",
              "Install the package libfreenect-dev and build it again.");
}

}  // namespace scantrove
