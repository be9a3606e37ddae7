#include "core/session/session_restorer.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/compute/guarded.h"
#include "core/labeling/evidence_graph.h"
#include "core/labeling/kernels/label_voxel.h"
#include "core/session/key_frame_files.h"
#include "core/session/session_setup.h"

namespace scantrove {
namespace {

/// Pages read at a time: bounds the memory.
constexpr std::size_t kPagesAtATime = 32;

/// By fragment number.
struct Fragments {
  std::vector<RegionId> regions;
  std::vector<cl_int> voxels;  ///< of each fragment in the map
};

Fragments fragmentsOf(const SavedScan& scan) {
  std::size_t count = 1;
  for (const SavedFragment& one : scan.fragments)
    count = std::max<std::size_t>(count, one.fragment.value + std::size_t{1});
  Fragments fragments{std::vector<RegionId>(count), std::vector<cl_int>(count, 0)};
  for (const SavedFragment& one : scan.fragments) fragments.regions[one.fragment.value] = one.region;
  return fragments;
}

/// Counts the page's voxels. In an interrupted scan, pages may be a few seconds older than its regions:
/// voxels of deleted fragments become unlabelled.
void keepLabels(StoredPage& page, Fragments& fragments) {
  for (cl_uint& label : page.contents.labels) {
    if (label == 0) continue;
    const std::size_t fragment = LABEL_OF(label);
    if (fragment < fragments.regions.size() && fragments.regions[fragment]) {
      ++fragments.voxels[fragment];
    } else {
      label = 0;
    }
  }
}

void restoreRegions(MapLabels& labels, const SavedScan& scan, Fragments fragments) {
  RegionId last;
  if (const auto found = scan.metadata.find("last_region"); found != scan.metadata.end())
    last.value = static_cast<std::uint32_t>(std::strtoul(found->second.c_str(), nullptr, 10));
  labels.table().restore(std::move(fragments.regions), last);
  for (const SavedFragment& one : scan.fragments) {
    labels.table().restoreSeen(one.fragment, one.seen_from);
    labels.table().addSupportPixels(one.fragment, one.support_pixels);
  }
  labels.cloud().restoreVoxelCounts(std::move(fragments.voxels));
  const auto frames = std::ranges::count_if(scan.frames, &SavedFrame::isUsable);
  labels.cloud().restoreTurn(static_cast<std::size_t>(frames));
  if (EvidenceGraph* graph = labels.merger().evidence()) {
    for (const SavedBorder& border : scan.borders) {
      if (border.evidence) graph->restore(border.a, border.b, *border.evidence);
    }
  }
  for (const SavedEstimates& brick : scan.estimates)
    labels.estimated().restore(brick, labels.table().regions());
  for (const OperationLog::Entry& entry : scan.operations) labels.editor().log().restore(entry);
  for (const SavedRegion& region : scan.regions) labels.editor().restoreNote(region.region, region.note);
}

Result<void> restoreMap(BrickMap& bricks, SessionWriter& session, const SavedScan& scan, Fragments& fragments,
                        std::vector<std::string>& damages) {
  for (std::size_t first = 0; first < scan.pages.size(); first += kPagesAtATime) {
    const std::size_t last = std::min(first + kPagesAtATime, scan.pages.size());
    std::vector<std::vector<std::uint32_t>> words(last - first);
    std::vector<std::string> failures(last - first);
    session.post([&](SessionStore& store) -> Result<void> {
      for (std::size_t i = first; i < last; ++i) {
        Result<std::vector<std::uint32_t>> page = store.loadPage(scan.pages[i]);
        if (page) {
          words[i - first] = std::move(*page);
        } else {
          failures[i - first] = page.error().message();
        }
      }
      return {};
    });
    SCANTROVE_TRY(session.flush());
    for (std::size_t i = first; i < last; ++i) {
      std::string& failure = failures[i - first];
      std::optional<StoredPage> page = StoredPage::fromWords(words[i - first]);
      if (page) {
        keepLabels(*page, fragments);
        bricks.adopt(scan.pages[i], *page);
      }
      if (!page && failure.empty())
        failure = "A part of the map is of a form that is not known; it is left out.";
      if (!failure.empty()) damages.push_back(std::move(failure));
    }
  }
  return {};
}

/// Replays the camera's path, so that the same frames become tracking key frames.
void restoreKeyFrames(MappingPipeline& pipeline, SessionWriter& session, const SavedScan& scan,
                      std::vector<std::string>& damages) {
  std::map<int, const SavedKeyFrame*> images;
  for (const SavedKeyFrame& key : scan.key_frames) images[key.frame] = &key;
  for (const SavedFrame& frame : scan.frames) {
    if (!frame.isUsable() || !pipeline.camera().replayPose(frame.T_world_camera)) continue;
    const auto key = images.find(frame.number);
    if (key == images.end()) continue;
    const Result<RgbdFrame> seen = readKeyFrame(session.folder(), *key->second, frame);
    if (seen) {
      pipeline.camera().addKeyFrame(*seen, frame.T_world_camera);
    } else {
      damages.push_back(seen.error().message());
    }
  }
}

bool hasEnded(const SavedScan& scan) {
  const auto ended = scan.metadata.find("ended");
  return ended != scan.metadata.end() && !ended->second.empty();
}

/// For a scan that was stopped after its last frame; none: it was interrupted, or the memory is damaged.
Result<std::optional<CameraMemory>> loadCamera(SessionWriter& session, const SavedScan& scan) {
  std::optional<SavedCamera> camera;
  session.post([&](SessionStore& store) -> Result<void> { return moveInto(camera, store.loadCamera()); });
  SCANTROVE_TRY(session.flush());
  const bool is_of_end = camera && !scan.frames.empty() && camera->frame == scan.frames.back().number;
  return is_of_end ? cameraMemoryFrom(camera->words) : std::nullopt;
}

Result<void> restoreCamera(MappingPipeline& pipeline, SessionWriter& session, const SavedScan& scan,
                           std::vector<std::string>& damages) {
  std::optional<CameraMemory> memory;
  SCANTROVE_TRY(moveInto(memory, loadCamera(session, scan)));
  if (!memory && hasEnded(scan) && std::ranges::any_of(scan.frames, &SavedFrame::isUsable)) {
    damages.push_back("The camera memory in " + (session.folder() / "session.sqlite").string() +
                      " is missing or damaged, so the camera may take longer to find its place; the scan "
                      "goes on.");
  }
  if (memory && pipeline.camera().restoreState(std::move(*memory))) return {};
  restoreKeyFrames(pipeline, session, scan, damages);
  const auto last = std::find_if(scan.frames.rbegin(), scan.frames.rend(),
                                 [](const SavedFrame& frame) { return frame.isUsable(); });
  if (last != scan.frames.rend()) pipeline.camera().relocalizeNear(last->T_world_camera);
  return {};
}

/// All depth images of a session have one size.
void dropForeignIntrinsics(SavedScan& scan, const SessionWriter& session, std::vector<std::string>& damages) {
  const Result<SessionSetup> setup = setupFrom(scan.metadata);
  if (!setup) return;  // whoever needs it reports it
  int foreign = 0;
  for (SavedFrame& frame : scan.frames) {
    if (!frame.intrinsics ||
        (frame.intrinsics->width == setup->K.width && frame.intrinsics->height == setup->K.height))
      continue;
    frame.intrinsics.reset();
    ++foreign;
  }
  if (foreign > 0)
    damages.push_back("The cameras of " + std::to_string(foreign) + " frames of the session in " +
                      session.folder().string() + " are of other image sizes and are left out.");
}

/// Without its map no frame can be relocalised, and new surface would lie anywhere.
Result<void> checkHasMap(const BrickMap& bricks, const SessionWriter& session, const SavedScan& scan) {
  if (bricks.brickCount() > 0 || std::ranges::none_of(scan.frames, &SavedFrame::isUsable)) return {};
  return fail("The scan in " + session.folder().string() + " has no map any more to go on in.",
              "Restore its folder 'map' from a copy, or scan into a new folder with --out.");
}

}  // namespace

Result<SavedScan> loadScan(SessionWriter& session, std::vector<std::string>& damages) {
  Result<SavedScan> scan = fail("The session was not read.", "");
  session.post([&](SessionStore& store) -> Result<void> {
    scan = store.load();
    damages = store.damages();
    return {};
  });
  SCANTROVE_TRY(session.flush());
  if (scan) dropForeignIntrinsics(*scan, session, damages);
  return scan;
}

int loseFramesWithoutMap(SavedScan& scan) {
  // Fragments, regions and operations are saved with the pages.
  if (!scan.pages.empty() || !scan.fragments.empty() || !scan.regions.empty() || !scan.operations.empty())
    return 0;
  int lost = 0;
  for (SavedFrame& frame : scan.frames) {
    if (!frame.isUsable()) continue;
    frame.state = TrackingState::lost;
    frame.T_world_camera.setIdentity();
    ++lost;
  }
  return lost;
}

Result<void> restoreScan(MappingPipeline& pipeline, SessionWriter& session, const SavedScan& scan,
                         bool for_camera, std::vector<std::string>& damages) {
  return guarded("reading the session back", [&]() -> Result<void> {
    Fragments fragments = fragmentsOf(scan);
    SCANTROVE_TRY(restoreMap(pipeline.bricks(), session, scan, fragments, damages));
    if (for_camera) SCANTROVE_TRY(checkHasMap(pipeline.bricks(), session, scan));
    restoreRegions(pipeline.labels(), scan, std::move(fragments));
    return for_camera ? restoreCamera(pipeline, session, scan, damages) : Result<void>();
  });
}

}  // namespace scantrove
