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

/// The catalogue's objects as the object list shows them, the newest last: what a scan adds moves no row that
/// a person may be about to click. Follows the catalogue row by row: reads an object again when something
/// happened to it, and its picture when that is to be painted.
class ObjectListModel : public QAbstractListModel {
  Q_OBJECT

 public:
  enum Role {
    ObjectIdRole = Qt::UserRole + 1,
    ConfirmedRole,
    ViewCountRole,
    SizeTextRole,    ///< "12×9×8 cm"
    InViewRole,      ///< seen in the frame shown now
    RecognizedRole,  ///< known before this scan and met in it
    AddedNowRole,    ///< added by this scan
    SeenSidesRole,   ///< SeenSides, in this scan; invalid: it is not in it
  };

  explicit ObjectListModel(CatalogueEditor& editor, QObject* parent = nullptr);

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

  void beginScan();
  void markAdded(ObjectId object);
  void markRecognized(ObjectId object);
  void setInView(const std::vector<SeenObject>& seen);
  /// Of the objects that this scan has.
  void setSeenSides(std::map<ObjectId, SeenSides> sides);

  [[nodiscard]] ObjectId objectAt(const QModelIndex& index) const;
  [[nodiscard]] QModelIndex indexOf(ObjectId object) const;
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  /// Known before this scan and met in it.
  [[nodiscard]] bool isRecognized(ObjectId object) const { return recognized_.contains(object); }
  /// How many rows after that one this scan has added.
  [[nodiscard]] int addedAfter(ObjectId object) const;
  [[nodiscard]] int confirmedCount() const { return confirmed_count_; }

 signals:
  void aboutToUpdate();  ///< rows are about to come, go or change
  void updated();        ///< they have
  /// Between the two: both rows are there, that of `from` is about to go.
  void merged(scantrove::ObjectId into, scantrove::ObjectId from);

 private:
  using Rows = std::vector<ObjectRecord>;  ///< by rising id

  void readAll();
  void applyChanges(const CatalogueChanges& changes);
  void put(ObjectRecord record);
  void take(ObjectId object);
  [[nodiscard]] Rows::const_iterator placeOf(ObjectId object) const;
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
