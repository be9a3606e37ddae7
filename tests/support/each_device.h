#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/compute/compute_context.h"
#include "core/compute/device_choice.h"

namespace scantrove::test {

/// Runs `check(ComputeContext&)` on every OpenCL device of this machine (PoCL is enough; a GPU adds one).
template <class Check>
void onEachDevice(Check&& check) {
  const std::vector<DeviceInfo> devices = listDevices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (const DeviceInfo& device : devices) {
    SCOPED_TRACE(device.name);
    auto compute = ComputeContext::create({.device = std::to_string(device.index)});
    ASSERT_TRUE(compute) << compute.error().message();
    check(**compute);
  }
}

/// As onEachDevice(), with kernels for each number of lanes.
template <class Check>
void onEachWidth(Check&& check) {
  const std::vector<DeviceInfo> devices = listDevices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (const DeviceInfo& device : devices) {
    for (const int lanes : {1, 4, 8, 16}) {
      SCOPED_TRACE(device.name + ", " + std::to_string(lanes) + " lanes");
      auto compute = ComputeContext::create({.device = std::to_string(device.index), .lanes = lanes});
      ASSERT_TRUE(compute) << compute.error().message();
      ASSERT_EQ((*compute)->lanes().count(), lanes);
      check(**compute);
    }
  }
}

}  // namespace scantrove::test
