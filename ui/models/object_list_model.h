#pragma once
#include <QAbstractListModel>
#include <QCache>
#include <QColor>
#include <QImage>
#include <map>
#include <set>
#include <vector>

#include "core/catalogue/class_table.h"
#include "core/geometry/view_coverage.h"
#include "core/scan/scan_snapshot.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove {

/// The objects of the catalogue for the object list, newest last, so that new objects do not move rows that
/// the user may be about to click. Updates single rows: reads an object again when it changed, and its
/// picture when it is painted.
class ObjectListModel : public QAbstractListModel {
  Q_OBJECT

 public:
  enum Role {
    ObjectIdRole = Qt::UserRole + 1,
    ConfirmedRole,
    ViewCountRole,
    SizeTextRole,    ///< "12×9×8 cm"
    InViewRole,      ///< seen in the frame shown now
    RecognizedRole,  ///< known before this scan and recognised in it
    AddedNowRole,    ///< added by this scan, and not named or confirmed by a user
    SeenSidesRole,   ///< SeenSides in this scan; invalid: not in this scan
    ClassNameRole,   ///< empty: not classified
    ClassColorRole,  ///< invalid: not classified
    ChangeRole,      ///< how it differs from what was confirmed, a sentence; empty: not at all
  };

  /// A row, as the filter needs it.
  struct Row {
    ObjectRecord record;
    ClassId class_id;    ///< merge root of its class; none: not classified
    QString class_name;  ///< empty: not classified
    QColor class_color;  ///< invalid: not classified
    QString name_key;    ///< lower case
    QString class_key;   ///< lower case
  };

  explicit ObjectListModel(CatalogueEditor& editor, QObject* parent = nullptr);

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

  void beginScan();
  void markAdded(ObjectId object);
  void markRecognized(ObjectId object);
  void setInView(const std::vector<SeenObject>& seen);
  /// For the objects of this scan.
  void setSeenSides(std::map<ObjectId, SeenSides> sides);
  /// Objects that are no longer what a user confirmed, with sentences (ChangeRole).
  void setChanged(std::map<ObjectId, QString> changes);

  [[nodiscard]] ObjectId objectAt(const QModelIndex& index) const;
  [[nodiscard]] QModelIndex indexOf(ObjectId object) const;
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// All rows, by ascending id.
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] bool isInView(ObjectId object) const { return in_view_.contains(object); }
  /// Added or recognised by this scan, or seen in it.
  [[nodiscard]] bool isInScan(ObjectId object) const;
  /// Objects that this scan added, ascending.
  [[nodiscard]] const std::set<ObjectId>& added() const { return added_; }
  [[nodiscard]] bool isChanged(ObjectId object) const { return changed_.contains(object); }
  /// Known before this scan and recognised in it.
  [[nodiscard]] bool isRecognized(ObjectId object) const { return recognized_.contains(object); }
  [[nodiscard]] int confirmedCount() const { return confirmed_count_; }

 signals:
  void aboutToUpdate();  ///< before rows are added, removed or changed
  void updated();        ///< after that
  /// Between the two signals: both rows exist; that of `from` will be removed.
  void merged(scantrove::ObjectId into, scantrove::ObjectId from);

 private:
  using Rows = std::vector<Row>;

  void readAll();
  void applyChanges(const CatalogueChanges& changes);
  [[nodiscard]] Row rowFor(ObjectRecord record) const;
  void insertOrUpdate(ObjectRecord record);
  /// Reads the classes again.
  void updateClasses();
  void removeObject(ObjectId object);
  [[nodiscard]] Rows::const_iterator positionOf(ObjectId object) const;
  void emitRow(ObjectId object, const QList<int>& roles);
  [[nodiscard]] QImage picture(ObjectId object) const;
  [[nodiscard]] QString toolTip(const Row& row) const;

  CatalogueEditor& editor_;
  ClassTable classes_;
  Rows rows_;
  int confirmed_count_ = 0;
  mutable QCache<std::uint32_t, QImage> pictures_;  ///< cost in bytes
  std::set<ObjectId> in_view_;
  std::set<ObjectId> added_;
  std::set<ObjectId> recognized_;
  std::map<ObjectId, SeenSides> seen_sides_;
  std::map<ObjectId, QString> changed_;
};

/// "12 × 9 × 8 cm".
[[nodiscard]] QString sizeInWords(const Eigen::Vector3f& size_m);
/// "1 view", "7 views".
[[nodiscard]] QString viewsInWords(int views);
/// "seen from 7 of 12 sides", "seen from all sides".
[[nodiscard]] QString sidesInWords(const SeenSides& seen);

}  // namespace scantrove
