#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/scan/frame_label_writer.h"
#include "core/scan/region_numbers.h"
#include "core/session/final_label_record.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// The images in labels-final/ of a whole session, whichever of its runs wrote them. Those of earlier runs
/// are drawn again, since their regions may have changed. It needs each frame's depth: the session has that
/// of key frames, the recording that of all. Only files that the session has on record and that nobody has
/// changed since are replaced. One thread.
class FinalLabelImages {
 public:
  /// Stores the record in the session. Error: the disk.
  using StoreRecord = std::function<Result<void>(const FinalLabelRecord&)>;

  /// `folder`: of the scan.
  explicit FinalLabelImages(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The images of the session so far: they are to be drawn again.
  void begin(const SavedScan& earlier);

  /// Draws the images of earlier runs and stores the record of all. `own`: images of this run. What cannot be
  /// drawn stays as it is and is named in remarks(). Error: the device or the disk failed.
  [[nodiscard]] Result<void> redraw(const FinalLabelRecord& own, RegionNumbers& numbers,
                                    const FrameLabelWriter::RenderView& look, const StoreRecord& store);

  /// Of the last redraw(), for the user.
  [[nodiscard]] const std::vector<Error>& remarks() const { return remarks_; }

 private:
  struct Drawn {
    FinalLabelImage* image;
    std::string bytes;
  };
  [[nodiscard]] std::filesystem::path fileOf(int frame_index) const;
  /// Fills pending_ with the earlier images that are as they were written.
  void findUnchanged(const std::set<int>& own_frames);
  [[nodiscard]] Result<void> drawFromKeyFrames();
  [[nodiscard]] Result<void> drawFromRecordings();
  [[nodiscard]] Result<void> drawFrom(const SavedRecording& recording, const std::vector<int>& requested);
  /// Leaves an image pending whose depth this is not.
  [[nodiscard]] Result<void> draw(int frame_index, const cv::Mat& depth);
  [[nodiscard]] Result<void> writeDrawn();
  void remarkOnRest();

  std::filesystem::path folder_;
  SavedScan earlier_;  // frames, key frames and recordings
  FinalLabelRecord record_;
  std::map<int, FinalLabelImage*> pending_;  // by frame index
  std::vector<Drawn> drawn_;                 // not written yet
  RegionNumbers* numbers_ = nullptr;         // while redraw() runs, like the two below
  const FrameLabelWriter::RenderView* look_ = nullptr;
  const StoreRecord* store_ = nullptr;
  std::string obstacle_;  // why frames of a recording could not be read
  std::vector<Error> remarks_;
};

}  // namespace scantrove
