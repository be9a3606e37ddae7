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

#include "core/base/text.h"
#include "core/fusion/packed_words.h"
#include "core/session/checked_rows.h"
#include "core/session/operation_json.h"
#include "core/session/recording_rows.h"
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
  const std::array<float, kEvidenceFloats> values{e.observations,
                                                  e.bridged,
                                                  e.shared,
                                                  e.bends,
                                                  e.concavity_rad,
                                                  kNoMore,
                                                  e.folded,
                                                  e.ridged,
                                                  e.color_shift.value_or(kUnseen),
                                                  e.length_m,
                                                  e.appeared_together,
                                                  e.appeared_apart,
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
  e.observations = values[0];
  e.bridged = values[1];
  e.shared = values[2];
  e.bends = values[3];
  e.concavity_rad = values[4];
  e.folded = values[6];
  e.ridged = values[7];
  if (std::isfinite(values[8])) e.color_shift = values[8];
  e.length_m = values[9];
  e.appeared_together = values[10];
  e.appeared_apart = values[11];
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
                             TrackingState::relocalized};

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

QVariant orNull(const std::optional<std::uint32_t>& checksum) {
  return checksum ? QVariant(*checksum) : QVariant();
}

Result<void> writeFrames(DatabaseConnection& database, const SavedDelta& delta) {
  for (const SavedFrame& frame : delta.frames) {
    const Eigen::Vector3d t = frame.T_world_camera.translation();
    const Eigen::Quaterniond q(frame.T_world_camera.linear());
    SCANTROVE_TRY(put(database, "frames",
                      {{"number", frame.number},
                       {"source_index", frame.source_index},
                       {"time_s", frame.time_s},
                       {"state", QString(toString(frame.state))},
                       {"tx", t.x()},
                       {"ty", t.y()},
                       {"tz", t.z()},
                       {"qx", q.x()},
                       {"qy", q.y()},
                       {"qz", q.z()},
                       {"qw", q.w()}}));
  }
  if (!delta.frames.empty()) SCANTROVE_TRY(seal(database, "frames"));
  for (const SavedKeyFrame& key : delta.key_frames) {
    SCANTROVE_TRY(put(database, "key_frames",
                      {{"number", key.frame},
                       {"color_file", text(key.color_file.generic_string())},
                       {"depth_file", text(key.depth_file.generic_string())},
                       {"metres_per_unit", static_cast<double>(key.meters_per_unit)},
                       {"color", text(colorToJson(key))},
                       {"color_checksum", orNull(key.color_checksum)},
                       {"depth_checksum", orNull(key.depth_checksum)}}));
  }
  return delta.key_frames.empty() ? Result<void>() : seal(database, "key_frames");
}

Result<void> writeFragments(DatabaseConnection& database, const std::vector<SavedFragment>& fragments) {
  for (const SavedFragment& one : fragments) {
    if (one.region) {
      SCANTROVE_TRY(put(database, "fragments",
                        {{"fragment", one.fragment.value},
                         {"region", one.region.value},
                         {"voxels", one.voxels},
                         {"seen_from", toBytes(one.seen_from)}}));
    } else {
      SCANTROVE_TRY(database.execute("DELETE FROM fragments WHERE fragment = ?", {one.fragment.value}));
    }
  }
  return fragments.empty() ? Result<void>() : seal(database, "fragments");
}

Result<void> writeRegions(DatabaseConnection& database, const std::vector<SavedRegion>& regions) {
  for (const SavedRegion& one : regions) {
    SCANTROVE_TRY(put(database, "regions",
                      {{"region", one.region.value},
                       {"object", one.object.value},
                       {"name", text(one.note.name)},
                       {"category", text(one.note.category)},
                       {"background", one.note.background},
                       {"is_object", one.note.object},
                       {"rejected", one.note.rejected}}));
  }
  return regions.empty() ? Result<void>() : seal(database, "regions");
}

Result<void> writeBorders(DatabaseConnection& database, const std::vector<SavedBorder>& borders) {
  for (const SavedBorder& one : borders) {
    if (one.evidence) {
      SCANTROVE_TRY(put(database, "borders",
                        {{"a", one.a.value},
                         {"b", one.b.value},
                         {"evidence", toBytes(*one.evidence)},
                         {"said", static_cast<int>(one.evidence->constraint)},
                         {"by_person", one.evidence->by_person},
                         {"said_order", one.evidence->constraint_order}}));
    } else {
      SCANTROVE_TRY(
          database.execute("DELETE FROM borders WHERE a = ? AND b = ?", {one.a.value, one.b.value}));
    }
  }
  return borders.empty() ? Result<void>() : seal(database, "borders");
}

Result<void> writeOperations(DatabaseConnection& database, const SavedDelta& delta) {
  for (const OperationLog::Entry& entry : delta.operations) {
    const std::array<Column, 4> columns{{{"number", entry.number},
                                         {"state", wordFor(entry.state)},
                                         {"operation", text(operationToJson(entry.operation))},
                                         {"effect", text(effectToJson(entry.effect))}}};
    // When it was done stays when it is undone, and is not part of the checksum. The number may be that of a
    // damaged row, which was left out.
    SCANTROVE_TRY(database.execute(
        "INSERT INTO operations (number, state, operation, effect, row_check, done) VALUES (?, ?, ?, ?, ?, ?)"
        " ON CONFLICT (number) DO UPDATE SET state = excluded.state, operation = excluded.operation, effect "
        "= "
        "excluded.effect, row_check = excluded.row_check",
        {columns[0].value, columns[1].value, columns[2].value, columns[3].value, checkOf(columns),
         DatabaseConnection::now()}));
  }
  return delta.operations.empty() ? Result<void>() : seal(database, "operations");
}

Result<void> writeCamera(DatabaseConnection& database, const SavedCamera& camera) {
  const PackedWords packed = packWords(camera.words);
  SCANTROVE_TRY(put(database, "camera",
                    {{"one", 1},
                     {"frame", camera.frame},
                     {"packed", QByteArray(packed.bytes.data(), std::ssize(packed.bytes))},
                     {"unpacked_bytes", packed.unpacked_bytes},
                     {"checksum", static_cast<qlonglong>(packed.checksum)}}));
  return seal(database, "camera");
}

Result<void> writeMetadata(DatabaseConnection& database, const SessionMetadata& metadata) {
  if (metadata.empty()) return {};
  for (const char* table : {"facts", "fact_copies"}) {
    for (const auto& [name, value] : metadata)
      SCANTROVE_TRY(put(database, table, {{"name", text(name)}, {"value", text(value)}}));
    SCANTROVE_TRY(seal(database, table));
  }
  return {};
}

/// A table as it is read.
struct Reading {
  const char* table;
  const char* sql;
  const char* called;
};

/// Reads all rows: take(row) gives false for one that is not what it should be. Rows that do not match their
/// checksum are left out, too.
template <class Take>
Result<void> readRows(DatabaseConnection& database, const Reading& reading, std::vector<std::string>& damages,
                      Take&& take) {
  Result<QSqlQuery> rows = database.execute(reading.sql);
  if (!rows) return fail(rows.error());
  RowAudit audit(*rows);
  int bad = 0;
  while (rows->next()) bad += audit.take(*rows) && take(*rows) ? 0 : 1;
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " " + reading.called + " of the session in " + database.file() +
                      " cannot be read and are left out.");
  const Result<std::string> rest = audit.close(database, reading.table, reading.called, *rows);
  if (!rest) return fail(rest.error());
  if (!rest->empty()) damages.push_back(*rest);
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

/// None: the image is of an earlier version.
std::optional<std::uint32_t> checksumAt(const QSqlQuery& row, const char* column) {
  const QVariant value = row.value(QLatin1String(column));
  return value.isNull() ? std::nullopt : std::optional(static_cast<std::uint32_t>(value.toLongLong()));
}

std::optional<SavedKeyFrame> keyFrameFrom(const QSqlQuery& row) {
  SavedKeyFrame key;
  key.frame = row.value(0).toInt();
  key.color_file = text(row, 1);
  key.depth_file = text(row, 2);
  key.meters_per_unit = row.value(3).toFloat();
  key.color_checksum = checksumAt(row, "color_checksum");
  key.depth_checksum = checksumAt(row, "depth_checksum");
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

/// Places that are relative to another one are not those of the recording.
bool isOrigin(const std::string& value) {
  const auto numbers = parseNumbers(value);
  return numbers && numbers->size() == 3 &&
         std::ranges::all_of(*numbers, [](double number) { return std::abs(number) <= kFarthest_m; });
}

bool isMetadataEntry(const std::string& name, const std::string& value) {
  if (name == "origin_m") return isOrigin(value);
  if (name != "last_region") return true;  // new regions are counted on from this one
  const bool is_number = !value.empty() && value.size() < 11 &&
                         std::ranges::all_of(value, [](char c) { return c >= '0' && c <= '9'; });
  return is_number && std::stoll(value) <= kRegions.most;
}

/// Facts and their copies: a fact that is damaged or gone is taken from its copy.
Result<SessionMetadata> readMetadata(DatabaseConnection& database, std::vector<std::string>& damages) {
  SessionMetadata metadata, copies;
  const auto addTo = [](SessionMetadata& list) {
    return [&list](const QSqlQuery& row) {
      if (!isMetadataEntry(text(row, 0), text(row, 1))) return false;
      list[text(row, 0)] = text(row, 1);
      return true;
    };
  };
  std::vector<std::string> of_metadata, of_copies;
  SCANTROVE_TRY(readRows(database, {"facts", "SELECT * FROM facts", "facts"}, of_metadata, addTo(metadata)));
  SCANTROVE_TRY(readRows(database, {"fact_copies", "SELECT * FROM fact_copies", "copies of facts"}, of_copies,
                         addTo(copies)));
  const std::size_t sound = metadata.size();
  metadata.insert(copies.begin(), copies.end());
  if (metadata.size() > sound)
    of_metadata = {std::to_string(metadata.size() - sound) + " facts of the session in " + database.file() +
                   " are damaged and were taken from their copies."};
  damages.insert(damages.end(), of_metadata.begin(), of_metadata.end());
  damages.insert(damages.end(), of_copies.begin(), of_copies.end());
  return metadata;
}

}  // namespace

Result<void> write(DatabaseConnection& database, const SavedDelta& delta) {
  SCANTROVE_TRY(writeMetadata(database, delta.metadata));
  SCANTROVE_TRY(writeRecordings(database, delta.recordings));
  SCANTROVE_TRY(writeFrames(database, delta));
  SCANTROVE_TRY(writeFragments(database, delta.fragments));
  SCANTROVE_TRY(writeRegions(database, delta.regions));
  SCANTROVE_TRY(writeBorders(database, delta.borders));
  if (delta.camera) SCANTROVE_TRY(writeCamera(database, *delta.camera));
  return writeOperations(database, delta);
}

Result<SavedScan> read(DatabaseConnection& database, std::vector<std::string>& damages) {
  SavedScan scan;
  SCANTROVE_TRY(moveInto(scan.metadata, readMetadata(database, damages)));
  SCANTROVE_TRY(moveInto(scan.recordings, readRecordings(database, damages)));
  const auto readTable = [&](const Reading& reading, auto& list, auto from) {
    return readRows(database, reading, damages, addTo(list, from));
  };
  SCANTROVE_TRY(
      readTable({"frames", "SELECT * FROM frames ORDER BY number", "frames"}, scan.frames, frameFrom));
  SCANTROVE_TRY(readTable({"key_frames", "SELECT * FROM key_frames ORDER BY number", "key frames"},
                          scan.key_frames, keyFrameFrom));
  SCANTROVE_TRY(readTable({"fragments", "SELECT * FROM fragments ORDER BY fragment", "fragments"},
                          scan.fragments, fragmentFrom));
  SCANTROVE_TRY(
      readTable({"regions", "SELECT * FROM regions ORDER BY region", "regions"}, scan.regions, regionFrom));
  SCANTROVE_TRY(
      readTable({"borders", "SELECT * FROM borders ORDER BY a, b", "borders"}, scan.borders, borderFrom));
  SCANTROVE_TRY(readTable(
      {"operations", "SELECT number, state, operation, effect, row_check FROM operations ORDER BY number",
       "operations"},
      scan.operations, operationFrom));
  return scan;
}

Result<std::optional<SavedCamera>> readCamera(DatabaseConnection& database) {
  Result<QSqlQuery> row =
      database.execute("SELECT frame, packed, unpacked_bytes, checksum, one, row_check FROM camera");
  if (!row) return fail(row.error());
  RowAudit audit(*row);
  if (!row->next() || !audit.take(*row)) return std::nullopt;
  const QByteArray bytes = row->value(1).toByteArray();
  auto words = unpackWords({{bytes.begin(), bytes.end()},
                            row->value(2).toUInt(),
                            static_cast<std::uint64_t>(row->value(3).toLongLong())});
  if (!words) return std::nullopt;
  return SavedCamera{row->value(0).toInt(), std::move(*words)};
}

}  // namespace scantrove::rows
