#include "core/compute/device_threads.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

namespace scantrove {
namespace {

constexpr const char* kVariable = "POCL_AFFINITY";

std::optional<std::string> affinity() {
  const char* value = std::getenv(kVariable);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

/// Restores the environment.
class DeviceThreadsTest : public testing::Test {
 protected:
  void SetUp() override {
    before_ = affinity();
    ::unsetenv(kVariable);
  }
  void TearDown() override { before_ ? ::setenv(kVariable, before_->c_str(), 1) : ::unsetenv(kVariable); }

 private:
  std::optional<std::string> before_;
};

bool mayUseEveryCore() {
  cpu_set_t usable;
  CPU_ZERO(&usable);
  return ::sched_getaffinity(0, sizeof(usable), &usable) == 0 &&
         CPU_COUNT(&usable) == ::sysconf(_SC_NPROCESSORS_CONF);
}

TEST_F(DeviceThreadsTest, ArePinned_WhenAllCoresAreUsable) {
  if (!mayUseEveryCore()) GTEST_SKIP() << "this program may not use every core";
  pinDeviceThreads();
  EXPECT_EQ(affinity(), "1");
}

TEST_F(DeviceThreadsTest, KeepTheSettingOfTheEnvironment) {
  ::setenv(kVariable, "0", 1);
  pinDeviceThreads();
  EXPECT_EQ(affinity(), "0");
}

// PoCL would pin threads to forbidden cores and end the program.
TEST_F(DeviceThreadsTest, AreNotPinned_WhenSomeCoresAreForbidden) {
  if (!mayUseEveryCore()) GTEST_SKIP() << "this program may not use every core";
  if (::sysconf(_SC_NPROCESSORS_CONF) < 2) GTEST_SKIP() << "this computer has one core";
  std::thread([] {
    cpu_set_t last;
    CPU_ZERO(&last);
    CPU_SET(static_cast<std::size_t>(::sysconf(_SC_NPROCESSORS_CONF) - 1), &last);
    ASSERT_EQ(::sched_setaffinity(0, sizeof(last), &last), 0);
    pinDeviceThreads();
  }).join();
  EXPECT_EQ(affinity(), std::nullopt);
}

}  // namespace
}  // namespace scantrove
