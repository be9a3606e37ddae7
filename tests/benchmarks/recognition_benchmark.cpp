// Recognition in a catalogue of many views: time and memory to load it for a scan, and time to compare the
// four candidates of a frame with it. The argument is the number of views, 20 of each object.
#include <benchmark/benchmark.h>

#include <QByteArray>
#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/object_database.h"
#include "core/compute/compute_context.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"
#include "tests/benchmarks/written_catalogues.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kViewsOfEach = 20, kCandidates = 4;

/// A crop of thing `thing`: patches of its own colours, changed a little from view to view.
ObjectView patchesOf(int thing, int view) {
  cv::RNG of_thing(static_cast<std::uint64_t>(thing) * 7919 + 1);
  cv::RNG of_view(static_cast<std::uint64_t>(thing) * 104729 + static_cast<std::uint64_t>(view) + 1);
  cv::Mat patches(4, 4, CV_8UC3);
  const cv::Scalar main(of_thing.uniform(30, 220), of_thing.uniform(30, 220), of_thing.uniform(30, 220));
  of_thing.fill(patches, cv::RNG::NORMAL, main, cv::Scalar::all(35));
  ObjectView crop;
  cv::Mat noise(32, 32, CV_8UC3);
  cv::resize(patches, crop.color, {32, 32}, 0, 0, cv::INTER_CUBIC);
  of_view.fill(noise, cv::RNG::UNIFORM, 0, 25);
  crop.color += noise;
  crop.mask = cv::Mat(crop.color.size(), CV_8UC1, cv::Scalar(0));
  cv::ellipse(crop.mask, {16, 16}, {of_view.uniform(11, 15), of_view.uniform(11, 15)}, 0, 0, 360,
              cv::Scalar(255), cv::FILLED);
  const float side_m = of_thing.uniform(0.05F, 0.5F) * of_view.uniform(0.95F, 1.05F);
  crop.size_m = {side_m, 0.7F * side_m, 0.5F * side_m};
  return crop;
}

template <class Values>
QByteArray bytesOf(const Values& values) {
  return {reinterpret_cast<const char*>(values.data()), static_cast<qsizetype>(values.size())};
}

/// Writes what recognition reads, in one transaction: views without images.
void writeCatalogue(const fs::path& file, int views) {
  SCANTROVE_CHECK(ObjectDatabase::open(file));
  const auto connection = DatabaseConnection::open(file).value();
  const auto written = inTransaction(*connection, [&]() -> Result<void> {
    for (int i = 0; i < views; ++i) {
      const int id = i + 1, thing = i / kViewsOfEach, object = thing + 1;
      const ObjectView crop = patchesOf(thing, i % kViewsOfEach);
      const ViewDescriptor descriptor = describeView(crop.color, crop.mask).value();
      const float x_m = crop.size_m.x(), y_m = crop.size_m.y(), z_m = crop.size_m.z();
      if (i % kViewsOfEach == 0) {
        SCANTROVE_TRY(connection->execute(
            "INSERT INTO objects (id, number, name, size_x_m, size_y_m, size_z_m, created)"
            " VALUES (?, ?, ?, ?, ?, ?, '')",
            {object, object, QString("Obj_%1").arg(object), x_m, y_m, z_m}));
      }
      SCANTROVE_TRY(connection->execute(
          "INSERT INTO views (id, object, first_object, frame_index, pose, direction_x, direction_y,"
          " direction_z, created, color, mask, depth_mm)"
          " VALUES (?, ?, ?, ?, '1 0 0 0 0 1 0 0 0 0 1 0', 0, 0, 1, '', x'', x'', x'')",
          {id, object, object, i}));
      SCANTROVE_TRY(connection->execute(
          "INSERT INTO view_summaries (view, first_object, object_pixels, size_x_m, size_y_m, size_z_m)"
          " VALUES (?, ?, 500, ?, ?, ?)",
          {id, object, x_m, y_m, z_m}));
      const Thumbnail& thumbnail = descriptor.thumbnail;
      SCANTROVE_TRY(connection->execute(
          "INSERT INTO descriptors (view, mean_l, mean_a, mean_b, fine, colors) VALUES (?, ?, ?, ?, ?, ?)",
          {id, thumbnail.mean_lab.x(), thumbnail.mean_lab.y(), thumbnail.mean_lab.z(),
           bytesOf(thumbnail.fine), bytesOf(descriptor.colors.value().roots)}));
    }
    return {};
  });
  SCANTROVE_CHECK(written);
}

/// A catalogue of `views` views, made once.
const std::string& writtenCatalogue(int views) {
  static benchmarks::WrittenCatalogues catalogues(writeCatalogue);
  return catalogues.of(views);
}

CatalogueMirror emptyMirror() {
  static const auto compute = ComputeContext::create({}).value();
  return CatalogueMirror(Detector::create(*compute).value());
}

void BM_LoadForScan(benchmark::State& state) {
  const auto database = ObjectDatabase::open(writtenCatalogue(static_cast<int>(state.range(0)))).value();
  double growth_mb = 0;
  for (auto _ : state) {
    const double before_mb = benchmarks::residentMemory_mb();
    CatalogueMirror mirror = emptyMirror();
    SCANTROVE_CHECK(mirror.load(*database));
    growth_mb = benchmarks::residentMemory_mb() - before_mb;
  }
  state.counters["memory_mb"] = growth_mb;
}

/// Candidates that the catalogue has; `named` is the part of them that is recognised.
void BM_CompareFrame(benchmark::State& state) {
  const int views = static_cast<int>(state.range(0));
  const auto database = ObjectDatabase::open(writtenCatalogue(views)).value();
  CatalogueMirror mirror = emptyMirror();
  SCANTROVE_CHECK(mirror.load(*database));
  mirror.detector().warmUp();
  const int things = std::max(1, views / kViewsOfEach);
  int frame = 0, asked = 0, named = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<DetectionQuery> queries;
    std::vector<ObjectId> right;
    for (int i = 0; i < kCandidates; ++i) {
      const int thing = (frame * kCandidates + i) * 37 % things;
      const ObjectView crop = patchesOf(thing, kViewsOfEach + frame);
      queries.push_back({crop.color, crop.mask, crop.size_m});
      right.push_back(ObjectId{static_cast<std::uint32_t>(thing + 1)});
    }
    ++frame;
    state.ResumeTiming();
    const std::vector<DetectionMatch> matches = mirror.detector().find(queries);
    for (std::size_t i = 0; i < matches.size(); ++i) named += matches[i].object == right[i] ? 1 : 0;
    asked += kCandidates;
  }
  state.counters["named"] = static_cast<double>(named) / std::max(asked, 1);
}

#define RECOGNITION_BENCHMARK(name) \
  BENCHMARK(name)->Arg(1000)->Arg(10000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)
RECOGNITION_BENCHMARK(BM_LoadForScan)->Iterations(1);
RECOGNITION_BENCHMARK(BM_CompareFrame);

}  // namespace
}  // namespace scantrove
