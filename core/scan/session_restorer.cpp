#include "core/scan/session_restorer.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "core/labeling/evidence_graph.h"
#include "core/scan/guarded.h"
#include "core/scan/key_frame_files.h"
#include "core/scan/param_registry.h"

namespace scantrove {
namespace {

using Json = nlohmann::json;

/// Pages that are read at a time: bounds the memory.
constexpr std::size_t kPagesAtATime = 32;

void restoreRegions(ScanPipeline::Kept& kept, const SavedScan& scan) {
  std::size_t fragments = 1;
  for (const SavedFragment& one : scan.fragments)
    fragments = std::max<std::size_t>(fragments, one.fragment.value + std::size_t{1});
  std::vector<RegionId> regions(fragments);
  std::vector<cl_int> voxels(fragments, 0);
  for (const SavedFragment& one : scan.fragments) {
    regions[one.fragment.value] = one.region;
    voxels[one.fragment.value] = one.voxels;
  }
  RegionId last;
  if (const auto found = scan.facts.find("last_region"); found != scan.facts.end())
    last.value = static_cast<std::uint32_t>(std::strtoul(found->second.c_str(), nullptr, 10));
  kept.table.restore(std::move(regions), last);
  kept.cloud.restoreVoxelCounts(std::move(voxels));
  if (EvidenceGraph* graph = kept.merger.evidence()) {
    for (const SavedBorder& border : scan.borders) {
      if (border.evidence) graph->restore(border.a, border.b, *border.evidence);
    }
  }
  for (const OperationLog::Entry& entry : scan.operations) kept.editor.log().restore(entry);
  for (const SavedRegion& region : scan.regions) kept.editor.restoreNote(region.region, region.note);
}

Result<void> restoreMap(BrickMap& bricks, SessionWriter& session, const SavedScan& scan,
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
      if (!failures[i - first].empty()) {
        damages.push_back(failures[i - first]);
      } else if (const auto page = StoredPage::fromWords(words[i - first]); page) {
        bricks.adopt(scan.pages[i], *page);
      } else {
        damages.push_back("A part of the map is of a form that this program does not know; it is left out.");
      }
    }
  }
  return {};
}

}  // namespace

SavedFacts factsOf(const SessionSetup& setup) {
  std::string params;
  for (const ParamInfo& info : paramRegistry()) params += info.key + "=" + info.text(setup.params) + "\n";
  const Intrinsics& K = setup.K;
  return {{"source", setup.source},
          {"camera", Json{{"K", {K.fx, K.fy, K.cx, K.cy}}, {"size", {K.width, K.height}}}.dump()},
          {"params", params},
          {"database", setup.database}};
}

Result<SessionSetup> setupFrom(const SavedFacts& facts) {
  const auto fact = [&](const char* name) {
    const auto found = facts.find(name);
    return found == facts.end() ? std::string() : found->second;
  };
  SessionSetup setup;
  setup.source = fact("source");
  setup.database = fact("database");
  try {
    const Json camera = Json::parse(fact("camera"));
    const Json& K = camera.at("K");
    setup.K = {K.at(0).get<float>(),
               K.at(1).get<float>(),
               K.at(2).get<float>(),
               K.at(3).get<float>(),
               camera.at("size").at(0).get<int>(),
               camera.at("size").at(1).get<int>()};
  } catch (const Json::exception&) {
    return fail("The session does not say what camera it was scanned with.",
                "It broke off before its first frame was kept, or is damaged.");
  }
  std::istringstream lines(fact("params"));
  for (std::string line; std::getline(lines, line);) {
    // A parameter that this program does not know any more has no say in it.
    std::string setting = line;
    std::erase(setting, '"');
    static_cast<void>(applySetting(setup.params, setting));
  }
  return setup;
}

Result<SavedScan> loadScan(SessionWriter& session, std::vector<std::string>& damages) {
  Result<SavedScan> scan = fail("The session was not read.", "");
  session.post([&](SessionStore& store) -> Result<void> {
    scan = store.load();
    damages = store.damages();
    return {};
  });
  SCANTROVE_TRY(session.flush());
  return scan;
}

Result<void> restoreScan(ScanPipeline& pipeline, SessionWriter& session, const SavedScan& scan,
                         bool for_camera, std::vector<std::string>& damages) {
  return guarded("reading the session back", [&]() -> Result<void> {
    ScanPipeline::Kept kept = pipeline.kept();
    SCANTROVE_TRY(restoreMap(kept.bricks, session, scan, damages));
    restoreRegions(kept, scan);
    for (const SavedRegion& region : scan.regions) {
      if (region.object) pipeline.bindObject(region.region, region.object);
    }
    if (!for_camera) return {};
    for (const SavedKeyFrame& key : scan.key_frames) {
      const auto of = std::ranges::find(scan.frames, key.frame, &SavedFrame::number);
      if (of == scan.frames.end()) continue;
      const Result<RgbdFrame> frame = readKeyFrame(session.folder(), key, *of);
      if (!frame) {
        damages.push_back(frame.error().message());
        continue;
      }
      pipeline.recallPlace(*frame, of->T_world_camera);
    }
    const auto isUsable = [](const SavedFrame& frame) {
      return frame.state == TrackingState::tracking || frame.state == TrackingState::relocalised;
    };
    const auto last = std::find_if(scan.frames.rbegin(), scan.frames.rend(), isUsable);
    if (last != scan.frames.rend()) pipeline.resumeAt(last->T_world_camera);
    return {};
  });
}

}  // namespace scantrove
