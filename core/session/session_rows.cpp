#include "core/session/session_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "core/fusion/packed_words.h"
#include "core/session/operation_json.h"
#include "core/session/row_checks.h"

namespace scantrove::rows {
namespace {

using Json = nlohmann::ordered_json;

QString text(const std::string& value) { return QString::fromStdString(value); }
std::string text(const QSqlQuery& row, int column) { return row.value(column).toString().toStdString(); }

constexpr std::size_t kEvidenceFloats = 21;
/// Before arrivals, attachments, steps and colours on the whole, and what colours two share, were evidence.
constexpr std::array<std::size_t, 4> kFewerFloats{10, 12, 14, 17};
constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();  // a colour
constexpr float kNoMore = 0;                                        // what was evidence once
static_assert(std::endian::native == std::endian::little);

QByteArray toBytes(const BorderEvidence& e) {
  const ColorComparison unseen{kUnseen, kUnseen};
  const ColorComparison& colors = e.colors ? *e.colors : unseen;
  const std::array<float, kEvidenceFloats> values{e.looks,
                                                  e.bridged,
                                                  e.shared,
                                                  e.bends,
                                                  e.concavity_rad,
                                                  kNoMore,
                                                  e.folded,
                                                  e.ridged,
                                                  e.color_shift.value_or(kUnseen),
                                                  e.length_m,
                                                  e.came_together,
                                                  e.came_apart,
                                                  e.attached,
                                                  e.unattached,
                                                  colors.difference,
                                                  colors.chroma_difference,
                                                  e.step_m,
                                                  colors.shared,
                                                  colors.shared_chroma,
                                                  colors.elsewhere,
                                                  colors.variety};
  return {reinterpret_cast<const char*>(values.data()), static_cast<qsizetype>(sizeof(values))};
}

std::optional<BorderEvidence> evidenceFrom(const QByteArray& bytes) {
  std::array<float, kEvidenceFloats> values{};
  const ColorComparison usual;  // an older row lacks the last of these, or all
  values[14] = values[15] = kUnseen;
  values[17] = usual.shared;
  values[18] = usual.shared_chroma;
  values[19] = usual.elsewhere;
  values[20] = usual.variety;
  const auto size = static_cast<std::size_t>(bytes.size());
  const bool is_older = std::ranges::any_of(
      kFewerFloats, [size](std::size_t floats) { return size == floats * sizeof(float); });
  if (size != sizeof(values) && !is_older) return std::nullopt;
  std::memcpy(values.data(), bytes.constData(), size);
  constexpr std::array<std::size_t, 3> kColors{8, 14, 15};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) && std::ranges::find(kColors, i) == kColors.end()) return std::nullopt;
  }
  BorderEvidence e;
  e.looks = values[0];
  e.bridged = values[1];
  e.shared = values[2];
  e.bends = values[3];
  e.concavity_rad = values[4];
  e.folded = values[6];
  e.ridged = values[7];
  if (std::isfinite(values[8])) e.color_shift = values[8];
  e.length_m = values[9];
  e.came_together = values[10];
  e.came_apart = values[11];
  e.attached = values[12];
  e.unattached = values[13];
  if (std::isfinite(values[14] + values[15]))
    e.colors = {values[14], values[15], values[17], values[18], values[19], values[20]};
  e.step_m = values[16];
  return e;
}

QByteArray toBytes(const ViewCoverage& coverage) {
  QByteArray bytes(coverage.cells().none() ? 0 : ViewCoverage::kCells / 8, 0);
  for (qsizetype i = 0; i < 8 * bytes.size(); ++i) {
    if (coverage.cells()[static_cast<std::size_t>(i)])
      bytes[i / 8] = static_cast<char>(bytes[i / 8] | 1 << i % 8);
  }
  return bytes;
}

ViewCoverage coverageFrom(const QByteArray& bytes) {
  ViewCoverage::Cells cells;
  for (qsizetype i = 0; i < std::min<qsizetype>(8 * bytes.size(), ViewCoverage::kCells); ++i)
    cells[static_cast<std::size_t>(i)] = (bytes[i / 8] >> i % 8 & 1) != 0;
  return ViewCoverage(cells);
}

/// Size and, where colour has a camera of its own, that camera.
std::string colorToJson(const SavedKeyFrame& key) {
  Json json{{"size", {key.color_width, key.color_height}}};
  if (!key.color_camera) return json.dump();
  Json T = Json::array();
  for (int i = 0; i < 12; ++i) T.push_back(key.color_camera->T_color_depth.matrix()(i / 4, i % 4));
  const Intrinsics& K = key.color_camera->K;
  json["K"] = {K.fx, K.fy, K.cx, K.cy};
  json["K_size"] = {K.width, K.height};
  json["T_color_depth"] = T;
  return json.dump();
}

/// False: it is not what was written.
bool readColor(const std::string& written, SavedKeyFrame& key) {
  try {
    const Json json = Json::parse(written);
    const auto sizeOf = [&](const char* name) {
      return std::pair(json.at(name).at(0).get<int>(), json.at(name).at(1).get<int>());
    };
    std::tie(key.color_width, key.color_height) = sizeOf("size");
    if (!json.contains("K")) return true;
    const auto [width, height] = sizeOf("K_size");
    const auto number = [&](std::size_t i) { return json.at("K").at(i).get<float>(); };
    ColorCamera camera;
    camera.K = {number(0), number(1), number(2), number(3), width, height};
    for (int i = 0; i < 12; ++i)
      camera.T_color_depth.matrix()(i / 4, i % 4) =
          json.at("T_color_depth").at(static_cast<std::size_t>(i)).get<double>();
    key.color_camera = camera;
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

constexpr std::array kStates{TrackingState::tracking, TrackingState::uncertain, TrackingState::lost,
                             TrackingState::relocalised};

std::optional<TrackingState> stateFrom(const std::string& word) {
  for (const TrackingState state : kStates) {
    if (word == toString(state)) return state;
  }
  return std::nullopt;
}

using LogState = OperationLog::State;
constexpr std::array<std::pair<LogState, const char*>, 3> kLogStates{
    {{LogState::done, "done"}, {LogState::undone, "undone"}, {LogState::superseded, "superseded"}}};

QString wordFor(LogState state) {
  for (const auto& [one, word] : kLogStates) {
    if (one == state) return word;
  }
  return "";
}

std::optional<LogState> logStateFrom(const std::string& word) {
  for (const auto& [state, known] : kLogStates) {
    if (word == known) return state;
  }
  return std::nullopt;
}

Result<void> writeFrames(DatabaseConnection& database, const SavedDelta& delta) {
  for (const SavedFrame& frame : delta.frames) {
    const Eigen::Vector3d t = frame.T_world_camera.translation();
    const Eigen::Quaterniond q(frame.T_world_camera.linear());
    SCANTROVE_TRY(
        database.execute("INSERT OR REPLACE INTO frames VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                         {frame.number, frame.source_index, frame.time_s, QString(toString(frame.state)),
                          t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}));
  }
  for (const SavedKeyFrame& key : delta.key_frames) {
    SCANTROVE_TRY(database.execute(
        "INSERT OR REPLACE INTO key_frames VALUES (?, ?, ?, ?, ?)",
        {key.frame, text(key.color_file.generic_string()), text(key.depth_file.generic_string()),
         static_cast<double>(key.metres_per_unit), text(colorToJson(key))}));
  }
  return {};
}

Result<void> writeRegions(DatabaseConnection& database, const SavedDelta& delta) {
  for (const SavedFragment& one : delta.fragments) {
    if (one.region) {
      SCANTROVE_TRY(
          database.execute("INSERT OR REPLACE INTO fragments VALUES (?, ?, ?, ?)",
                           {one.fragment.value, one.region.value, one.voxels, toBytes(one.seen_from)}));
    } else {
      SCANTROVE_TRY(database.execute("DELETE FROM fragments WHERE fragment = ?", {one.fragment.value}));
    }
  }
  for (const SavedRegion& one : delta.regions) {
    SCANTROVE_TRY(
        database.execute("INSERT OR REPLACE INTO regions VALUES (?, ?, ?, ?, ?, ?, ?)",
                         {one.region.value, one.object.value, text(one.note.name), text(one.note.category),
                          one.note.background, one.note.object, one.note.rejected}));
  }
  for (const SavedBorder& one : delta.borders) {
    if (one.evidence) {
      SCANTROVE_TRY(database.execute(
          "INSERT OR REPLACE INTO borders VALUES (?, ?, ?, ?, ?, ?)",
          {one.a.value, one.b.value, toBytes(*one.evidence), static_cast<int>(one.evidence->constraint),
           one.evidence->by_person, one.evidence->constraint_order}));
    } else {
      SCANTROVE_TRY(
          database.execute("DELETE FROM borders WHERE a = ? AND b = ?", {one.a.value, one.b.value}));
    }
  }
  return {};
}

Result<void> writeOperations(DatabaseConnection& database, const SavedDelta& delta) {
  for (const OperationLog::Entry& entry : delta.operations) {
    // When it was done stays when it is undone. The number may be that of a damaged row, which was left out.
    SCANTROVE_TRY(database.execute(
        "INSERT INTO operations VALUES (?, ?, ?, ?, ?) ON CONFLICT (number) DO UPDATE SET state = "
        "excluded.state, operation = excluded.operation, effect = excluded.effect",
        {entry.number, wordFor(entry.state), text(operationToJson(entry.operation)),
         text(effectToJson(entry.effect)), DatabaseConnection::now()}));
  }
  return {};
}

Result<void> writeCamera(DatabaseConnection& database, const SavedCamera& camera) {
  const PackedWords packed = packWords(camera.words);
  SCANTROVE_TRY(database.execute("INSERT OR REPLACE INTO camera VALUES (1, ?, ?, ?, ?)",
                                 {camera.frame, QByteArray(packed.bytes.data(), std::ssize(packed.bytes)),
                                  packed.unpacked_bytes, static_cast<qlonglong>(packed.checksum)}));
  return {};
}

/// Reads all rows of `sql`: take(row) gives false for one that is not what it should be.
template <class Take>
Result<void> readRows(DatabaseConnection& database, const char* sql, const char* called,
                      std::vector<std::string>& damages, Take&& take) {
  Result<QSqlQuery> rows = database.execute(sql);
  if (!rows) return fail(rows.error());
  int bad = 0;
  while (rows->next()) bad += take(*rows) ? 0 : 1;
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " " + called + " of the session in " + database.file() +
                      " cannot be read and are left out.");
  return {};
}

std::optional<SavedFrame> frameFrom(const QSqlQuery& row) {
  const auto pose = poseAt(row, 4);
  const auto state = stateFrom(text(row, 3));
  SavedFrame frame;
  frame.time_s = row.value(2).toDouble();
  if (!pose || !state || !areIntegers(row, 0, 1, kCounts) || !std::isfinite(frame.time_s))
    return std::nullopt;
  frame.number = row.value(0).toInt();
  frame.source_index = row.value(1).toInt();
  frame.state = *state;
  frame.T_world_camera = *pose;
  return frame;
}

std::optional<SavedKeyFrame> keyFrameFrom(const QSqlQuery& row) {
  SavedKeyFrame key;
  key.frame = row.value(0).toInt();
  key.color_file = text(row, 1);
  key.depth_file = text(row, 2);
  key.metres_per_unit = row.value(3).toFloat();
  if (!integerAt(row, 0, kCounts) || !readColor(text(row, 4), key) || !isPlausible(key)) return std::nullopt;
  return key;
}

std::optional<SavedFragment> fragmentFrom(const QSqlQuery& row) {
  const QByteArray seen_from = row.value(3).toByteArray();
  const bool is_coverage = seen_from.isEmpty() || seen_from.size() == ViewCoverage::kCells / 8;
  if (!integerAt(row, 0, kFragments) || !integerAt(row, 1, kRegions) || !integerAt(row, 2, kCounts) ||
      !is_coverage)
    return std::nullopt;
  return SavedFragment{FragmentId{row.value(0).toUInt()}, RegionId{row.value(1).toUInt()},
                       row.value(2).toInt(), coverageFrom(seen_from)};
}

std::optional<SavedRegion> regionFrom(const QSqlQuery& row) {
  const bool is_region =
      integerAt(row, 0, kRegions) && integerAt(row, 1, {0, kRegions.most}) && areIntegers(row, 4, 6, kFlags);
  if (!is_region) return std::nullopt;
  return SavedRegion{
      RegionId{row.value(0).toUInt()},
      ObjectId{row.value(1).toUInt()},
      {text(row, 2), text(row, 3), row.value(4).toBool(), row.value(5).toBool(), row.value(6).toBool()}};
}

std::optional<SavedBorder> borderFrom(const QSqlQuery& row) {
  const auto a = integerAt(row, 0, kFragments), b = integerAt(row, 1, kFragments);
  std::optional<BorderEvidence> evidence = evidenceFrom(row.value(2).toByteArray());
  if (!a || !b || *a >= *b || !evidence || !isPlausible(*evidence)) return std::nullopt;
  if (!integerAt(row, 3, {0, 2}) || !integerAt(row, 4, kFlags) || !integerAt(row, 5, kCounts))
    return std::nullopt;
  evidence->constraint = static_cast<LinkConstraint>(row.value(3).toInt());
  evidence->by_person = row.value(4).toBool();
  evidence->constraint_order = row.value(5).toInt();
  return SavedBorder{FragmentId{row.value(0).toUInt()}, FragmentId{row.value(1).toUInt()}, evidence};
}

std::optional<OperationLog::Entry> operationFrom(const QSqlQuery& row) {
  const auto state = logStateFrom(text(row, 1));
  auto operation = operationFromJson(text(row, 2));
  auto effect = effectFromJson(text(row, 3));
  if (!integerAt(row, 0, {1, kCounts.most}) || !state || !operation || !effect) return std::nullopt;
  if (!isPlausible(*operation) || !isPlausible(*effect)) return std::nullopt;
  return OperationLog::Entry{row.value(0).toInt(), std::move(*operation), std::move(*effect), *state};
}

/// For readRows().
template <class Row>
auto addTo(std::vector<Row>& list, std::optional<Row> (*from)(const QSqlQuery&)) {
  return [&list, from](const QSqlQuery& row) {
    std::optional<Row> read = from(row);
    if (read) list.push_back(std::move(*read));
    return read.has_value();
  };
}

/// New regions are counted on from this one.
bool isFact(const std::string& name, const std::string& value) {
  if (name != "last_region") return true;
  const bool is_number = !value.empty() && value.size() < 11 &&
                         std::ranges::all_of(value, [](char c) { return c >= '0' && c <= '9'; });
  return is_number && std::stoll(value) <= kRegions.most;
}

}  // namespace

Result<void> write(DatabaseConnection& database, const SavedDelta& delta) {
  for (const auto& [name, value] : delta.facts) {
    SCANTROVE_TRY(database.execute("INSERT OR REPLACE INTO facts VALUES (?, ?)", {text(name), text(value)}));
  }
  SCANTROVE_TRY(writeFrames(database, delta));
  SCANTROVE_TRY(writeRegions(database, delta));
  if (delta.camera) SCANTROVE_TRY(writeCamera(database, *delta.camera));
  return writeOperations(database, delta);
}

Result<SavedScan> read(DatabaseConnection& database, std::vector<std::string>& damages) {
  SavedScan scan;
  SCANTROVE_TRY(readRows(database, "SELECT name, value FROM facts", "facts", damages, [&](QSqlQuery& row) {
    if (!isFact(text(row, 0), text(row, 1))) return false;
    scan.facts[text(row, 0)] = text(row, 1);
    return true;
  }));
  SCANTROVE_TRY(readRows(database, "SELECT * FROM frames ORDER BY number", "frames", damages,
                         addTo(scan.frames, frameFrom)));
  SCANTROVE_TRY(readRows(database, "SELECT * FROM key_frames ORDER BY number", "key frames", damages,
                         addTo(scan.key_frames, keyFrameFrom)));
  SCANTROVE_TRY(readRows(database, "SELECT * FROM fragments ORDER BY fragment", "fragments", damages,
                         addTo(scan.fragments, fragmentFrom)));
  SCANTROVE_TRY(readRows(database, "SELECT * FROM regions ORDER BY region", "regions", damages,
                         addTo(scan.regions, regionFrom)));
  SCANTROVE_TRY(readRows(database, "SELECT * FROM borders ORDER BY a, b", "borders", damages,
                         addTo(scan.borders, borderFrom)));
  SCANTROVE_TRY(readRows(database, "SELECT number, state, operation, effect FROM operations ORDER BY number",
                         "operations", damages, addTo(scan.operations, operationFrom)));
  return scan;
}

Result<std::optional<SavedCamera>> readCamera(DatabaseConnection& database) {
  Result<QSqlQuery> row = database.execute("SELECT frame, packed, unpacked_bytes, checksum FROM camera");
  if (!row) return fail(row.error());
  if (!row->next()) return std::nullopt;
  const QByteArray bytes = row->value(1).toByteArray();
  auto words = unpackWords({{bytes.begin(), bytes.end()},
                            row->value(2).toUInt(),
                            static_cast<std::uint64_t>(row->value(3).toLongLong())});
  if (!words) return std::nullopt;
  return SavedCamera{row->value(0).toInt(), std::move(*words)};
}

}  // namespace scantrove::rows
