#pragma once
#include <linux/usb/video.h>
#include <linux/uvcvideo.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <map>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/capture/live/video_system.h"
#include "tests/support/realsense_bytes.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// A video node that plays images.
struct PlayedNode {
  struct Image {
    std::string bytes;
    double time_s = 0;
    std::uint32_t flags = 0;
  };

  std::vector<std::uint32_t> formats;
  std::vector<cv::Size> sizes{{640, 480}, {848, 480}};  ///< another size becomes the first
  std::deque<Image> images;
  std::map<std::uint32_t, std::string> tables;  ///< calibration by number; empty: without the extension unit
  int open_error = 0, format_error = 0, buffers_error = 0, start_error = 0;
  int error_after_images = 0;
};

/// Video nodes by their path, down to the kernel's requests.
class FakeVideoSystem final : public VideoSystem {
 public:
  std::map<std::filesystem::path, PlayedNode> nodes;
  int open_count = 0;    ///< descriptors
  int mapped_count = 0;  ///< buffers
  std::uint32_t asked_rate = 0;

  int open(const std::filesystem::path& path) override {
    const auto node = nodes.find(path);
    if (node == nodes.end()) return -ENOENT;
    if (node->second.open_error != 0) return -node->second.open_error;
    ++open_count;
    opened_.push_back({&node->second});
    return kFirst + static_cast<int>(opened_.size()) - 1;
  }
  void close(int) override { --open_count; }

  int control(int descriptor, unsigned long request, void* argument) override {
    Opened& file = fileOf(descriptor);
    switch (request) {
      case VIDIOC_QUERYCAP:
        return describe(file, *static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return enumerate(file, *static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_S_FMT:
        return setFormat(file, *static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        asked_rate = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe.denominator;
        return 0;
      case VIDIOC_REQBUFS:
        if (file.node->buffers_error != 0) return -file.node->buffers_error;
        file.buffers.assign(static_cast<v4l2_requestbuffers*>(argument)->count,
                            std::string(file.bytes, '\0'));
        return 0;
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = file.bytes;
        buffer.m.offset = buffer.index;
        return 0;
      }
      case VIDIOC_QBUF:
        file.queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_STREAMON:
        return -file.node->start_error;
      case VIDIOC_STREAMOFF:
        return 0;
      case VIDIOC_DQBUF:
        return play(file, *static_cast<v4l2_buffer*>(argument));
      case UVCIOC_CTRL_QUERY:
        return query(file, *static_cast<uvc_xu_control_query*>(argument));
      default:
        return -ENOTTY;
    }
  }

  void* map(int descriptor, std::size_t, std::int64_t offset) override {
    ++mapped_count;
    return fileOf(descriptor).buffers.at(static_cast<std::size_t>(offset)).data();
  }
  void unmap(void*, std::size_t) override { --mapped_count; }

  int poll(std::span<pollfd> descriptors, std::chrono::milliseconds) override {
    int ready = 0;
    for (pollfd& one : descriptors) {
      const PlayedNode& node = *fileOf(one.fd).node;
      if (!node.images.empty()) one.revents = POLLIN;
      if (node.images.empty() && node.error_after_images != 0) one.revents = POLLERR;
      ready += one.revents != 0 ? 1 : 0;
    }
    return ready;
  }

 private:
  static constexpr int kFirst = 100;

  struct Opened {
    PlayedNode* node = nullptr;
    std::uint32_t bytes = 0;  // of a buffer
    std::vector<std::string> buffers = {};
    std::deque<std::uint32_t> queued = {};
    std::uint32_t asked_table = 0;
  };

  Opened& fileOf(int descriptor) { return opened_.at(static_cast<std::size_t>(descriptor - kFirst)); }

  static int describe(const Opened& file, v4l2_capability& capability) {
    capability.capabilities =
        V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_DEVICE_CAPS;
    // A node without formats is that of metadata.
    capability.device_caps =
        V4L2_CAP_STREAMING | (file.node->formats.empty() ? V4L2_CAP_META_CAPTURE : V4L2_CAP_VIDEO_CAPTURE);
    return 0;
  }
  static int enumerate(const Opened& file, v4l2_fmtdesc& description) {
    if (description.type != V4L2_BUF_TYPE_VIDEO_CAPTURE || description.index >= file.node->formats.size())
      return -EINVAL;
    description.pixelformat = file.node->formats[description.index];
    return 0;
  }
  static int setFormat(Opened& file, v4l2_format& format) {
    if (file.node->format_error != 0) return -file.node->format_error;
    v4l2_pix_format& pixels = format.fmt.pix;
    const cv::Size asked(static_cast<int>(pixels.width), static_cast<int>(pixels.height));
    const auto& sizes = file.node->sizes;
    const cv::Size given = std::ranges::find(sizes, asked) != sizes.end() ? asked : sizes.front();
    pixels.width = static_cast<std::uint32_t>(given.width);
    pixels.height = static_cast<std::uint32_t>(given.height);
    pixels.bytesperline = 2 * pixels.width;
    file.bytes = pixels.sizeimage = pixels.bytesperline * pixels.height;
    return 0;
  }
  static int play(Opened& file, v4l2_buffer& buffer) {
    if (file.node->images.empty())
      return file.node->error_after_images != 0 ? -file.node->error_after_images : -EAGAIN;
    if (file.queued.empty()) return -EAGAIN;
    const PlayedNode::Image image = std::move(file.node->images.front());
    file.node->images.pop_front();
    buffer.index = file.queued.front();
    file.queued.pop_front();
    buffer.bytesused = static_cast<std::uint32_t>(image.bytes.size());
    buffer.flags = image.flags;
    buffer.timestamp.tv_sec = static_cast<time_t>(image.time_s);
    buffer.timestamp.tv_usec =
        static_cast<suseconds_t>((image.time_s - static_cast<double>(buffer.timestamp.tv_sec)) * 1e6);
    std::memcpy(file.buffers.at(buffer.index).data(), image.bytes.data(), image.bytes.size());
    return 0;
  }
  static int query(Opened& file, const uvc_xu_control_query& query) {
    if (query.unit != 3 || query.selector != 1 || file.node->tables.empty()) return -ENOENT;
    if (query.query == UVC_GET_LEN) {
      query.data[0] = 0;
      query.data[1] = 4;
      return query.size == 2 ? 0 : -EINVAL;
    }
    if (query.size != 1024) return -ENOBUFS;
    if (query.query == UVC_SET_CUR) {
      file.asked_table = query.data[8];
      return 0;
    }
    const auto table = file.node->tables.find(file.asked_table);
    const std::string answer =
        table == file.node->tables.end() ? monitorAnswer(0xFFFFFFFA, "") : monitorAnswer(0x15, table->second);
    std::memcpy(query.data, answer.data(), answer.size());
    return 0;
  }

  std::deque<Opened> opened_;
};

/// A computer with USB cameras as the kernel shows them below /sys and /dev.
class UsbCameras {
 public:
  [[nodiscard]] std::filesystem::path root() const { return folder_.path(); }

  void plug(const std::string& port, const std::string& product, const std::string& serial,
            const std::string& vendor = "8086") const {
    const std::string at = "sys/bus/usb/devices/" + port + "/";
    folder_.write(at + "idVendor", vendor + "\n");
    folder_.write(at + "idProduct", product + "\n");
    folder_.write(at + "busnum", "2\n");
    folder_.write(at + "devnum", "3\n");
    folder_.write(at + "speed", "5000\n");
    if (!serial.empty()) folder_.write(at + "serial", serial + "\n");
  }
  /// Adds /dev/video`number` of an interface ("2-1:1.3"). Result: its path.
  [[nodiscard]] std::filesystem::path addNode(int number, const std::string& interface) const {
    const std::string name = "video" + std::to_string(number);
    std::filesystem::create_directories(folder_ / ("sys/bus/usb/devices/" + interface));
    std::filesystem::create_directories(folder_ / ("sys/class/video4linux/" + name));
    std::filesystem::create_directory_symlink(folder_ / ("sys/bus/usb/devices/" + interface),
                                              folder_ / ("sys/class/video4linux/" + name + "/device"));
    return folder_.write("dev/" + name, "");
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace scantrove::test
