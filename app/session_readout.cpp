#include "app/session_readout.h"

#include <iomanip>
#include <iostream>
#include <utility>

#include "app/command.h"
#include "app/json_output.h"
#include "core/base/text.h"
#include "core/session/operation_json.h"

namespace scantrove {
namespace {

/// A point of the session in world coordinates of its recording.
Json toJson(const Eigen::Vector3f& point, const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return {point.x(), point.y(), point.z()};
  return {point.x() + origin.x(), point.y() + origin.y(), point.z() + origin.z()};
}

Json toJson(const RegionSummary& region, const Eigen::Vector3d& origin) {
  Json json{{"id", region.region.value},
            {"voxels", region.voxels},
            {"centroid_m", toJson(region.centroid_world, origin)},
            {"box_m", {toJson(region.box_world.min(), origin), toJson(region.box_world.max(), origin)}},
            {"name", region.label.name},
            {"category", region.label.category},
            {"object", nullptr},
            {"is_object", region.label.is_object},
            {"confirmed", region.label.confirmed},
            {"background", region.label.background},
            {"proposed_background", region.is_proposed_background},
            {"rejected", region.label.rejected},
            {"seen_share", region.seen_from.share()}};
  if (region.label.object) json["object"] = region.label.object.value;
  return json;
}

const char* wordFor(OperationLog::State state) {
  switch (state) {
    case OperationLog::State::done:
      return "done";
    case OperationLog::State::undone:
      return "undone";
    case OperationLog::State::superseded:
      return "superseded";
  }
  return "";
}

std::string correctionText(const OpenSession& session, const Operation& paint) {
  const RegionId region = paint.regions.empty() ? RegionId{} : paint.regions.front();
  const std::string name = session.labelOf(region).name;
  const char* what = paint.kind == OperationKind::unpaint ? "Take back the painted mask of "
                     : paint.correction->makes_region     ? "Paint a new region on "
                                                          : "Correct mask of ";
  return what + (name.empty() ? "region " + std::to_string(region.value) : inLine(name)) + " in image " +
         std::to_string(paint.correction->image) + (paint.correction->this_image_only ? " only" : "");
}

}  // namespace

Result<void> showSession(OpenSession& session, const SessionArguments& arguments) {
  const auto regions = session.regions();
  if (!regions) return fail(regions.error());
  std::size_t usable = 0, named = 0, objects = 0, proposed = 0, done = 0;
  for (const SavedFrame& frame : session.frames()) usable += frame.isUsable() ? 1U : 0U;
  for (const RegionSummary& region : *regions) {
    named += region.label.is_named ? 1U : 0U;
    objects += region.label.object ? 1U : 0U;
    proposed += region.is_proposed_background ? 1U : 0U;
  }
  Json recordings = Json::array();
  for (const SavedRecording& one : session.recordings())
    recordings.push_back({{"source", one.source},
                          {"first_frame", one.first_frame},
                          {"index_shift", one.index_shift},
                          {"time_shift_s", one.time_shift_s}});
  for (const auto& entry : session.history().entries())
    done += entry.state == OperationLog::State::done ? 1U : 0U;
  const std::optional<bool> are_current = session.areResultsCurrent();
  if (arguments.json) {
    printJson({{"source", session.setup().source},
               {"recordings", recordings},
               {"frames", session.frames().size()},
               {"tracked", usable},
               {"key_frames", session.keyFrames().size()},
               {"bricks", session.brickCount()},
               {"regions", regions->size()},
               {"named", named},
               {"objects", objects},
               {"proposed_background", proposed},
               {"operations", done},
               {"ended", session.hasEnded()},
               {"refined", !session.canBeRefined()},
               {"results_current", are_current ? Json(*are_current) : Json(nullptr)},
               {"damages", session.damages()}});
    return {};
  }
  std::cout << "source      " << inLine(session.setup().source)
            << (session.hasEnded() ? "" : "  (recovered after an interrupted scan)");
  for (const SavedRecording& one : session.recordings()) {
    if (one.first_frame > 0) std::cout << ", then " << inLine(one.source);
  }
  std::cout << "\nframes      " << session.frames().size() << ", " << usable << " tracked, "
            << session.keyFrames().size() << " key frames\nmap         " << session.brickCount()
            << " bricks\nregions     " << regions->size() << ", " << named << " named, " << objects
            << " objects, " << proposed << " proposed as background\noperations  " << done << "\nrefined     "
            << (session.canBeRefined() ? "no; run 'scantrove session refine'" : "yes") << '\n';
  if (!are_current.value_or(true))
    std::cout << "files       cloud, labels.json and label images are older than the last edits; "
                 "'scantrove export' writes current ones\n";
  return {};
}

Result<void> listRegions(OpenSession& session, const SessionArguments& arguments) {
  const auto regions = session.regions();
  if (!regions) return fail(regions.error());
  if (session.missingCatalogue())
    std::cerr << "scantrove: " << inLine(session.missingCatalogue()->message()) << '\n';
  if (arguments.json) {
    Json json = Json::array();
    for (const RegionSummary& region : *regions) json.push_back(toJson(region, session.setup().origin_m));
    printJson(json);
    return {};
  }
  for (const RegionSummary& region : *regions) {
    const Eigen::Vector3f size_cm = 100 * region.box_world.sizes();
    std::cout << std::right << std::setw(6) << region.region.value << std::setw(9) << region.voxels
              << " voxels " << std::fixed << std::setprecision(0) << std::setw(5) << size_cm.x() << " x "
              << size_cm.y() << " x " << size_cm.z() << " cm  " << inLine(region.label.name)
              << (region.label.background ? "  background" : "")
              << (region.is_proposed_background ? "  background?" : "")
              << (region.label.rejected ? "  rejected" : "") << '\n';
  }
  return {};
}

Result<void> showAt(OpenSession& session, const SessionArguments& arguments) {
  const auto point = surfacePointAt(session, arguments.pixel, arguments.frame);
  if (!point) return fail(point.error());
  const std::string name = session.labelOf(point->region).name;
  if (arguments.json) {
    printJson({{"region", point->region.value},
               {"name", name},
               {"point_m", toJson(point->point_world, session.setup().origin_m)}});
  } else {
    std::cout << point->region.value << (name.empty() ? "" : "  ") << inLine(name) << '\n';
  }
  return {};
}

Result<void> listOperations(OpenSession& session, const SessionArguments& arguments) {
  Json json = Json::array();
  for (const OperationLog::Entry& entry : session.history().entries()) {
    Json one{{"number", entry.number}, {"state", wordFor(entry.state)}};
    one.update(Json::parse(operationToJson(entry.operation)));
    if (entry.operation.review) one["review"] = toString(entry.operation.review->state);
    json.push_back(std::move(one));
  }
  if (arguments.json) {
    printJson(json);
    return {};
  }
  for (const OperationLog::Entry& entry : session.history().entries()) {
    std::cout << std::right << std::setw(4) << entry.number << "  " << std::left << std::setw(11)
              << wordFor(entry.state) << std::setw(11) << toString(entry.operation.kind);
    for (const RegionId region : entry.operation.regions) std::cout << ' ' << region.value;
    if (!entry.operation.name.empty()) std::cout << "  " << inLine(entry.operation.name);
    if (entry.operation.correction) std::cout << "  " << correctionText(session, entry.operation);
    if (const std::optional<FrameReview>& review = entry.operation.review)
      std::cout << " image " << review->image << ": " << toString(review->state);
    std::cout << '\n';
  }
  return {};
}

}  // namespace scantrove
