// A catalogue of many views: time and memory to open it and to read all descriptors; time of an edit, a poll
// for changes and another view. The argument is the number of views.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <array>
#include <filesystem>
#include <opencv2/core.hpp>

#include "core/base/check.h"
#include "core/catalogue/object_database.h"
#include "core/database/database_connection.h"
#include "tests/benchmarks/written_catalogues.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kViewsOfAnObject = 20;

ObjectView cropOf(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  ObjectView view;
  view.color.create(120, 140, CV_8UC3);
  random.fill(view.color, cv::RNG::UNIFORM, 0, 256);
  view.mask = cv::Mat(view.color.size(), CV_8UC1, cv::Scalar(0));
  view.mask(cv::Rect(20, 20, 100, 80)).setTo(255);
  view.depth_mm = cv::Mat(view.color.size(), CV_16UC1, cv::Scalar(900 + seed % 100));
  view.size_m = {0.3F, 0.2F, 0.1F};
  return view;
}

void copyRows(DatabaseConnection& connection, const char* sql, int first, int count) {
  SCANTROVE_CHECK(connection.execute(sql, {first, first + count - 1}));
}

/// Fills a catalogue with copies of a few real rows, thousands per second.
void fill(const fs::path& file, int views) {
  const int objects = views / kViewsOfAnObject;
  {
    const auto database = ObjectDatabase::open(file).value();
    for (int i = 0; i < 10; ++i) SCANTROVE_CHECK(database->addObject(cropOf(i)));
  }
  const auto connection = DatabaseConnection::open(file).value();
  SCANTROVE_CHECK(connection->execute("BEGIN"));
  const std::string numbers = "WITH RECURSIVE n (i) AS (SELECT ? UNION ALL SELECT i + 1 FROM n WHERE i < ?) ";
  copyRows(*connection,
           (numbers + "INSERT INTO objects (id, number, name, size_x_m, size_y_m, size_z_m, created)"
                      " SELECT i, i, 'Obj_' || i, 0.3, 0.2, 0.1, '' FROM n")
               .c_str(),
           11, objects - 10);
  const int others = views - 10;
  copyRows(
      *connection,
      (numbers + "INSERT INTO views (id, object, first_object, frame_index, pose, direction_x, direction_y,"
                 " direction_z, created, color, mask, depth_mm)"
                 " SELECT n.i, 1 + (n.i - 1) / 20, 1 + (n.i - 1) / 20, n.i, pose,"
                 " direction_x, direction_y, direction_z, created, color, mask, depth_mm"
                 " FROM n JOIN views v ON v.id = 1 + n.i % 10")
          .c_str(),
      11, others);
  copyRows(*connection,
           (numbers +
            "INSERT INTO view_summaries (view, first_object, object_pixels, size_x_m, size_y_m, size_z_m)"
            " SELECT n.i, 1 + (n.i - 1) / 20, object_pixels, size_x_m, size_y_m,"
            " size_z_m FROM n JOIN view_summaries s ON s.view = 1 + n.i % 10")
               .c_str(),
           11, others);
  copyRows(
      *connection,
      (numbers + "INSERT INTO descriptors (view, mean_l, mean_a, mean_b, fine, colors) SELECT n.i, mean_l, "
                 "mean_a, mean_b, fine, colors FROM n"
                 " JOIN descriptors d ON d.view = 1 + n.i % 10")
          .c_str(),
      11, others);
  copyRows(
      *connection,
      (numbers +
       "INSERT INTO pictures (view, jpeg) SELECT n.i, jpeg FROM n JOIN pictures p ON p.view = 1 + n.i % 10")
          .c_str(),
      11, others);
  SCANTROVE_CHECK(connection->execute(
      "INSERT INTO events (created, action, object, after_json) SELECT '', 'add-view', object,"
      " '{\"view\":' || id || '}' FROM views"));
  SCANTROVE_CHECK(connection->execute("COMMIT"));
}

/// A catalogue of `views` views, made once for all benchmarks.
const std::string& catalogue(int views) {
  static benchmarks::WrittenCatalogues catalogues(fill);
  return catalogues.of(views);
}

void BM_OpenAndReadDescriptors(benchmark::State& state) {
  const std::string& file = catalogue(static_cast<int>(state.range(0)));
  double growth_mb = 0;
  for (auto _ : state) {
    ::malloc_trim(0);
    const double before_mb = benchmarks::residentMemory_mb();
    const auto database = ObjectDatabase::open(file).value();
    const auto model = database->model();
    std::int64_t views = 0;
    const auto last = database->views().forEachDescriptor(0, [&](const StoredDescriptor&) { ++views; });
    SCANTROVE_CHECK(model && last && views == state.range(0));
    growth_mb = benchmarks::residentMemory_mb() - before_mb;
  }
  state.counters["memory_mb"] = growth_mb;
}

/// Views of an older version get their descriptors at the first read.
void BM_DescribeOlderViews(benchmark::State& state) {
  const std::string& file = catalogue(static_cast<int>(state.range(0)));
  const auto database = ObjectDatabase::open(file).value();
  const auto connection = DatabaseConnection::open(file).value();
  for (auto _ : state) {
    state.PauseTiming();
    SCANTROVE_CHECK(connection->execute("UPDATE view_summaries SET object_pixels = NULL"));
    state.ResumeTiming();
    SCANTROVE_CHECK(database->views().forEachDescriptor(0, [](const StoredDescriptor&) {}));
  }
}

void BM_ListObjects(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  for (auto _ : state) benchmark::DoNotOptimize(database->objects());
}

void BM_ListPicture(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  for (auto _ : state) benchmark::DoNotOptimize(database->views().picture(ObjectId{3}));
}

void BM_Rename(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  static int i = 0;  // the function runs several times, and an equal name is no change
  for (auto _ : state) SCANTROVE_CHECK(database->rename(ObjectId{3}, "mug " + std::to_string(++i)));
}

void BM_Confirm(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  const std::array objects{ObjectId{3}};
  bool confirmed = false;
  for (auto _ : state) SCANTROVE_CHECK(database->setConfirmed(objects, confirmed = !confirmed));
}

void BM_MergeAndUnmerge(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  const std::array objects{ObjectId{4}, ObjectId{5}};
  for (auto _ : state) {
    const auto merge = database->merge(objects);
    SCANTROVE_CHECK(merge && database->unmerge(*merge));
  }
}

void BM_ChangesWhenThereAreNone(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  const std::int64_t last = database->lastEvent().value();
  for (auto _ : state) SCANTROVE_CHECK(database->changesAfter(last));
}

void BM_ChangeOfAnother(benchmark::State& state) {
  const std::string& file = catalogue(static_cast<int>(state.range(0)));
  const auto database = ObjectDatabase::open(file).value(), other = ObjectDatabase::open(file).value();
  std::int64_t last = database->lastEvent().value();
  static int i = 0;
  for (auto _ : state) {
    state.PauseTiming();
    SCANTROVE_CHECK(other->rename(ObjectId{7}, "cup " + std::to_string(++i)));
    state.ResumeTiming();
    const auto changes = database->changesAfter(last);
    SCANTROVE_CHECK(changes && changes->changes.size() == 1);
    last = changes->last_event;
  }
}

void BM_AddView(benchmark::State& state) {
  const auto database = ObjectDatabase::open(catalogue(static_cast<int>(state.range(0)))).value();
  ObjectView view = cropOf(1);
  int i = 0;
  for (auto _ : state) {
    view.object = ObjectId{static_cast<std::uint32_t>(10 + i++ % 50)};
    SCANTROVE_CHECK(database->addView(view));
  }
}

#define CATALOGUE_BENCHMARK(name) BENCHMARK(name)->Arg(2000)->Arg(50000)->Unit(benchmark::kMillisecond)
CATALOGUE_BENCHMARK(BM_OpenAndReadDescriptors)->Iterations(3);
BENCHMARK(BM_DescribeOlderViews)->Arg(2000)->Iterations(1)->Unit(benchmark::kMillisecond);
CATALOGUE_BENCHMARK(BM_ListObjects);
CATALOGUE_BENCHMARK(BM_ListPicture);
CATALOGUE_BENCHMARK(BM_Rename);
CATALOGUE_BENCHMARK(BM_Confirm);
CATALOGUE_BENCHMARK(BM_MergeAndUnmerge);
CATALOGUE_BENCHMARK(BM_ChangesWhenThereAreNone);
CATALOGUE_BENCHMARK(BM_ChangeOfAnother);
CATALOGUE_BENCHMARK(BM_AddView);

}  // namespace
}  // namespace scantrove
