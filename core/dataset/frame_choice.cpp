#include "core/dataset/frame_choice.h"

#include <utility>

namespace scantrove {
namespace {

std::string countOfFrames(int frames, const std::string& are) {
  return std::to_string(frames) + (frames == 1 ? " frame is " : " frames are ") + are;
}

}  // namespace

std::string FrameChoice::missing() const {
  if (left_out == 0 && unchecked == 0) return {};
  if (unchecked == 0) return countOfFrames(left_out, "left out in review.");
  std::string sentence = countOfFrames(unchecked, "not checked");
  if (left_out > 0) sentence += ", " + countOfFrames(left_out, "left out in review");
  return sentence + ".";
}

Result<FrameChoice> chooseFrames(LabeledScan& scan, const ExportOptions& options) {
  auto all = scan.keyFrames(options.all_frames || options.checked_only);
  if (!all) return fail(all.error());
  FrameChoice choice;
  for (KeyFrameInfo& frame : *all) {
    if (frame.review == ReviewState::left_out) {
      ++choice.left_out;
    } else if (options.checked_only && frame.review != ReviewState::checked) {
      ++choice.unchecked;
    } else {
      choice.frames.push_back(std::move(frame));
    }
  }
  return choice;
}

}  // namespace scantrove
