#pragma once
#include <QAbstractListModel>
#include <QImage>
#include <set>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/models/catalogue_editor.h"

namespace scantrove {

/// The catalogue's objects, newest first, as the object list shows them.
class ObjectListModel : public QAbstractListModel {
  Q_OBJECT

 public:
  enum Role {
    ObjectIdRole = Qt::UserRole + 1,
    ConfirmedRole,
    ViewCountRole,
    SizeTextRole,    ///< "12×9×8 cm"
    InViewRole,      ///< seen in the frame shown now
    RecognisedRole,  ///< known before this scan and met in it
    AddedNowRole,    ///< added by this scan
  };

  explicit ObjectListModel(CatalogueEditor& editor, QObject* parent = nullptr);

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

  /// Reads the database again; rows that stay keep their selection.
  void reload();
  /// The object has a new view: its picture and count.
  void refresh(ObjectId object);

  void beginScan();
  void markAdded(ObjectId object);
  void markRecognised(ObjectId object);
  void setInView(const std::vector<SeenObject>& seen);

  [[nodiscard]] ObjectId objectAt(const QModelIndex& index) const;
  [[nodiscard]] QModelIndex indexOf(ObjectId object) const;
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;
  [[nodiscard]] int confirmedCount() const;

 private:
  struct Row {
    ObjectRecord record;
    QImage thumbnail;
  };
  void emitAll(const QList<int>& roles);
  QImage makeThumbnail(ObjectId object);

  CatalogueEditor& editor_;
  std::vector<Row> rows_;
  std::set<ObjectId> in_view_;
  std::set<ObjectId> added_;
  std::set<ObjectId> recognised_;
};

/// "1 view", "7 views".
[[nodiscard]] QString viewsInWords(int views);

/// The view's crop with what is not the object dimmed; for lists.
[[nodiscard]] QImage viewPicture(const ObjectView& view);

}  // namespace scantrove
