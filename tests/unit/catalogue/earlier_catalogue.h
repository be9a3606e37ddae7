#pragma once
#include <QByteArray>
#include <QString>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scantrove::test {

/// A catalogue as the version of Scantrove wrote it whose schema had this number. It has seven objects:
///
/// | id | state |
/// |---|---|
/// | 1 | Obj_1, with a view of its own and that of object 3 |
/// | 2 | "blue mug", confirmed |
/// | 3 | merged into object 1 |
/// | 4 | deleted |
/// | 5 | "Obj_5 (2)", which the program gave |
/// | 6 | a name with letters beyond ASCII and with quotes |
/// | 7 | hidden, with discarded views |
class EarlierCatalogue {
 public:
  static constexpr int kObjects = 7;
  static constexpr const char* kNameOfSix =
      "K\xC3\xBC"
      "chen's \"Schl\xC3\xBC"
      "ssel\" \\ ?";
  static constexpr const char* kToken = "6f1d-token";

  /// Writes it into an empty database, or fails the test.
  static void write(const std::string& database, int version);

  /// The number of the seed of randomView() that view `id` shows; the ids of views and objects are equal.
  [[nodiscard]] static int seedOf(std::int64_t view) { return static_cast<int>(view) + 10; }
  /// The thumbnail and the colours that it stores for a view: any bytes.
  [[nodiscard]] static QByteArray thumbnailOf(std::int64_t view);
  [[nodiscard]] static QByteArray colorsOf(std::int64_t view);
};

/// Rows of a table: values by column, as text or bytes; a null has no entry.
using StoredRow = std::map<QString, QByteArray>;

/// All rows of a catalogue by table, ordered by their keys, except for those of the schema's own tables.
[[nodiscard]] std::map<QString, std::vector<StoredRow>> storedRows(const std::string& database);

/// Expects that each value of `before` stands in the same row and column of `after`, which may have more
/// columns and tables.
void expectKept(const std::map<QString, std::vector<StoredRow>>& before,
                const std::map<QString, std::vector<StoredRow>>& after);

}  // namespace scantrove::test
