// A file opened as a catalogue: all of it is read, and it is edited.
#include <unistd.h>

#include <QCoreApplication>

#include "core/catalogue/object_database.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

ObjectView someView(int seed) {
  ObjectView view;
  const cv::Size size(12, 9);
  view.color = cv::Mat(size, CV_8UC3, cv::Scalar(10 * seed, 90, 120));
  view.mask = cv::Mat(size, CV_8UC1, cv::Scalar(255));
  view.depth_mm = cv::Mat(size, CV_16UC1, cv::Scalar(900));
  view.direction = Eigen::Vector3f(1, 0.2F * static_cast<float>(seed), -1).normalized();
  view.size_m = {0.3F, 0.2F, 0.1F};
  return view;
}

/// In /dev/shm where possible, because each transaction waits for the disk.
const TemporaryFolder& folder() {
  static const bool is_quick = ::access("/dev/shm", W_OK) == 0 && ::setenv("TMPDIR", "/dev/shm", 0) == 0;
  static const TemporaryFolder made;
  (void)is_quick;
  return made;
}

void readAll(ObjectDatabase& database) {
  (void)database.model();
  (void)database.changesAfter(0);
  (void)database.views().forEachDescriptor(0, [](const StoredDescriptor&) {});
  const auto objects = database.objects();
  for (const ObjectRecord& object : objects.value_or(std::vector<ObjectRecord>())) {
    (void)database.mergeRoot(object.id);
    (void)database.views().picture(object.id);
    const auto views = database.views().of(object.id);
    for (const ObjectView& view : views.value_or(std::vector<ObjectView>())) {
      require(view.color.empty() || view.mask.empty() || view.color.size() == view.mask.size(),
              "colour and mask of a view have one size");
    }
  }
}

}  // namespace

std::vector<std::string> seeds() {
  static int argc = 1;
  static char name[] = "fuzz";
  static char* argv[] = {name, nullptr};
  static const QCoreApplication qt(argc, argv);
  {
    const auto database = ObjectDatabase::open(folder() / "seed.sqlite");
    require(database.has_value(), "a catalogue can be made");
    for (int i = 0; i < 2; ++i)
      require((*database)->addObject(someView(i)).has_value(), "an object can be added");
  }
  return {readText(folder() / "seed.sqlite"), ""};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const test::TemporaryFolder& folder = test::folder();
  for (const char* name : {"input.sqlite", "input.sqlite-wal", "input.sqlite-shm", "input.sqlite-journal"}) {
    std::filesystem::remove(folder / name);
  }
  const auto file = test::rewrite(folder, "input.sqlite", {reinterpret_cast<const char*>(data), size});
  const auto database = ObjectDatabase::open(file);
  test::require(database || !database.error().what.empty(), "an error has words");
  if (!database) return 0;
  test::readAll(**database);
  const auto session = (*database)->sessions().begin("input");
  const auto added = (*database)->addObject(test::someView(7));
  if (added) (void)(*database)->rename(added->id, "mug");
  if (session) (void)(*database)->sessions().end(*session);
  return 0;
}
