#include "core/compute/lanes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

namespace scantrove {
namespace {

constexpr std::array kWidths = {16, 8, 4, 1};

int widthOf(const cl::Device& device) {
  if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) == 0) return 1;
  const cl_uint floats = std::max(device.getInfo<CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT>(),
                                  device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  return *std::ranges::find_if(kWidths, [&](int width) { return width == 1 || cl_uint(width) <= floats; });
}

bool isWidth(int lanes) { return std::ranges::find(kWidths, lanes) != kWidths.end(); }

}  // namespace

Result<Lanes> Lanes::choose(const cl::Device& device, int requested) {
  std::string given = std::to_string(requested);
  if (requested == 0) {
    const char* from_environment = std::getenv("SCANTROVE_LANES");
    if (from_environment == nullptr || *from_environment == '\0') return Lanes(widthOf(device));
    given = from_environment;
    const auto [end, failure] = std::from_chars(given.data(), given.data() + given.size(), requested);
    if (failure != std::errc{} || end != given.data() + given.size()) requested = 0;
  }
  if (!isWidth(requested)) {
    return fail("Kernels cannot do '" + given + "' values at a time.",
                "SCANTROVE_LANES is 1, 4, 8 or 16; without it the device's own width is taken.");
  }
  return Lanes(requested);
}

}  // namespace scantrove
