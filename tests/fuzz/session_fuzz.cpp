// A changed session: each line of the input sets a column of a table, or the input is the complete file.
#include <unistd.h>

#include <QCoreApplication>
#include <charconv>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/database/database_connection.h"
#include "core/fusion/packed_words.h"
#include "core/fusion/stored_page.h"
#include "core/pipeline/camera_memory.h"
#include "core/session/session_list.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

constexpr std::string_view kFileHead = "SQLite format 3";

/// In /dev/shm where possible, because each transaction waits for the disk.
const TemporaryFolder& folder() {
  static const bool is_quick = ::access("/dev/shm", W_OK) == 0 && ::setenv("TMPDIR", "/dev/shm", 0) == 0;
  static const TemporaryFolder made;
  (void)is_quick;
  return made;
}

SavedDelta someDelta() {
  SavedDelta delta;
  delta.metadata =
      metadataOf({"demo", Intrinsics{525, 525, 319.5F, 239.5F, 640, 480}, ScanParams{}, "catalogue.sqlite"});
  for (int number = 1; number < 3; ++number) {
    SavedFrame frame;
    frame.number = number;
    frame.source_index = number;
    frame.time_s = 0.03 * number;
    frame.state = TrackingState::tracking;
    if (number == 2) frame.intrinsics = Intrinsics{530, 531, 320, 240, 640, 480};
    delta.frames.push_back(frame);
  }
  delta.fragments.push_back({FragmentId{7}, RegionId{3}, 100, {}});
  delta.regions.push_back({RegionId{3}, ObjectId{2}, {"red cup", "cup", false, true, false}});
  delta.borders.push_back({FragmentId{7}, FragmentId{9}, BorderEvidence{}});
  delta.objectness = SavedObjectness{{RegionId{3}, 1.5F}};
  delta.estimates.push_back({{1, -2, 3}, {5 | 2U << 16U, 7}});
  delta.operations.push_back(
      {1,
       {.kind = OperationKind::name, .regions = {RegionId{3}}, .name = "red cup"},
       {.moves = {{FragmentId{7}, RegionId{3}, RegionId{5}}}, .constraints = {}, .notes = {}},
       OperationLog::State::done});
  Operation paint{.kind = OperationKind::paint, .regions = {RegionId{3}}};
  paint.correction = MaskCorrection{
      .key_frame = 2, .image = 2, .added = {640, 480, {1000, 20}}, .removed = {640, 480, {0, 9, 300, 7}}};
  delta.operations.push_back(
      {2, std::move(paint), {.anchor = FragmentId{7}, .created = {RegionId{8}}}, OperationLog::State::done});
  return delta;
}

std::string makeSeed() {
  static int argc = 1;
  static char name[] = "fuzz";
  static char* argv[] = {name, nullptr};
  static const QCoreApplication qt(argc, argv);
  {
    const auto store = SessionStore::create(folder() / "seed");
    require(store.has_value(), "a session can be made");
    const SavedPage page{{1, -2, 5}, std::vector<std::uint32_t>(PAGE_BRICKS, 0xFFU)};
    require((*store)->writePages({&page, 1}).has_value() && (*store)->save(someDelta()).has_value(),
            "a session can be saved");
  }
  return readText(folder() / "seed/session.sqlite");
}

const std::string& seedFile() {
  static const std::string bytes = makeSeed();
  return bytes;
}

/// "#12": an integer, "~1.5": a real number, "$...": bytes; else text.
QVariant valueOf(std::string_view text) {
  const std::string_view rest = text.substr(text.empty() ? 0 : 1);
  if (text.starts_with('#')) {
    qlonglong number = 0;
    std::from_chars(rest.data(), rest.data() + rest.size(), number);
    return number;
  }
  if (text.starts_with('~'))
    return QString::fromUtf8(rest.data(), static_cast<qsizetype>(rest.size())).toDouble();
  if (text.starts_with('$')) return QByteArray(rest.data(), static_cast<qsizetype>(rest.size()));
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

bool isWord(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string_view::npos;
}

/// Executes lines `table.column=value`; ignores those that the database refuses.
void change(DatabaseConnection& database, std::string_view lines) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
    const std::size_t dot = line.find('.'), equals = line.find('=');
    if (dot == std::string_view::npos || equals == std::string_view::npos || dot > equals) continue;
    const std::string_view table = line.substr(0, dot), column = line.substr(dot + 1, equals - dot - 1);
    if (!isWord(table) || !isWord(column)) continue;
    const auto as_text = [](std::string_view word) {
      return QString::fromLatin1(word.data(), static_cast<qsizetype>(word.size()));
    };
    (void)database.execute("UPDATE " + as_text(table) + " SET " + as_text(column) + " = ?",
                           {valueOf(line.substr(equals + 1))});
  }
  // Without checksums, as in older sessions, so that the checks of values are reached.
  for (const char* table :
       {"facts", "frames", "key_frames", "fragments", "regions", "borders", "operations", "pages", "camera",
        "estimates", "objectness", "mask_corrections", "frame_reviews"})
    (void)database.execute(QString("UPDATE %1 SET row_check = NULL").arg(table));
}

void readAll(SessionStore& store) {
  const auto scan = store.load();
  require(scan || !scan.error().what.empty(), "an error has words");
  if (const auto camera = store.loadCamera(); camera && *camera) (void)cameraMemoryFrom((*camera)->words);
  if (!scan) return;
  const auto setup = setupFrom(scan->metadata);
  require(!setup || (setup->K.fx > 0 && setup->K.width > 0), "an accepted camera is usable");
  for (const SavedFrame& frame : scan->frames)
    require(frame.T_world_camera.matrix().allFinite(), "poses are finite");
  for (const SavedBorder& border : scan->borders)
    require(border.a.value > 0 && border.a.value < border.b.value, "a border lies between two fragments");
  for (const auto& [region, log_odds] : scan->objectness)
    require(region.value > 0 && std::isfinite(log_odds), "ratings are finite");
  for (const OperationLog::Entry& entry : scan->operations) {
    if (!entry.operation.correction) continue;
    for (const PaintedPixels* pixels :
         {&entry.operation.correction->added, &entry.operation.correction->removed}) {
      const cv::Mat mask = pixels->mask();
      require(PaintedPixels::of(mask).runs == pixels->runs, "painted pixels are those of a mask");
    }
  }
  EstimatedLabels estimated(0.004F);
  for (const SavedEstimates& brick : scan->estimates) {
    estimated.restore(brick, std::vector<RegionId>(8, RegionId{1}));
    require(!estimated.isEmpty() || estimated.takeChanged().empty(), "restored labels are no change");
  }
  for (const Eigen::Vector3i& position : scan->pages) {
    if (const auto words = store.loadPage(position)) (void)StoredPage::fromWords(*words);
  }
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      seedFile(),
      "pages.offset=#0\npages.bytes=#100\npages.unpacked_bytes=#2048\npages.file=#1\npages.x=#3\n",
      "frames.state=tracking\nframes.tx=~1.5\nframes.qw=~1\nframes.time_s=~0.03\nframes.source_index=#7\n",
      "borders.evidence=$0123456789012345678901234567890123456789\nborders.said=#1\nborders.by_person=#1\n",
      "operations.operation={\"kind\": \"join\", \"regions\": [3, 7]}\noperations.state=undone\n",
      "operations.effect={\"moves\": [[7, 3, 5]]}\nregions.name=red cup\nregions.object=#4\n",
      "facts.value={\"fx\": 525, \"fy\": 525, \"cx\": 319.5, \"cy\": 239.5, \"width\": 640, \"height\": "
      "480}\n",
      "estimates.x=#-9\nestimates.y=#3\nfragments.voxels=#5\n",
      "estimates.cells=$0123456789abcdef\n",
      "objectness.log_odds=~1.5\nobjectness.region=#7\n",
      "mask_corrections.width=#640\nmask_corrections.height=#480\nmask_corrections.operation=#2\n",
      "mask_corrections.added=$\x64\x05\xC8\x01\x07\x03\nmask_corrections.removed=$\x02\x03\n",
      "operations.operation={\"kind\": \"paint\", \"regions\": [3], \"mask\": {\"key_frame\": 2, \"image\": "
      "2, "
      "\"size\": [640, 480]}}\n",
      "operations.operation={\"kind\": \"review\", \"regions\": [], \"image\": 7}\n",
      "frame_reviews.key_frame=#0\nframe_reviews.state=checked\n",
      "fragments.fragment=#12\nfragments.region=#3\nfragments.voxels=#77\n"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string input(reinterpret_cast<const char*>(data), size);
  const bool is_file = input.starts_with(test::kFileHead);
  const std::string& file = is_file ? input : test::seedFile();
  const std::filesystem::path session = test::folder() / "input";
  std::filesystem::remove_all(session);
  std::filesystem::copy(test::folder() / "seed", session, std::filesystem::copy_options::recursive);
  for (const char* name : {"session.sqlite-wal", "session.sqlite-shm"})
    std::filesystem::remove(session / name);
  test::rewrite(test::folder(), "input/session.sqlite", file);
  if (!is_file) {
    const auto database = DatabaseConnection::open((session / "session.sqlite").string());
    if (database) test::change(**database, input);
  }
  (void)listSessions(session);
  const auto store = SessionStore::open(session);
  test::require(store || !store.error().what.empty(), "an error has words");
  if (store) test::readAll(**store);
  return 0;
}
