#include "core/scan/scan_refinement.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <set>
#include <utility>
#include <vector>

#include "core/collection/collector_memory.h"
#include "core/compute/guarded.h"
#include "core/refinement/final_pass.h"
#include "core/session/key_frame_files.h"

namespace scantrove {

void ScanRefinement::run(ScanParts& parts, const Callbacks& callbacks) {
  const auto start = std::chrono::steady_clock::now();
  const Result<void> done = guarded("refining the objects", [&] { return runPass(parts, callbacks); });
  if (!done) spdlog::warn("The objects could not be refined. {}", done.error().message());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (report_.key_frames > 0) report_.seconds = elapsed.count();
}

Result<void> ScanRefinement::runPass(ScanParts& parts, const Callbacks& callbacks) {
  report_.skipped = true;  // until it is done
  if (parts.refinement.position.pass <= RefinementPosition::Pass::rate) parts.objectness.clear();
  ObjectCollector& collector = parts.objects->collector();
  SCANTROVE_TRY(parts.recorder->save(*parts.pipeline, &collector));
  const auto stored = parts.recorder->storedFrames();
  if (!stored) return fail(stored.error());
  report_.skipped = !stored->empty();
  if (stored->empty()) return {};
  std::vector<FinalPass::KeyFrame> key_frames;
  for (const SessionRecorder::StoredFrame& key : *stored) {
    key_frames.push_back(
        {key.frame.source_index, key.frame.T_world_camera,
         [&key, folder = parts.recorder->folder()] { return readKeyFrame(folder, key.images, key.frame); }});
  }
  const auto report_step = [&](int done, int steps) { callbacks.stepped({done, steps, report_.key_frames}); };
  FinalPass pass(*parts.pipeline, collector, std::move(key_frames),
                 {callbacks.may_continue, report_step, callbacks.collected});
  report_.key_frames = pass.keyFrames();
  if (!callbacks.may_continue()) return {};
  callbacks.begins();
  Result<void> done = pass.run(parts.refinement.position);
  parts.refinement.position = pass.position();
  if (pass.objectness()) parts.objectness = *pass.objectness();
  report_.skipped = parts.refinement.position.pass != RefinementPosition::Pass::done;
  return done;
}

void ScanRefinement::keep(ScanParts& parts) const {
  SessionMetadata metadata = refinementMetadata(true);
  if (report_.skipped) {
    parts.refinement.collector = collectorMemory(parts.objects->collector().state());
    const RegionTable& table = parts.pipeline->labels().table();
    std::set<RegionId> known(table.regions().begin(), table.regions().end());
    std::erase_if(known, [&table](RegionId region) { return !table.isKnown(region); });
    parts.refinement.known.assign(known.begin(), known.end());
    metadata = refinementMetadata(parts.refinement, parts.pipeline->labels().editor().log().entries());
  }
  for (const auto& [name, value] : metadata) parts.recorder->setMetadata(name, value);
}

}  // namespace scantrove
