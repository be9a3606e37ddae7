#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// Description of an OpenCL device for the user.
struct DeviceInfo {
  int index = 0;  ///< position in the list, as used by `--device`
  std::string name;
  std::string platform;
  std::string version;
  bool is_gpu = false;
  int compute_units = 0;
  std::size_t memory_mb = 0;
};

/// All OpenCL devices, GPUs first, then CPUs; empty when there is no driver at all.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

/// The device that `requested` selects, else SCANTROVE_DEVICE: a number = that index; else the first whose
/// name contains it (case-insensitive). Both empty: the first of the list (a GPU, else PoCL). Error: no
/// device at all (names the package to install) or none that matches (lists the available ones).
[[nodiscard]] Result<cl::Device> chooseDevice(const std::string& requested);

}  // namespace scantrove
