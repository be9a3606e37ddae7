// The stream of Record3D from a stand-in for usbmuxd, through Debian's libusbmuxd. Not tested with a phone.
#include "core/capture/live/record3d_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "core/capture/color_registration.h"
#include "core/capture/open_input.h"
#include "tests/support/played_usbmuxd.h"
#include "tests/support/record3d_bytes.h"

namespace scantrove {
namespace {

using namespace test;
using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using Status = FrameRead::Status;

constexpr const char* kAddress = "USBMUXD_SOCKET_ADDRESS";
constexpr const char* kUdid = "00008101-000A1D2E3C40001E";

/// A phone whose stream the test gives out, in usbmuxd's place for one test.
class PhoneOnUsb {
 public:
  explicit PhoneOnUsb(int answer = PlayedUsbmuxd::kDone)
      : service({kUdid}, answer, [this](const PlayedUsbmuxd::Send& send) {
          for (auto bytes = stream_.next(); bytes && send(*bytes);) bytes = stream_.next();
        }) {
    setenv(kAddress, service.address().c_str(), 1);
  }
  PhoneOnUsb(const PhoneOnUsb&) = delete;
  PhoneOnUsb& operator=(const PhoneOnUsb&) = delete;
  ~PhoneOnUsb() {
    stream_.end();
    unsetenv(kAddress);
  }

  void send(const std::string& bytes) { stream_.push(bytes); }
  void send(const Record3dBytes& frame) { stream_.push(frame.bytes()); }
  void endConnection() { stream_.end(); }

 private:
  PlayedBytes stream_;

 public:
  PlayedUsbmuxd service;
};

/// Opens the stream with an ordinary first frame.
Result<std::unique_ptr<FrameSource>> openAfterOneFrame(PhoneOnUsb& phone, const SourceOptions& options = {}) {
  phone.send(Record3dBytes());
  return openInput("record3d", options);
}

std::string refusal(const std::string& uri = "record3d", const SourceOptions& options = {}) {
  const auto source = openInput(uri, options);
  return source ? "(opened)" : source.error().message();
}

TEST(Record3dStream, DescribesThePhone) {
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.name, std::string("iPhone ") + kUdid);
  EXPECT_EQ(info.kind, "Record3D phone");
  EXPECT_TRUE(info.is_live);
  EXPECT_TRUE(info.has_poses);
  EXPECT_EQ(info.pose_origin, PoseOrigin::device);
  EXPECT_EQ(phone.service.port(), 1337);
  // Half as many pixels: the centre (3.5, 2.5) stays in the middle.
  EXPECT_EQ(info.intrinsics, (Intrinsics{4, 4, 1.5F, 1, 4, 3}));
}

TEST(Record3dStream, DecodesEachFrame) {
  Record3dBytes sent;
  const cv::Mat picture(6, 8, CV_8UC3, cv::Scalar(40, 80, 200));
  std::vector<std::uint8_t> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 100}));
  sent.color.assign(jpeg.begin(), jpeg.end());
  sent.depth_m = {0.5F, 1, 2, 3, 4, 5, std::numeric_limits<float>::quiet_NaN(), 0, -1, 1.25F, 1.5F, 40};
  sent.confidence = std::string("\0\1\2\2\2\2\2\2\2\2\2\2", 12);
  sent.intrinsics = {10, 12, 3.5F, 2.5F};  // autofocus
  const float half = std::sqrt(0.5F);
  sent.pose = {0, half, 0, half, 1, 2, 3};  // 90 degrees about y
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  phone.send(sent);
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  const RgbdFrame& frame = read.frame;
  EXPECT_EQ(frame.index, 0);
  EXPECT_GE(frame.timestamp_s, 0);
  EXPECT_LT(frame.timestamp_s, 100);
  ASSERT_EQ(frame.depth.size(), cv::Size(4, 3));
  EXPECT_FLOAT_EQ(frame.meters_per_unit, 0.00025F);
  EXPECT_EQ(frame.depth.at<std::uint16_t>(0, 0), 2000);  // 0.5 m
  EXPECT_EQ(frame.depth.at<std::uint16_t>(1, 2), 0);     // NaN
  EXPECT_EQ(frame.depth.at<std::uint16_t>(2, 0), 0);     // negative
  EXPECT_EQ(frame.depth.at<std::uint16_t>(2, 1), 5000);  // 1.25 m
  EXPECT_EQ(frame.depth.at<std::uint16_t>(2, 3), 0);     // 40 m: too far for 16 bits
  EXPECT_EQ(frame.confidence.at<std::uint8_t>(0, 0), kLowConfidence);
  EXPECT_EQ(frame.confidence.at<std::uint8_t>(2, 3), kHighConfidence);
  ASSERT_EQ(frame.color.size(), cv::Size(8, 6));
  EXPECT_NEAR(frame.color.at<cv::Vec3b>(3, 4)[0], 40, 4);
  EXPECT_NEAR(frame.color.at<cv::Vec3b>(3, 4)[2], 200, 4);
  EXPECT_FALSE(frame.color_camera);  // registered
  ASSERT_TRUE(frame.intrinsics);
  EXPECT_EQ(*frame.intrinsics, (Intrinsics{5, 6, 1.5F, 1, 4, 3}));
  ASSERT_TRUE(frame.T_world_camera);
  EXPECT_TRUE(frame.T_world_camera->translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  // ARKit's camera looks along its -z, which the rotation turns to -x of the world; ours looks along +z.
  EXPECT_TRUE(frame.T_world_camera->linear().col(2).isApprox(Eigen::Vector3d(-1, 0, 0), 1e-6));
  EXPECT_TRUE(frame.T_world_camera->linear().col(1).isApprox(Eigen::Vector3d(0, -1, 0), 1e-6));
}

TEST(Record3dStream, ReturnsTheNewestFrame_WhenSeveralWait) {
  std::string burst;
  for (int i = 0; i < 5; ++i) {
    Record3dBytes sent;
    sent.depth_m.assign(12, 1.0F + static_cast<float>(i));
    burst += sent.bytes();
  }
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  phone.send(burst);  // one write: the bytes arrive together
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  EXPECT_EQ(read.dropped, 4);
  EXPECT_EQ(read.frame.index, 4);
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(0, 0), 20000);
}

TEST(Record3dStream, LeavesPosesOut_WhenTheCameraForFacesStreams) {
  Record3dBytes sent;
  sent.device = 0;
  PhoneOnUsb phone;
  phone.send(sent);
  const auto source = openInput("record3d", {});
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_FALSE((*source)->info().has_poses);
}

TEST(Record3dStream, UsesIntrinsicsAndScale_WhenOptionsAreGiven) {
  SourceOptions options;
  options.intrinsics = Intrinsics{5, 5, 1.5F, 1, 0, 0};
  options.depth_scale = 2;
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone, options);
  ASSERT_TRUE(source) << source.error().message();
  phone.send(Record3dBytes());
  EXPECT_EQ((*source)->info().intrinsics, (Intrinsics{5, 5, 1.5F, 1, 4, 3}));
  const FrameRead read = (*source)->next();
  ASSERT_EQ(read.status, Status::frame) << read.error.message();
  EXPECT_EQ(*read.frame.intrinsics, (Intrinsics{5, 5, 1.5F, 1, 4, 3}));
  EXPECT_EQ(read.frame.depth.at<std::uint16_t>(0, 0), 3000);  // 1.5 halves of a metre
}

TEST(Record3dStream, TimesOutWithinASecond_WhenThePhoneIsSilent) {
  PhoneOnUsb phone;
  phone.send(Record3dBytes().bytes() + "\1");  // and the start of a header
  const auto source = openInput("record3d", {});
  ASSERT_TRUE(source) << source.error().message();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ((*source)->next().status, Status::timeout);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 900ms);
}

TEST(Record3dStream, Fails_WhenTheConnectionIsLost) {
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  const std::string frame = Record3dBytes().bytes();
  phone.send(frame + frame.substr(0, 60));
  phone.endConnection();
  EXPECT_EQ((*source)->next().status, Status::frame);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::failed);
  EXPECT_EQ(read.error.message(),
            std::string("iPhone ") + kUdid +
                " does not answer any more: the connection was ended. Keep Record3D open and "
                "streaming, then open the phone again.");
}

TEST(Record3dStream, SkipsAFrame_WhenItIsTruncatedOrDamaged) {
  const std::string message = Record3dBytes().message();
  Record3dBytes bad_color, bad_depth;
  bad_color.color = "no image";
  bad_depth.depth_m.assign(11, 1.0F);  // one too few
  const std::vector<std::pair<std::string, std::string>> damaged{
      {Record3dBytes::peerTalk(""), "truncated"},
      {Record3dBytes::peerTalk(message.substr(0, 80)), "truncated"},
      {Record3dBytes::peerTalk(message.substr(0, message.size() - 1)), "truncated"},
      {bad_color.bytes(), "colour image of Frame 3"},
      {bad_depth.bytes(), "depth of Frame 4"}};
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  for (const auto& [bytes, reason] : damaged) {
    phone.send(bytes);
    const FrameRead read = (*source)->next();
    EXPECT_EQ(read.status, Status::skipped);
    EXPECT_THAT(read.error.what, AllOf(HasSubstr(reason), HasSubstr(kUdid)));
  }
  phone.send(Record3dBytes());
  EXPECT_EQ((*source)->next().status, Status::frame);
}

TEST(Record3dStream, Fails_WhenAFrameIsTooLarge) {
  std::string huge = Record3dBytes().bytes();
  huge.replace(12, 4, "\x7f\xff\xff\xff");
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  phone.send(huge);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::failed);
  EXPECT_THAT(read.error.what, HasSubstr("2147483647 bytes"));
}

TEST(Record3dStream, Fails_WhenTheImagesChangeTheirSize) {
  Record3dBytes larger;
  larger.depth_width = 8;
  larger.depth_height = 6;
  PhoneOnUsb phone;
  const auto source = openAfterOneFrame(phone);
  ASSERT_TRUE(source) << source.error().message();
  phone.send(larger);
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, Status::failed);
  EXPECT_THAT(read.error.message(), AllOf(HasSubstr("8x6"), HasSubstr("Open it again")));
}

TEST(Record3dStream, GivesAdvice_WhenTheAppDoesNotStream) {
  {
    const PhoneOnUsb phone(PlayedUsbmuxd::kNobodyListens);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(kUdid), HasSubstr("does not stream"), HasSubstr("USB streaming")));
  }
  {
    const PhoneOnUsb phone(PlayedUsbmuxd::kNoSuchPhone);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(kUdid), HasSubstr("is gone")));
  }
  {
    const PhoneOnUsb phone;  // connects and sends nothing
    EXPECT_THAT(refusal(), HasSubstr("sends no frames"));
  }
  {
    PhoneOnUsb phone;
    phone.endConnection();
    EXPECT_THAT(refusal(), HasSubstr("the connection was ended"));
  }
}

TEST(Record3dStream, GivesAdvice_WhenThereIsNoPhone) {
  const PlayedUsbmuxd service({});
  setenv(kAddress, service.address().c_str(), 1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("No iPhone or iPad was found"), HasSubstr("trust this computer")));
  EXPECT_THAT(listRecord3dPhones(), IsEmpty());
  unsetenv(kAddress);
}

TEST(Record3dStream, GivesAdvice_WhenTheServiceIsMissing) {
  const TemporaryFolder folder;
  setenv(kAddress, ("UNIX:" + (folder / "nothing").string()).c_str(), 1);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("usbmuxd"), HasSubstr("apt-get install usbmuxd")));
  EXPECT_THAT(listRecord3dPhones(), IsEmpty());
  unsetenv(kAddress);
}

TEST(Record3dStream, SelectsByUdid) {
  PhoneOnUsb phone;
  phone.send(Record3dBytes());
  EXPECT_THAT(refusal("record3d:other"), HasSubstr("No iPhone or iPad other"));
  EXPECT_EQ(refusal("camera:record3d:" + std::string(kUdid)), "(opened)");
  const auto cameras = listRecord3dPhones();
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].uri, std::string("record3d:") + kUdid);
  EXPECT_EQ(cameras[0].driver, "usbmuxd");
}

TEST(Record3dStream, RefusesImages_WhenColorAndDepthHaveAnotherShape) {
  Record3dBytes sent;
  sent.depth_width = 3;
  sent.depth_height = 4;
  PhoneOnUsb phone;
  phone.send(sent);
  EXPECT_THAT(refusal(), AllOf(HasSubstr("8x6"), HasSubstr("3x4")));
}

TEST(Record3dStream, RecognizesSourceNames) {
  for (const char* name : {"record3d", "record3d:0000"}) EXPECT_TRUE(isCameraName(name)) << name;
  for (const char* name : {"record3d.r3d", "record3", "./record3d"}) EXPECT_FALSE(isCameraName(name)) << name;
}

TEST(Record3dMessages, JoinsPartsOfAMessage) {
  const std::string first = Record3dBytes::peerTalk("one"), second = Record3dBytes::peerTalk("message two");
  const std::string stream = first + second;
  Record3dMessages messages;
  std::vector<std::string> found;
  for (const char byte : stream) {
    messages.add({&byte, 1});
    const auto next = messages.next();
    ASSERT_TRUE(next) << next.error().message();
    if (*next) found.push_back(**next);
  }
  EXPECT_THAT(found, testing::ElementsAre("one", "message two"));
}

TEST(Record3dMessage, RefusesSizes_WhenTheyAreImpossible) {
  Record3dBytes sent;
  const std::string message = sent.message();
  const auto withNumber = [&](std::size_t index, std::uint64_t value) {
    std::string changed = message;
    changed.replace(4 * index, 4, littleEndianBytes(value, 4));
    return decodeRecord3dMessage(changed, "a frame");
  };
  for (const std::uint64_t side :
       {std::uint64_t{0}, std::uint64_t{5}, std::uint64_t{100'000}, std::uint64_t{0xFFFFFFFF}}) {
    const auto decoded = withNumber(2, side);  // width of depth
    EXPECT_FALSE(decoded) << side;
  }
  for (const std::size_t index : {6U, 7U, 8U, 9U}) EXPECT_FALSE(withNumber(index, 0xFFFFFFFF)) << index;
  for (std::size_t bytes = 0; bytes < message.size(); ++bytes)
    EXPECT_FALSE(decodeRecord3dMessage(message.substr(0, bytes), "a frame")) << bytes;
  EXPECT_TRUE(decodeRecord3dMessage(message, "a frame"));
}

}  // namespace
}  // namespace scantrove
