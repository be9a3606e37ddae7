// Camera diagnostics on simulated trees of /sys and /dev.
#include "core/capture/camera_diagnostics.h"

#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace fs = std::filesystem;

/// A simulated computer.
class Computer {
 public:
  Computer() { fs::permissions(root(), fs::perms::others_exec, fs::perm_options::add); }

  [[nodiscard]] fs::path root() const { return folder_.path(); }

  struct Plugged {
    std::string port = "1-2";
    std::string vendor, product;
    int number = 5;
    std::string speed = "480";
    std::string serial = {};
  };

  void plug(const Plugged& device, fs::perms node = fs::perms(0666)) const {
    const fs::path folder = devices() / device.port;
    fs::create_directories(folder);
    write(folder / "idVendor", device.vendor);
    write(folder / "idProduct", device.product);
    write(folder / "manufacturer", "Maker");
    write(folder / "product", "Thing");
    if (!device.serial.empty()) write(folder / "serial", device.serial);
    write(folder / "busnum", "1");
    write(folder / "devnum", std::to_string(device.number));
    write(folder / "speed", device.speed);
    fs::create_directories(bus());
    write(nodeOf(device.number), "");
    fs::permissions(nodeOf(device.number), node);
  }
  void bind(const std::string& interface, const std::string& driver, const std::string& module) const {
    const fs::path drivers = root() / "sys/bus/usb/drivers" / driver;
    const fs::path modules = root() / "sys/module" / module;
    fs::create_directories(drivers);
    fs::create_directories(devices() / interface);
    fs::create_symlink(drivers, devices() / interface / "driver");
    if (module.empty()) return;
    fs::create_directories(modules);
    fs::create_symlink(modules, drivers / "module");
  }
  void addVideoNode(const std::string& interface, int number, fs::perms node) const {
    const std::string name = "video" + std::to_string(number);
    fs::create_directories(devices() / interface);
    fs::create_directories(root() / "sys/class/video4linux" / name);
    fs::create_symlink(devices() / interface, root() / "sys/class/video4linux" / name / "device");
    write(root() / "dev" / name, "");
    fs::permissions(root() / "dev" / name, node);
  }
  [[nodiscard]] fs::path devices() const { return root() / "sys/bus/usb/devices"; }
  [[nodiscard]] fs::path bus() const { return root() / "dev/bus/usb/001"; }
  [[nodiscard]] fs::path nodeOf(int number) const {
    char name[8];
    std::snprintf(name, sizeof name, "%03d", number);
    return bus() / name;
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text << '\n'; }

 private:
  TemporaryFolder folder_;
};

const Computer::Plugged kKinect{.vendor = "045e", .product = "02ae", .serial = "A00362A17284043A"};
const Computer::Plugged kXtion{.vendor = "1d27", .product = "0601"};

std::string texts(const std::vector<Error>& errors) {
  std::string all;
  for (const Error& error : errors) all += error.message() + "\n";
  return all;
}

/// Runs `action` as an unprivileged user (root may open everything) and returns its result.
template <class Action>
std::string asNobody(Action action) {
  if (geteuid() != 0) return action();
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    std::string text = "(cannot become nobody)";
    if (setgroups(0, nullptr) == 0 && setresgid(kNobody, kNobody, kNobody) == 0 &&
        setresuid(kNobody, kNobody, kNobody) == 0) {
      text = action();
    }
    const bool is_written = write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(is_written ? 0 : 1);
  }
  close(ends[1]);
  std::string text;
  char part[4096];
  for (ssize_t size = 0; (size = read(ends[0], part, sizeof part)) > 0;) {
    text.append(part, static_cast<std::size_t>(size));
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return text;
}

std::string problemsFor(const Computer& computer) {
  return asNobody([&] {
    const auto found = examineCameras(computer.root(), true);
    return found.size() == 1 ? (found[0].may_be_opened ? "may: " : "may not: ") + texts(found[0].problems)
                             : std::to_string(found.size()) + " cameras";
  });
}

TEST(CameraDiagnostics, FindsNoProblem_WhenAKinectWorks) {
  const Computer computer;
  computer.plug(kKinect);
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].isWell()) << texts(found[0].problems);
  EXPECT_TRUE(found[0].is_served);
  EXPECT_TRUE(found[0].may_be_opened);
  EXPECT_THAT(found[0].remarks, IsEmpty());
  EXPECT_EQ(found[0].camera.name, "Kinect v1 (Xbox 360)");
  EXPECT_EQ(driverName(found[0].camera.driver), "libfreenect");
  EXPECT_EQ(found[0].node, "/dev/bus/usb/001/005");
  const UsbDevice& device = found[0].device;
  EXPECT_EQ(device.id(), "045e:02ae");
  EXPECT_EQ(device.port, "1-2");
  EXPECT_EQ(device.manufacturer, "Maker");
  EXPECT_EQ(device.name, "Thing");
  EXPECT_EQ(device.serial, "A00362A17284043A");
  EXPECT_EQ(device.bus, 1);
  EXPECT_EQ(device.number, 5);
  EXPECT_EQ(device.speed_mbps, 480);
}

TEST(CameraDiagnostics, NamesThePackage_WhenLibfreenectIsMissing) {
  const Computer computer;
  computer.plug(kKinect);
  const auto found = examineCameras(computer.root(), false);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].is_served);
  EXPECT_THAT(texts(found[0].problems), HasSubstr("apt-get install libfreenect-dev"));
}

TEST(CameraDiagnostics, NamesOpenNi2_WhenTheCameraIsAnXtion) {
  const Computer computer;
  computer.plug(kXtion);
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].isWell()) << texts(found[0].problems);
  EXPECT_EQ(driverName(found[0].camera.driver), "OpenNI2");
}

TEST(CameraDiagnostics, GivesTheUdevRule_WhenPermissionIsMissing) {
  const Computer computer;
  computer.plug(kXtion, fs::perms(0600));
  EXPECT_THAT(
      problemsFor(computer),
      AllOf(HasSubstr("may not: "), HasSubstr("may not open /dev/bus/usb/001/005: Permission denied"),
            HasSubstr("echo 'SUBSYSTEM==\"usb\", ATTR{idVendor}==\"1d27\", ATTR{idProduct}==\"0601\", "
                      "MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"' | sudo tee "
                      "/etc/udev/rules.d/60-camera-1d27-0601.rules && sudo udevadm control --reload && "
                      "sudo udevadm trigger")));
}

TEST(CameraDiagnostics, ReportsPermission_WhenTheNodeIsReadOnly) {
  const Computer computer;
  computer.plug(kXtion, fs::perms(0664));  // the kernel's own permissions
  EXPECT_THAT(problemsFor(computer), AllOf(HasSubstr("may not: "), HasSubstr("1d27")));
}

TEST(CameraDiagnostics, AdvisesTheGroup_WhenAGroupMayOpenTheNode) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file to another group";
  const group* const plugdev = getgrnam("plugdev");
  if (plugdev == nullptr) GTEST_SKIP() << "this computer has no group plugdev";
  const Computer computer;
  computer.plug(kXtion, fs::perms(0660));
  ASSERT_EQ(chown(computer.nodeOf(5).c_str(), 0, plugdev->gr_gid), 0);
  EXPECT_THAT(problemsFor(computer), HasSubstr("sudo adduser \"$USER\" plugdev"));
}

TEST(CameraDiagnostics, ReportsTheNode_WhenItIsMissing) {
  const Computer computer;
  computer.plug(kXtion);
  fs::remove(computer.nodeOf(5));
  EXPECT_THAT(problemsFor(computer), AllOf(HasSubstr("may not: "), HasSubstr("no /dev/bus/usb/001/005"),
                                           HasSubstr("--device /dev/bus/usb")));
}

TEST(CameraDiagnostics, NamesTheModule_WhenItHoldsTheKinect) {
  const Computer computer;
  computer.plug(kKinect);
  computer.bind("1-2:1.0", "kinect", "gspca_kinect");
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].device.modules, ElementsAre("gspca_kinect"));
  EXPECT_THAT(texts(found[0].remarks),
              AllOf(HasSubstr("sudo modprobe -r gspca_kinect"), HasSubstr("blacklist gspca_kinect")));
}

TEST(CameraDiagnostics, NamesTheDriver_WhenTheModuleIsBuiltIn) {
  const Computer computer;
  computer.plug(kKinect);
  computer.bind("1-2:1.0", "kinect", "");
  EXPECT_THAT(texts(examineCameras(computer.root(), true).at(0).remarks),
              HasSubstr("modprobe -r gspca_kinect"));
}

TEST(CameraDiagnostics, FindsNoProblem_WhenOtherModulesAreBound) {
  const Computer computer;
  computer.plug(kKinect);
  computer.bind("1-2:1.0", "usbfs", "usbcore");  // a program has it open
  computer.plug({.port = "1-3", .vendor = "046d", .product = "0825", .number = 6});
  computer.bind("1-3:1.0", "kinect", "gspca_kinect");  // another device
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].device.modules, ElementsAre("usbcore"));
  EXPECT_THAT(found[0].remarks, IsEmpty());
}

TEST(CameraDiagnostics, ReportsThePort_WhenItIsTooSlow) {
  const Computer computer;
  Computer::Plugged slow = kXtion;
  slow.speed = "12";
  computer.plug(slow);
  EXPECT_THAT(problemsFor(computer), AllOf(HasSubstr("may: It is connected at 12 Mbit/s and needs 480."),
                                           HasSubstr("USB 2 or 3 port")));
  slow.speed = "1.5";
  computer.plug(slow);
  EXPECT_THAT(problemsFor(computer), HasSubstr("1.5 Mbit/s"));
  slow.speed = "5000";
  computer.plug(slow);
  EXPECT_EQ(problemsFor(computer), "may: ");
}

TEST(CameraDiagnostics, AdvisesAlternatives_WhenDebianHasNoDriver) {
  const Computer computer;
  computer.plug({.port = "2-1", .vendor = "045e", .product = "02d8", .number = 2, .speed = "480"});
  computer.plug({.port = "2-2", .vendor = "2bc5", .product = "0401", .number = 3});
  computer.plug({.port = "2-3", .vendor = "8086", .product = "0b64", .number = 4});
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 3U);
  for (const CameraDiagnosis& camera : found) {
    EXPECT_FALSE(camera.isWell());
    EXPECT_FALSE(camera.is_served);
    EXPECT_EQ(driverName(camera.camera.driver), "none");
    EXPECT_THAT(texts(camera.problems), HasSubstr("Debian 12 has no driver"));
  }
  EXPECT_EQ(found[0].camera.name, "Kinect v2");
  EXPECT_THAT(texts(found[0].problems),
              AllOf(HasSubstr("libfreenect2"), HasSubstr("needs 5000"), HasSubstr("USB 3 port")));
  EXPECT_EQ(found[1].camera.name, "Orbbec camera");
  EXPECT_THAT(texts(found[1].problems), AllOf(HasSubstr("PNG"), HasSubstr("OpenNI2's folder of drivers")));
  EXPECT_EQ(found[2].camera.name, "RealSense L515");
  EXPECT_THAT(texts(found[2].problems), HasSubstr("RealSense Viewer"));
}

const Computer::Plugged kD435{.port = "2-3", .vendor = "8086", .product = "0b07", .speed = "5000"};

TEST(CameraDiagnostics, NamesV4l2_WhenTheCameraIsARealSense) {
  const Computer computer;
  computer.plug(kD435, fs::perms(0600));  // the kernel drives it: the USB device itself need not be open
  computer.addVideoNode("2-3:1.0", 2, fs::perms(0666));
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].isWell()) << texts(found[0].problems);
  EXPECT_TRUE(found[0].is_served);
  EXPECT_EQ(driverName(found[0].camera.driver), "V4L2");
  EXPECT_THAT(problemsFor(computer), "may: ");
}

TEST(CameraDiagnostics, GivesTheRuleOfVideoNodes_WhenPermissionIsMissing) {
  const Computer computer;
  computer.plug(kD435);
  computer.addVideoNode("2-3:1.0", 2, fs::perms(0666));
  computer.addVideoNode("2-3:1.3", 6, fs::perms(0600));
  EXPECT_THAT(problemsFor(computer),
              AllOf(HasSubstr("may not: "), HasSubstr("may not open /dev/video6: Permission denied"),
                    HasSubstr("SUBSYSTEM==\"video4linux\", ATTRS{idVendor}==\"8086\", "
                              "ATTRS{idProduct}==\"0b07\", MODE=\"0660\", GROUP=\"video\"")));
}

TEST(CameraDiagnostics, NamesTheKernelModule_WhenARealSenseHasNoNodes) {
  const Computer computer;
  computer.plug(kD435);
  EXPECT_THAT(problemsFor(computer), AllOf(HasSubstr("may not: "), HasSubstr("modprobe uvcvideo")));
}

TEST(CameraDiagnostics, ListsOnlyTheCamera_WhenAKinectHasSeveralDevices) {
  const Computer computer;
  computer.plug(kKinect);
  computer.plug({.port = "1-2.1", .vendor = "045e", .product = "02b0", .number = 6, .speed = "12"});
  computer.plug({.port = "1-2.3", .vendor = "045e", .product = "02ad", .number = 7});
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].device.id(), "045e:02ae");
}

TEST(CameraDiagnostics, ReportsThePowerSupply_WhenOnlyTheMotorAnswers) {
  const Computer computer;
  computer.plug({.vendor = "045e", .product = "02b0", .speed = "12"});
  EXPECT_THAT(problemsFor(computer), AllOf(HasSubstr("only its motor answers"), HasSubstr("power supply")));
}

TEST(CameraDiagnostics, ListsNothing_WhenDevicesAreNoCameras) {
  const Computer computer;
  computer.plug({.port = "1-1", .vendor = "046d", .product = "0825", .number = 2});  // a web camera
  computer.plug({.port = "1-2", .vendor = "045e", .product = "0745", .number = 3});  // a mouse of Microsoft's
  computer.plug({.port = "usb1", .vendor = "1d6b", .product = "0002", .number = 1});  // the root hub
  EXPECT_THAT(examineCameras(computer.root(), true), IsEmpty());
  EXPECT_EQ(readUsbDevices(computer.root()).size(), 3U);
}

TEST(CameraDiagnostics, ListsNothing_WhenThereIsNoUsbFolder) {
  const Computer computer;
  EXPECT_THAT(examineCameras(computer.root(), true), IsEmpty());
  fs::create_directories(computer.devices());
  EXPECT_THAT(examineCameras(computer.root(), true), IsEmpty());
  EXPECT_THAT(examineCameras(computer.root() / "nowhere", true), IsEmpty());
}

TEST(CameraDiagnostics, KeepsOtherValues_WhenFilesAreUnreadable) {
  const Computer computer;
  computer.plug(kXtion);
  const fs::path folder = computer.devices() / "1-2";
  for (const char* name : {"speed", "manufacturer", "product"}) {
    fs::remove(folder / name);
    fs::create_directory(folder / name);  // can be opened but not read, even by root
  }
  const auto found = examineCameras(computer.root(), true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].isWell()) << texts(found[0].problems);
  EXPECT_EQ(found[0].device.speed_mbps, 0);
  EXPECT_EQ(found[0].device.name, "");

  Computer::write(folder / "devnum", "many");
  const auto lost = examineCameras(computer.root(), true);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].node, "");
  EXPECT_THAT(texts(lost[0].problems), HasSubstr("/sys/bus/usb/devices/1-2"));

  Computer::write(folder / "idVendor", "1d27 and more");
  EXPECT_THAT(examineCameras(computer.root(), true), IsEmpty());
  fs::remove(folder / "idVendor");
  EXPECT_THAT(examineCameras(computer.root(), true), IsEmpty());
}

}  // namespace
}  // namespace scantrove
