// Bad user input: missing, truncated, mixed and mistyped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "core/capture/oni_file.h"
#include "tests/support/captured_log.h"
#include "tests/support/oni_bytes.h"
#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Status = FrameRead::Status;

/// A PNG whose header claims this many pixels; the reader must not decode it to check.
std::string pngHeader(std::uint32_t width, std::uint32_t height) {
  std::string png = "\x89PNG\r\n\x1A\n" + std::string("\0\0\0\rIHDR", 8);
  for (const std::uint32_t number : {width, height}) {
    for (const int shift : {24, 16, 8, 0}) png += static_cast<char>(number >> shift);
  }
  return png + std::string("\x10\0\0\0\0", 5) + "sum." + std::string("\0\0\0\0IEND", 8) + "sum.";
}

TEST(BadInput, RefusesByHeader_WhenImagesAreTooLarge) {
  const TemporaryFolder folder;
  for (const auto& [width, height] :
       {std::pair{8000U, 8000U}, {4097U, 4096U}, {1U, 16'777'217U}, {0x7FFFFFFFU, 9U}}) {
    folder.write("depth/000000.png", pngHeader(width, height));
    EXPECT_THAT(openError(folder.path()),
                AllOf(HasSubstr("000000.png has " + std::to_string(width) + "x" + std::to_string(height)),
                      HasSubstr("up to 4096x4096")));
  }
  folder.write("depth/000000.png", pngHeader(4096, 4096));
  EXPECT_THAT(openError(folder.path()), HasSubstr("damaged"));  // large enough, but there are no pixels
}

TEST(BadInput, NamesThePath_WhenItIsMissing) {
  EXPECT_THAT(openError("/nowhere/recording"),
              AllOf(HasSubstr("/nowhere/recording"), HasSubstr("There is no")));
  EXPECT_THAT(openError(""), HasSubstr("No source"));
}

TEST(BadInput, ListsExpectedFiles_WhenTheFolderIsEmpty) {
  const TemporaryFolder folder;
  EXPECT_THAT(openError(folder.path()),
              AllOf(HasSubstr(folder.path().string()), HasSubstr("empty"), HasSubstr("7-Scenes"),
                    HasSubstr("depth.txt"), HasSubstr("depth/")));
}

TEST(BadInput, ListsExpectedFiles_WhenTheFolderHoldsOthers) {
  const TemporaryFolder folder;
  folder.write("notes.md", "hello");
  EXPECT_THAT(openError(folder.path()),
              AllOf(HasSubstr("not a recording in a supported format"), HasSubstr("7-Scenes")));
}

TEST(BadInput, RefusesAFile_WhenItsKindIsUnknown) {
  const TemporaryFolder folder;
  EXPECT_THAT(openError(folder.write("film.mp4", "x")), HasSubstr("film.mp4"));
}

/// Drops superuser rights, which allow reading everything, for its lifetime.
class WithoutPrivileges {
 public:
  WithoutPrivileges() {
    constexpr uid_t kNobody = 65534;
    if (was_root_ && seteuid(kNobody) != 0) throw std::runtime_error("cannot change the user");
  }
  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;
  ~WithoutPrivileges() {
    if (was_root_) {
      EXPECT_EQ(seteuid(0), 0);
    }
  }

 private:
  bool was_root_ = geteuid() == 0;
};

TEST(BadInput, ReportsPermission_WhenTheFolderIsUnreadable) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  for (const char* name : {"open", "closed"}) writeNumberedFolder(folder / name, 0, 1);
  constexpr fs::perms kForAll = fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                fs::perms::others_read | fs::perms::others_exec;
  for (const fs::path& open : {folder.path(), folder / "open"}) fs::permissions(open, kForAll);
  fs::permissions(folder / "closed", fs::perms::none);
  {
    const WithoutPrivileges unprivileged;
    EXPECT_THAT(openError(folder / "closed"), AllOf(HasSubstr("closed"), HasSubstr("ermission")));
    EXPECT_THAT(openError(folder / "open"), Not(HasSubstr("ermission"))) << "this one is readable";
  }
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(BadInput, NamesTheDepthFolder_WhenItIsEmpty) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "depth");
  std::filesystem::create_directories(folder / "color");
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("depth"), HasSubstr("no images")));
}

/// Ten frames, one of them damaged: nine are returned, one is skipped with its file named.
void expectOnlySkipped(const std::filesystem::path& folder, std::size_t position, const std::string& reason) {
  const auto source = openSource(folder.string(), {});
  ASSERT_TRUE(source) << source.error().message();
  testing::internal::CaptureStderr();
  const auto reads = readAll(**source);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
  ASSERT_EQ(reads.size(), 10U);
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].status, i == position ? Status::skipped : Status::frame) << i;
  }
  EXPECT_THAT(reads[position].error.what,
              AllOf(HasSubstr(numbered("%06d", static_cast<int>(position))), HasSubstr(reason)));
}

TEST(BadInput, SkipsTheFrame_WhenDepthIsTruncated) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  truncate(folder / "depth/000006.png", 0.7);
  expectOnlySkipped(folder.path(), 6, "truncated");
}

TEST(BadInput, SkipsTheFrame_WhenAJpegIsTruncated) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  std::filesystem::remove(folder / "color/000007.png");
  writeImage(folder / "color/000007.jpg", tinyColor(7));
  truncate(folder / "color/000007.jpg", 0.9);
  expectOnlySkipped(folder.path(), 7, "truncated");
}

TEST(BadInput, SkipsTheFrame_WhenAFileIsEmpty) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  truncate(folder / "depth/000009.png", 0);
  expectOnlySkipped(folder.path(), 9, "empty");
}

TEST(BadInput, SkipsTheFrame_WhenAnImageHoldsText) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  folder.write("depth/000005.png", "not an image at all");
  expectOnlySkipped(folder.path(), 5, "damaged");
}

/// Replaces a file by something that blocks forever when opened, or is no file.
void expectSkippedAs(const std::string& part, const std::string& reason,
                     const std::function<void(const std::filesystem::path&)>& make) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  const auto file = folder.path() / part / "000006.png";
  std::filesystem::remove(file);
  make(file);
  expectOnlySkipped(folder.path(), 6, reason);
}

TEST(BadInput, SkipsTheFrame_WhenAnImageIsNoRegularFile) {
  const auto makePipe = [](const auto& file) { ASSERT_EQ(mkfifo(file.c_str(), 0600), 0); };
  expectSkippedAs("depth", "is a pipe", makePipe);
  expectSkippedAs("color", "is a pipe", makePipe);
  expectSkippedAs("depth", "is a device",
                  [](const auto& file) { std::filesystem::create_symlink("/dev/zero", file); });
  expectSkippedAs("depth", "is a folder", [](const auto& file) { std::filesystem::create_directory(file); });
  expectSkippedAs("depth", "is a socket", [](const auto& file) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    ASSERT_LT(file.string().size(), sizeof address.sun_path);
    std::strcpy(address.sun_path, file.c_str());
    const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(listener);
  });
  expectSkippedAs("depth", "symbolic links",
                  [](const auto& file) { std::filesystem::create_symlink(file.filename(), file); });
}

TEST(BadInput, NamesTheFile_WhenSourceOrListIsAPipe) {
  const TemporaryFolder folder;
  const auto pipe = [&](const std::string& name) {
    std::filesystem::create_directories((folder / name).parent_path());
    EXPECT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    return folder / name;
  };
  EXPECT_THAT(openError(pipe("film.oni")), AllOf(HasSubstr("film.oni"), HasSubstr("is a pipe")));
  EXPECT_THAT(openError("camera:" + (folder / "film.oni").string()), HasSubstr("is a pipe"));
  EXPECT_THAT(openError(pipe("recording")), HasSubstr("recording"));
  const auto list = pipe("tum/depth.txt");
  EXPECT_THAT(openError(list.parent_path()), AllOf(HasSubstr("depth.txt"), HasSubstr("is a pipe")));
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_THAT(openError(folder / "loop"), AllOf(HasSubstr("loop"), HasSubstr("symbolic links")));
}

TEST(BadInput, NamesBothSizes_WhenADepthImageDiffers) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  writeImage(folder / "depth/000008.png", tinyDepth(1000, {32, 24}));
  expectOnlySkipped(folder.path(), 8, "is 32x24, the first frame 64x48");
}

TEST(BadInput, NamesBothSizes_WhenAColorImageDiffers) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  writeImage(folder / "color/000008.png", tinyColor(1, {32, 24}));
  expectOnlySkipped(folder.path(), 8, "is 32x24, the first frame 64x48");
}

TEST(BadInput, SkipsTheFirstFrame_WhenItIsUnusable) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  truncate(folder / "depth/000000.png", 0.5);
  expectOnlySkipped(folder.path(), 0, "truncated");
}

TEST(BadInput, SkipsTheFrame_WhenDepthHasEightBits) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 10);
  writeImage(folder / "depth/000006.png", cv::Mat(kTinyHeight, kTinyWidth, CV_8UC1, cv::Scalar(9)));
  expectOnlySkipped(folder.path(), 6, "8-bit with 1 channel");
}

TEST(BadInput, RefusesTheFolder_WhenDepthImagesAreColor) {
  const TemporaryFolder folder;
  writeImage(folder / "color/0.png", tinyColor(1));
  writeImage(folder / "depth/0.png", tinyColor(1));
  EXPECT_THAT(openError(folder.path()),
              AllOf(HasSubstr("depth/0.png"), HasSubstr("8-bit with 3 channels"), HasSubstr("16-bit")));
}

TEST(BadInput, RefusesTheFolder_WhenColorHasAnotherShape) {
  const TemporaryFolder folder;
  writeImage(folder / "color/0.png", tinyColor(1, {128, 72}));
  writeImage(folder / "depth/0.png", tinyDepth(1000));
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("128x72"), HasSubstr("64x48")));
}

TEST(BadInput, Fails_WhenTheFolderIsRemovedWhileReading) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder / "recording", 0, 20);
  const auto source = openSource((folder / "recording").string(), {});
  ASSERT_TRUE(source);
  ASSERT_EQ((*source)->next().status, Status::frame);
  std::filesystem::remove_all(folder / "recording");
  const auto reads = readAll(**source);
  ASSERT_FALSE(reads.empty());
  EXPECT_EQ(reads.back().status, Status::failed);
  EXPECT_THAT(reads.back().error.what, HasSubstr("gone"));
}

TEST(BadInput, RefusesOptions_WhenOutOfRange) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 4);
  const auto errorWith = [&](auto change) {
    SourceOptions options;
    change(options);
    return openError(folder.path(), options);
  };
  EXPECT_THAT(errorWith([](auto& o) { o.stride = 0; }), HasSubstr("--stride"));
  EXPECT_THAT(errorWith([](auto& o) { o.start = -1; }), HasSubstr("--start"));
  EXPECT_THAT(errorWith([](auto& o) { o.frames = 0; }), HasSubstr("--frames"));
  EXPECT_THAT(errorWith([](auto& o) { o.depth_scale = 0.0; }), HasSubstr("--depth-scale"));
  EXPECT_THAT(errorWith([](auto& o) { o.depth_scale = NAN; }), HasSubstr("--depth-scale"));
  EXPECT_THAT(errorWith([](auto& o) { o.start = 4; }), HasSubstr("has 4 frames"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{0, 525, 32, 24, 0, 0}; }),
              HasSubstr("--intrinsics"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{60, -60, 32, 24, 0, 0}; }),
              HasSubstr("positive"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{60, 60, 320, 24, 0, 0}; }),
              HasSubstr("far outside"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{60, 60, NAN, 24, 0, 0}; }),
              HasSubstr("finite"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{1e-9F, 1e-9F, 32, 24, 0, 0}; }),
              HasSubstr("180 degrees"));
  EXPECT_THAT(errorWith([](auto& o) { o.intrinsics = Intrinsics{60, 1e9F, 32, 24, 0, 0}; }),
              HasSubstr("degrees"));
  SourceOptions absurd;
  absurd.intrinsics = Intrinsics{1e-9F, 1e-9F, 320, 240, 0, 0};
  EXPECT_THAT(openError("demo", absurd), HasSubstr("180 degrees"));
}

TEST(BadInput, NamesTheCameraFile_WhenItIsBroken) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  folder.write("intrinsic.json", "{\"width\": 64}");
  EXPECT_THAT(openError(folder.path()), HasSubstr("intrinsic.json"));
  folder.write("camera-intrinsics.txt", "525 0 319.5\n0 525\n");
  EXPECT_THAT(openError(folder.path()), HasSubstr("camera-intrinsics.txt"));
  folder.write("camera-intrinsics.txt", "-525 0 32\n0 525 24\n0 0 1\n");
  EXPECT_THAT(openError(folder.path()), HasSubstr("positive"));
}

TEST(BadInput, WarnsOfDepthScale_WhenDepthsAreImplausible) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  for (const double scale : {10000.0, 100.0}) {  // 0.1 m and 10 m
    SourceOptions options;
    options.depth_scale = scale;
    options.intrinsics = Intrinsics{60, 60, 32, 24, 0, 0};
    const CapturedLog log;
    ASSERT_TRUE(openSource(folder.path().string(), options));
    EXPECT_THAT(log.text(), HasSubstr("--depth-scale")) << scale;
  }
}

TEST(BadInput, RefusesAnOniBeforeOpenNi_WhenItIsBroken) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& bytes) { return openError(folder.write("broken.oni", bytes)); };
  EXPECT_THAT(error("this is no recording"),
              AllOf(HasSubstr("broken.oni"), HasSubstr("no OpenNI2 recording")));
  EXPECT_THAT(error("NI10"), HasSubstr("truncated"));
  EXPECT_THAT(error("NI10" + std::string(200, 'x')), HasSubstr("damaged at byte 24"));
}

// OpenNI2's player indexes a table by a property name's letters as signed numbers, and trusts every length.
TEST(OniFile, IsRefused_WhenNamesOrLengthsWouldCrashOpenNi) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& bytes) {
    const auto checked = checkOniFile(folder.write("input.oni", bytes));
    return checked ? "" : checked.error().message();
  };
  const std::string sound = oniBytes();
  EXPECT_EQ(error(sound), "");
  EXPECT_THAT(error(oniBytes("Mirr\xEFr")), HasSubstr("damaged at byte"));
  EXPECT_THAT(error(oniBytes("")), HasSubstr("damaged at byte"));
  const auto ofSize = [](std::uint32_t width, std::uint32_t height) {
    return oniBytes("xnMapOutputMode", test::raw(width) + test::raw(height) + test::raw(std::uint32_t{30}));
  };
  EXPECT_EQ(error(ofSize(640, 480)), "");
  EXPECT_THAT(error(ofSize(30000, 30000)), HasSubstr("damaged at byte"))
      << "OpenNI2 would allocate gigabytes";
  const std::size_t name = sound.find("Mirror");
  for (const std::size_t length_at : {name - 4, name + 7}) {
    std::string changed = sound;
    changed.replace(length_at, 4, "\xFF\xFF\xFF\x7F");
    EXPECT_THAT(error(changed), HasSubstr("damaged at byte")) << length_at;
  }
  for (std::size_t size = 0; size < sound.size(); ++size) {
    EXPECT_NE(error(sound.substr(0, size)), "") << size;
  }
}

TEST(BadInput, RefusesATextBeforeReadingIt_WhenItIsTooLarge) {
  const TemporaryFolder folder;
  const auto file = folder.write("depth.txt", "0 depth/0.png\n");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30);  // sparse
  EXPECT_THAT(openError(folder.path()), AllOf(HasSubstr("depth.txt"), HasSubstr("512 MB")));
}

}  // namespace
}  // namespace scantrove
