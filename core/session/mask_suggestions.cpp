#include "core/session/mask_suggestions.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "core/pipeline/mapping_pipeline.h"
#include "core/session/mask_camera.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

/// The camera in which masks of a key frame were made.
struct MaskCamera {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

bool isOfSize(const Intrinsics& K, const cv::Size& size) {
  return K.width == size.width && K.height == size.height;
}

std::string sizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

Result<MaskCamera> cameraOf(const KeyFrameInfo& frame, const cv::Size& size, const std::string& image) {
  const bool has_color = !frame.color_file.empty();
  if (has_color && isOfSize(frame.K_color, size)) return MaskCamera{frame.K_color, frame.colorCameraPose()};
  if (isOfSize(frame.K_depth, size)) return MaskCamera{frame.K_depth, frame.T_world_depth};
  const Intrinsics& K = has_color ? frame.K_color : frame.K_depth;
  return fail(image + " has " + sizeText(size.width, size.height) + " pixels, key frame " +
                  std::to_string(frame.index) + " has " + sizeText(K.width, K.height) + ".",
              "Make masks at the size of the key frames' images.");
}

/// Reads the masks of key frames and renders the map there.
class MaskedViews {
 public:
  MaskedViews(OpenSession& session, const MaskFolder& folder) : session_(session), folder_(folder) {}

  using Use = std::function<void(const RenderedView&, std::span<const PixelMask>)>;
  /// Passes each key frame that has masks to `use`, and counts both.
  Result<void> forEach(const Use& use) {
    key_frames_ = masks_ = 0;
    const auto frames = SessionScan(session_).keyFrames(true);
    if (!frames) return fail(frames.error());
    for (const KeyFrameInfo& frame : *frames) {
      if (folder_.has(frame.index)) SCANTROVE_TRY(read(frame, use));
    }
    return {};
  }
  [[nodiscard]] std::size_t keyFrames() const { return key_frames_; }
  [[nodiscard]] std::size_t masks() const { return masks_; }

 private:
  Result<void> read(const KeyFrameInfo& frame, const Use& use) {
    const Result<ImageMasks> image = folder_.masksOfFrame(frame.index);
    if (!image) return fail(image.error());
    const Result<MaskCamera> camera = cameraOf(frame, image->size, folder_.nameOf(frame.index));
    if (!camera) return fail(camera.error());
    ++key_frames_;
    masks_ += image->masks.size();
    if (image->masks.empty()) return {};
    const Intrinsics K = scaledDown(camera->K, session_.pipeline().workingIntrinsics());
    const auto view = session_.pipeline().readout().renderView(camera->T_world_camera, K);
    if (!view) return fail(view.error());
    std::vector<PixelMask> sampled;
    for (const MaskRuns& mask : image->masks) {
      PixelMask pixels = sampledPixels(mask, image->size, {K.width, K.height});
      if (!pixels.empty()) sampled.push_back(std::move(pixels));
    }
    use(*view, sampled);
    return {};
  }

  OpenSession& session_;
  const MaskFolder& folder_;
  std::size_t key_frames_ = 0, masks_ = 0;
};

UserStatements statementsIn(OpenSession& session) {
  UserStatements statements;
  session.readCatalogue();
  MapLabels& labels = session.pipeline().labels();
  for (const auto& [region, note] : labels.editor().notes().all()) statements.labeled.insert(region);
  for (const auto& [region, label] : session.labels()) {
    if (label.is_named || label.confirmed) statements.labeled.insert(region);
  }
  if (const EvidenceGraph* evidence = labels.merger().evidence())
    statements.addConstraints(labels.table(), *evidence);
  return statements;
}

}  // namespace

Result<MaskSuggestions> suggestEdits(OpenSession& session, const MaskFolder& masks,
                                     const ProposalParams& params) {
  MaskedViews views(session, masks);
  MaskEvidence evidence;
  MaskPartings partings;
  SCANTROVE_TRY(views.forEach([&](const RenderedView& view, std::span<const PixelMask> of_frame) {
    evidence.add(view, of_frame);
    partings.find(view, of_frame);
  }));
  if (views.keyFrames() == 0)
    return fail("No image of " + masks.path().string() + " has the number of a key frame of " +
                    session.folder().string() + ".",
                "Number masks as 'scantrove export' numbers the images of this scan.");
  if (views.masks() == 0)
    return fail("The images of key frames in " + masks.path().string() + " hold no mask.",
                "Each value of a label image but 0 is a mask.");
  SCANTROVE_TRY(views.forEach([&](const RenderedView& view, std::span<const PixelMask> of_frame) {
    partings.count(view, of_frame);
  }));
  return MaskSuggestions{proposeEdits(evidence, partings, statementsIn(session), params), views.keyFrames(),
                         views.masks()};
}

}  // namespace scantrove
