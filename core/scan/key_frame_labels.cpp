#include "core/scan/key_frame_labels.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/dataset/key_frame_images.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/open_session.h"
#include "core/session/session_scan.h"

namespace scantrove {

Result<KeyFrameLabels> labelKeyFrame(OpenSession& session, const SavedKeyFrame& key_frame) {
  SessionScan scan(session);
  const Result<std::vector<KeyFrameInfo>> frames = scan.keyFrames(true);
  if (!frames) return fail(frames.error());
  const auto info = std::ranges::find_if(*frames, [&](const KeyFrameInfo& one) {
    const SavedKeyFrame* const stored = scan.keyFrameOf(one.index);
    return stored != nullptr && stored->frame == key_frame.frame;
  });
  if (info == frames->end())
    return fail("No image of frame " + std::to_string(key_frame.frame) + " was kept in " +
                    session.folder().string() + ".",
                "Show another key frame.");
  Result<KeyFrameImage> read = readKeyFrameImage(scan, *info);
  if (!read) return fail(read.error());
  std::unordered_set<int> all;
  for (const RegionId region : session.pipeline().labels().table().regions())
    all.insert(static_cast<int>(region.value));
  SCANTROVE_TRY(labelImage(scan, *read, all));
  Result<ViewOfMap> view = scan.renderView(read->image.K, read->image.T_world_camera);
  if (!view) return fail(view.error());
  return KeyFrameLabels{.index = -1,
                        .key_frame = key_frame.frame,
                        .image = info->index,
                        .color = std::move(read->color),
                        .regions = std::move(read->image.regions),
                        .depth_m = std::move(read->image.depth_m),
                        .fused_m = std::move(view->depth_m),
                        .K = read->image.K,
                        .T_world_camera = read->image.T_world_camera};
}

}  // namespace scantrove
