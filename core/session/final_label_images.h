#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/session/final_label_record.h"
#include "core/session/frame_label_writer.h"
#include "core/session/region_numbers.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// The images in labels-final/ of a whole session, from all of its runs. Images of earlier runs are drawn
/// again, since their regions may have changed. That needs each frame's depth: the session has that of key
/// frames, the recording that of all. Only recorded files that nobody has changed since are replaced. One
/// thread.
class FinalLabelImages {
 public:
  /// Stores the record in the session. Error: the disk.
  using StoreRecord = std::function<Result<void>(const FinalLabelRecord&)>;

  /// Opens a recording by SavedRecording::source.
  using OpenRecording = std::function<Result<std::unique_ptr<FrameSource>>(const std::string& source)>;

  /// `folder`: of the scan.
  FinalLabelImages(std::filesystem::path folder, OpenRecording open)
      : folder_(std::move(folder)), open_(std::move(open)) {}

  /// The session's existing images, which redraw() draws again.
  void begin(const SavedScan& earlier);

  /// Draws the images of earlier runs and stores the record of all. `own`: images of this run. Images that
  /// cannot be drawn stay unchanged and are named in remarks(). Error: the device or the disk failed.
  [[nodiscard]] Result<void> redraw(const FinalLabelRecord& own, RegionNumbers& numbers,
                                    const FrameLabelWriter::RenderView& render, const StoreRecord& store);

  /// Of the last redraw(), for the user.
  [[nodiscard]] const std::vector<Error>& remarks() const { return remarks_; }

 private:
  struct Drawn {
    FinalLabelImage* image;
    std::string bytes;
  };
  [[nodiscard]] std::filesystem::path fileOf(int frame_index) const;
  /// Fills pending_ with the unchanged images of earlier runs.
  void findUnchanged(const std::set<int>& own_frames);
  [[nodiscard]] Result<void> drawFromKeyFrames();
  [[nodiscard]] Result<void> drawFromRecordings();
  [[nodiscard]] Result<void> drawFrom(const SavedRecording& recording, const std::vector<int>& requested);
  /// Leaves an image pending if its depth differs.
  [[nodiscard]] Result<void> draw(int frame_index, const cv::Mat& depth);
  [[nodiscard]] Result<void> writeDrawn();
  void remarkOnRest();

  std::filesystem::path folder_;
  OpenRecording open_;
  SavedScan earlier_;  // frames, key frames and recordings
  FinalLabelRecord record_;
  std::map<int, FinalLabelImage*> pending_;  // by frame index
  std::vector<Drawn> drawn_;                 // not written yet
  RegionNumbers* numbers_ = nullptr;         // only during redraw(), like the two below
  const FrameLabelWriter::RenderView* render_ = nullptr;
  const StoreRecord* store_ = nullptr;
  std::string obstacle_;  // why frames of a recording cannot be read
  std::vector<Error> remarks_;
};

}  // namespace scantrove
