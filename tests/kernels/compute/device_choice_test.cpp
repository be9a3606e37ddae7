#include "core/compute/device_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace scantrove {
namespace {

using testing::HasSubstr;

std::string nameOf(const cl::Device& device) {
  std::string name = device.getInfo<CL_DEVICE_NAME>();
  while (!name.empty() && (name.back() == '\0' || name.back() == ' ')) name.pop_back();
  return name;
}

class DeviceChoiceTest : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("SCANTROVE_DEVICE");
    devices_ = listDevices();
    ASSERT_FALSE(devices_.empty()) << "no OpenCL device: install pocl-opencl-icd";
  }
  void TearDown() override { unsetenv("SCANTROVE_DEVICE"); }

  std::vector<DeviceInfo> devices_;
};

// No earlier test of this process may list devices, so this is the first call.
TEST(ListDevices, GivesEqualLists_WhenFirstCalledByManyThreads) {
  std::vector<std::size_t> found(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t& devices : found) threads.emplace_back([&devices] { devices = listDevices().size(); });
  }
  EXPECT_GT(found.front(), 0U);
  EXPECT_THAT(found, testing::Each(found.front()));
}

TEST_F(DeviceChoiceTest, ListsGpusFirstWithRunningIndices) {
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    EXPECT_EQ(devices_[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices_[i].name.empty());
    EXPECT_GT(devices_[i].compute_units, 0);
    EXPECT_GT(devices_[i].memory_mb, 0U);
  }
  EXPECT_TRUE(
      std::is_partitioned(devices_.begin(), devices_.end(), [](const DeviceInfo& d) { return d.is_gpu; }));
}

TEST_F(DeviceChoiceTest, TakesTheFirst_ByDefault) {
  EXPECT_EQ(nameOf(*chooseDevice("")), devices_.front().name);
}

TEST_F(DeviceChoiceTest, TakesAnIndexOrPartOfAName) {
  const DeviceInfo& last = devices_.back();
  EXPECT_EQ(nameOf(*chooseDevice(std::to_string(last.index))), last.name);
  std::string part = last.name.substr(last.name.size() / 2);
  std::transform(part.begin(), part.end(), part.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const auto chosen = chooseDevice(part);
  ASSERT_TRUE(chosen) << chosen.error().message();
  EXPECT_THAT(nameOf(*chosen), HasSubstr(last.name.substr(last.name.size() / 2)));
}

TEST_F(DeviceChoiceTest, UsesTheEnvironment_WhenNoDeviceIsRequested) {
  setenv("SCANTROVE_DEVICE", "no such device", 1);
  const auto chosen = chooseDevice("");
  ASSERT_FALSE(chosen);
  EXPECT_THAT(chosen.error().message(), HasSubstr("'no such device'"));
  EXPECT_TRUE(chooseDevice("0"));
}

TEST_F(DeviceChoiceTest, ListsDevices_WhenNoneMatches) {
  for (const std::string& requested : {std::string("warp drive"), std::string("99"), std::string("-1")}) {
    const auto chosen = chooseDevice(requested);
    ASSERT_FALSE(chosen) << requested;
    EXPECT_THAT(chosen.error().message(), HasSubstr("'" + requested + "'"));
    EXPECT_THAT(chosen.error().message(), HasSubstr(devices_.front().name));
  }
}

// PoCL's device for debugging can deadlock.
TEST(DeviceChoiceDeathTest, RefusesPoclsBasicDevice) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  setenv("POCL_DEVICES", "basic", 1);
  EXPECT_EXIT(
      {
        const auto first = chooseDevice("");
        const auto named = chooseDevice("basic");
        const auto numbered = chooseDevice("0");
        std::fprintf(stderr, "%s\n", first ? "a device" : first.error().message().c_str());
        std::exit(first || named || numbered ? 1 : 0);
      },
      testing::ExitedWithCode(0), "stops for ever.*unset POCL_DEVICES");
  setenv("POCL_DEVICES", "basic pthread", 1);
  EXPECT_EXIT(std::exit(chooseDevice("") ? 0 : 1), testing::ExitedWithCode(0), "");
  unsetenv("POCL_DEVICES");
}

TEST(DeviceChoiceDeathTest, NamesThePackage_WithoutAnyDriver) {
  // The OpenCL loader reads its driver folder once, so this needs a new process.
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  setenv("OCL_ICD_VENDORS", "/nonexistent-folder-of-drivers/", 1);
  EXPECT_EXIT(
      {
        const auto chosen = chooseDevice("");
        std::fprintf(stderr, "%s\n", chosen ? "a device" : chosen.error().message().c_str());
        std::exit(listDevices().empty() && !chosen ? 0 : 1);
      },
      testing::ExitedWithCode(0), "No OpenCL device found; OCL_ICD_VENDORS is set.*pocl-opencl-icd");
  unsetenv("OCL_ICD_VENDORS");
}

}  // namespace
}  // namespace scantrove
