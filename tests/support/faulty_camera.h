#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>
#include <utility>

#include "core/capture/frame_source.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {

/// A live camera that looks at the synthetic table top and has faults at certain moments. It may be opened
/// several times; the scene and the camera's path go on between two openings.
class FaultyCamera {
 public:
  enum class Fault {
    unplugged,  ///< fails; the next openings fail, see absent_openings
    stalled,    ///< sends nothing until it is opened again
    garbage,    ///< one damaged image
    resized,    ///< images of half the width and height, whose camera is known once it is opened again
  };

  std::map<int, Fault> faults;  ///< by the number of the moment, from 0 on
  int frames = 24;              ///< then the camera is switched off for good: `end`
  int absent_openings = 2;      ///< openings that fail after it was unplugged
  int moments_missed = 0;       ///< by each such opening: the camera moves on
  int openings = 0;             ///< that succeeded
  Intrinsics K{262.5F, 262.5F, 159.5F, 119.5F, 320, 240};

  [[nodiscard]] Result<std::unique_ptr<FrameSource>> open() {
    if (absent_ > 0) {
      --absent_;
      for (int i = 0; i < moments_missed; ++i) nextMoment();
      return fail("The faulty camera is not connected.", "Connect it.");
    }
    ++openings;
    return std::make_unique<Opened>(*this);
  }
  /// Any thread: the next opening works.
  void comeBack() { absent_ = 0; }
  [[nodiscard]] std::function<Result<std::unique_ptr<FrameSource>>()> opener() {
    return [this] { return open(); };
  }

 private:
  class Opened final : public FrameSource {
   public:
    explicit Opened(FaultyCamera& camera) : camera_(camera) {
      info_.name = "faulty camera";
      info_.kind = "test camera";
      info_.is_live = true;
      info_.intrinsics =
          camera.is_half_ ? camera.K.resizedTo(camera.K.width / 2, camera.K.height / 2) : camera.K;
    }
    [[nodiscard]] const SourceInfo& info() const override { return info_; }
    [[nodiscard]] FrameRead next() override { return camera_.read(first_); }

   private:
    FaultyCamera& camera_;
    SourceInfo info_;
    int first_ = camera_.moment_;  // numbers and times of frames begin anew with each opening
  };

  FrameRead read(int first) {
    FrameRead read;
    if (is_stalled_ && first == stalled_opening_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      read.status = FrameRead::Status::timeout;
      return read;
    }
    if (moment_ >= frames) return read;
    if (const auto fault = faults.find(moment_); fault != faults.end()) {
      const Fault what = fault->second;
      faults.erase(fault);
      if (what == Fault::resized) is_half_ = true;
      if (what != Fault::resized) return faulty(what, first);
    }
    const int index = moment_ - first;
    read = nextMoment();
    read.frame.index = index;
    read.frame.timestamp_s = index / 30.0;
    read.frame.T_world_camera.reset();
    read.frame.instances.release();
    if (is_half_) halve(read.frame);
    return read;
  }

  FrameRead faulty(Fault fault, int first) {
    FrameRead read;
    if (fault == Fault::unplugged) {
      absent_ = absent_openings;
      read.status = FrameRead::Status::failed;
      read.error = {"The faulty camera does not answer any more.", "Plug it in."};
    } else if (fault == Fault::stalled) {
      is_stalled_ = true;
      stalled_opening_ = first;
      read.status = FrameRead::Status::timeout;
    } else {
      read = nextMoment();
      read.frame = {};
      read.status = FrameRead::Status::skipped;
      read.error = {"A frame of the faulty camera is damaged.", ""};
    }
    return read;
  }

  FrameRead nextMoment() {
    if (!scene_) {
      SyntheticOptions options;
      options.K = K;
      options.noise = false;
      options.tremor = false;
      scene_ = std::move(*makeSyntheticSource(options));
    }
    ++moment_;
    return scene_->next();
  }

  static void halve(RgbdFrame& frame) {
    for (cv::Mat* image : {&frame.depth, &frame.color}) {
      cv::Mat half;
      cv::resize(*image, half, {image->cols / 2, image->rows / 2}, 0, 0, cv::INTER_NEAREST);
      *image = half;
    }
  }

  std::unique_ptr<FrameSource> scene_;
  int moment_ = 0;
  std::atomic<int> absent_ = 0;  // openings that still fail
  bool is_half_ = false;
  bool is_stalled_ = false;
  int stalled_opening_ = -1;
};

}  // namespace scantrove::test
