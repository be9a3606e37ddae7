#include "core/scan/report_json.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/exchange/atomic_file.h"
#include "core/session/param_registry.h"

namespace scantrove {
namespace {

using Json = nlohmann::ordered_json;

Json paramsToJson(const ScanParams& params) {
  Json json = Json::object();
  for (const ParamInfo& info : paramRegistry()) {
    json[info.key] = info.isNumber() && !info.isAutomatic(params) ? Json::parse(info.text(params))
                                                                  : Json(info.text(params));
  }
  return json;
}

Json sensorToJson(const DepthSensor& sensor) {
  const Intrinsics& K = sensor.K;
  return {{"width", K.width},
          {"height", K.height},
          {"focal_px", K.fx},
          {"median_depth_m", sensor.median_depth_m ? Json(*sensor.median_depth_m) : Json(nullptr)},
          {"footprint_mm", K.fx > 0 ? Json(1000 * sensor.footprint_m()) : Json(nullptr)}};
}

Json stagesToJson(const std::vector<ScanReport::Stage>& stages) {
  Json json = Json::object();
  for (const ScanReport::Stage& stage : stages) {
    json[stage.name] = {{"median_ms", stage.median_ms}, {"p95_ms", stage.p95_ms}};
  }
  return json;
}

Json objectsToJson(const std::vector<CollectedObject>& objects) {
  Json json = Json::array();
  for (const CollectedObject& object : objects) {
    const bool is_new = object.recognized_from.empty();
    json.push_back({{"id", object.id.value},
                    {"name", object.name},
                    {"confirmed", object.confirmed},
                    {"views", object.views},
                    {"recognised_from", is_new ? Json(nullptr) : Json(object.recognized_from)},
                    {"objectness", object.objectness ? Json(*object.objectness) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

Json reportToJson(const ScanReport& report) {
  const FrameCounts& frames = report.frames;
  return {{"source", report.source},
          {"device", report.device},
          {"params", paramsToJson(report.params)},
          {"sensor", sensorToJson(report.sensor)},
          {"frames",
           {{"read", frames.read},
            {"tracked", frames.tracked},
            {"by_device", frames.by_device},
            {"lost", frames.lost},
            {"relocalised", frames.relocalized},
            {"dropped", frames.dropped},
            {"skipped", frames.skipped}}},
          {"lost_frames", report.lost_frames},
          {"drift",
           {{"corrected_frames", report.drift.corrected_frames},
            {"most_corrected_m", report.drift.most_corrected_m},
            {"places_seen_again", report.drift.revisited_key_frames},
            {"most_m", report.drift.most_m},
            {"device_jumps", report.drift.device_jumps}}},
          {"advice", report.advice},
          {"origin_m", {report.origin_m.x(), report.origin_m.y(), report.origin_m.z()}},
          {"fps", report.fps},
          {"frame_ms", {{"median", report.frame_median_ms}, {"p95", report.frame_p95_ms}}},
          {"stages", stagesToJson(report.stages)},
          {"peak_memory_mb", report.peak_memory_mb},
          {"map",
           {{"bricks", report.map_bricks},
            {"megabytes", report.map_megabytes},
            {"disk_megabytes", report.map_disk_megabytes}}},
          {"regions", report.regions},
          {"slivers", report.small_fragments},
          {"refinement",
           {{"seconds", report.refinement.seconds},
            {"key_frames", report.refinement.key_frames},
            {"skipped", report.refinement.skipped}}},
          {"objects", objectsToJson(report.objects)}};
}

Result<void> writeReport(const std::filesystem::path& path, const ScanReport& report) {
  Json json = reportToJson(report);
  if (report.is_of_refinement) {
    std::ifstream stream(path, std::ios::binary);
    Json earlier = Json::parse(stream, nullptr, false);
    if (earlier.is_object()) {
      for (const char* found : {"map", "regions", "slivers", "refinement", "objects"})
        earlier[found] = std::move(json[found]);
      json = std::move(earlier);
    }
  }
  return writeFileAtomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace scantrove
