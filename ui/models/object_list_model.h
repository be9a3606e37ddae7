#pragma once
#include <QAbstractListModel>
#include <QCache>
#include <QImage>
#include <map>
#include <set>
#include <vector>

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
    AddedNowRole,    ///< added by this scan
    SeenSidesRole,   ///< SeenSides in this scan; invalid: not in this scan
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

  [[nodiscard]] ObjectId objectAt(const QModelIndex& index) const;
  [[nodiscard]] QModelIndex indexOf(ObjectId object) const;
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// Known before this scan and recognised in it.
  [[nodiscard]] bool isRecognized(ObjectId object) const { return recognized_.contains(object); }
  /// Number of objects that this scan added after that row.
  [[nodiscard]] int addedAfter(ObjectId object) const;
  [[nodiscard]] int confirmedCount() const { return confirmed_count_; }

 signals:
  void aboutToUpdate();  ///< before rows are added, removed or changed
  void updated();        ///< after that
  /// Between the two signals: both rows exist; that of `from` will be removed.
  void merged(scantrove::ObjectId into, scantrove::ObjectId from);

 private:
  using Rows = std::vector<ObjectRecord>;  ///< by ascending id

  void readAll();
  void applyChanges(const CatalogueChanges& changes);
  void insertOrUpdate(ObjectRecord record);
  void removeObject(ObjectId object);
  [[nodiscard]] Rows::const_iterator positionOf(ObjectId object) const;
  void emitRow(ObjectId object, const QList<int>& roles);
  [[nodiscard]] QImage picture(ObjectId object) const;
  [[nodiscard]] QString toolTip(const ObjectRecord& record) const;

  CatalogueEditor& editor_;
  Rows rows_;
  int confirmed_count_ = 0;
  mutable QCache<std::uint32_t, QImage> pictures_;  ///< cost in bytes
  std::set<ObjectId> in_view_;
  std::set<ObjectId> added_;
  std::set<ObjectId> recognized_;
  std::map<ObjectId, SeenSides> seen_sides_;
};

/// "1 view", "7 views".
[[nodiscard]] QString viewsInWords(int views);
/// "seen from 7 of 12 sides", "seen from all sides".
[[nodiscard]] QString sidesInWords(const SeenSides& seen);

}  // namespace scantrove
