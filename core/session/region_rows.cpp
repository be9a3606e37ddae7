#include "core/session/region_rows.h"

#include <algorithm>
#include <optional>

#include "core/session/evidence_bytes.h"
#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

QByteArray coverageToBytes(const ViewCoverage& coverage) {
  QByteArray bytes(coverage.cells().none() ? 0 : ViewCoverage::kCells / 8, 0);
  for (qsizetype i = 0; i < 8 * bytes.size(); ++i) {
    if (coverage.cells()[static_cast<std::size_t>(i)])
      bytes[i / 8] = static_cast<char>(bytes[i / 8] | 1 << i % 8);
  }
  return bytes;
}

ViewCoverage coverageFromBytes(const QByteArray& bytes) {
  ViewCoverage::Cells cells;
  for (qsizetype i = 0; i < std::min<qsizetype>(8 * bytes.size(), ViewCoverage::kCells); ++i)
    cells[static_cast<std::size_t>(i)] = (bytes[i / 8] >> i % 8 & 1) != 0;
  return ViewCoverage(cells);
}

Result<void> writeFragments(DatabaseConnection& database, const std::vector<SavedFragment>& fragments) {
  for (const SavedFragment& one : fragments) {
    if (one.region) {
      SCANTROVE_TRY(put(database, "fragments",
                        {{"fragment", one.fragment.value},
                         {"region", one.region.value},
                         {"voxels", one.voxels},
                         {"seen_from", coverageToBytes(one.seen_from)},
                         {"seen_pixels", double{one.support_pixels.seen}},
                         {"support_pixels", double{one.support_pixels.support}},
                         {"carried_pixels", double{one.support_pixels.carried}}}));
    } else {
      SCANTROVE_TRY(database.execute("DELETE FROM fragments WHERE fragment = ?", {one.fragment.value}));
    }
  }
  return fragments.empty() ? Result<void>() : seal(database, "fragments");
}

Result<void> writeNotes(DatabaseConnection& database, const std::vector<SavedRegion>& regions) {
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
                         {"evidence", evidenceToBytes(*one.evidence)},
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

/// None: no numbers of pixels.
std::optional<SupportPixels> supportPixelsAt(const QSqlQuery& row, int first_column) {
  constexpr float kMostPixels = 1e30F;
  const auto number = [&](int column) { return row.value(first_column + column).toFloat(); };
  const SupportPixels pixels{number(0), number(1), number(2)};
  const bool are_parts = pixels.support >= 0 && pixels.carried >= 0 && pixels.support <= pixels.seen &&
                         pixels.carried <= pixels.seen;
  return are_parts && pixels.seen <= kMostPixels ? std::optional(pixels) : std::nullopt;
}

std::optional<SavedFragment> fragmentFrom(const QSqlQuery& row) {
  const QByteArray seen_from = row.value(3).toByteArray();
  const auto support_pixels = supportPixelsAt(row, 4);
  const bool is_coverage = seen_from.isEmpty() || seen_from.size() == ViewCoverage::kCells / 8;
  if (!integerAt(row, 0, kFragments) || !integerAt(row, 1, kRegions) || !integerAt(row, 2, kCounts) ||
      !is_coverage || !support_pixels)
    return std::nullopt;
  return SavedFragment{FragmentId{row.value(0).toUInt()}, RegionId{row.value(1).toUInt()},
                       row.value(2).toInt(), coverageFromBytes(seen_from), *support_pixels};
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
  std::optional<BorderEvidence> evidence = evidenceFromBytes(row.value(2).toByteArray());
  if (!a || !b || *a >= *b || !evidence || !isPlausible(*evidence)) return std::nullopt;
  if (!integerAt(row, 3, {0, 2}) || !integerAt(row, 4, kFlags) || !integerAt(row, 5, kCounts))
    return std::nullopt;
  evidence->constraint = static_cast<LinkConstraint>(row.value(3).toInt());
  evidence->by_person = row.value(4).toBool();
  evidence->constraint_order = row.value(5).toInt();
  return SavedBorder{FragmentId{row.value(0).toUInt()}, FragmentId{row.value(1).toUInt()}, evidence};
}

}  // namespace

Result<void> writeRegions(DatabaseConnection& database, const SavedDelta& delta) {
  SCANTROVE_TRY(writeFragments(database, delta.fragments));
  SCANTROVE_TRY(writeNotes(database, delta.regions));
  return writeBorders(database, delta.borders);
}

Result<void> readRegions(DatabaseConnection& database, SavedScan& scan, std::vector<std::string>& damages) {
  SCANTROVE_TRY(readTable(database,
                          {"fragments",
                           "SELECT fragment, region, voxels, seen_from, seen_pixels, support_pixels,"
                           " carried_pixels, row_check FROM fragments ORDER BY fragment",
                           "fragments"},
                          damages, scan.fragments, fragmentFrom));
  SCANTROVE_TRY(readTable(database, {"regions", "SELECT * FROM regions ORDER BY region", "regions"}, damages,
                          scan.regions, regionFrom));
  return readTable(database, {"borders", "SELECT * FROM borders ORDER BY a, b", "borders"}, damages,
                   scan.borders, borderFrom);
}

}  // namespace scantrove::rows
