#pragma once
#include <QDialog>
#include <QImage>
#include <vector>

#include "core/base/ids.h"
#include "ui/panels/alike_list.h"
#include "ui/panels/scan_links.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace scantrove {

class CatalogueEditor;
class ObjectAttributes;
class ObjectHead;
class ObjectListModel;

/// The page of one object: what it is called and is, its 3D model, all its views, the scans that have it, and
/// objects that may be the same. Does not block the window. It follows changes of the list by itself; views,
/// model, scans and alike objects are set by its owner.
class ObjectPage : public QDialog {
  Q_OBJECT

 public:
  /// `model_view`: shows the 3D model; the page owns it. The others outlive the page.
  ObjectPage(CatalogueEditor& editor, ObjectListModel& model, QWidget* model_view, QWidget* parent = nullptr);

  /// Views, scans and alike objects of another one are cleared. An object that is not in the list closes the
  /// page.
  void setObject(ObjectId object);
  [[nodiscard]] ObjectId object() const { return object_; }

  /// Large pictures, newest first.
  void setViews(const std::vector<QImage>& pictures);
  /// What the model is made of. `folder`: a scan that would show more of it; empty: none.
  void setModelNote(bool has_model, const QString& note, const QString& folder);

  [[nodiscard]] ObjectHead* head() const { return head_; }
  [[nodiscard]] ScanLinks* scans() const { return scans_; }
  [[nodiscard]] AlikeList* alike() const { return alike_; }
  [[nodiscard]] QListWidget* views() const { return views_; }
  [[nodiscard]] QString modelNote() const;
  [[nodiscard]] QPushButton* openButton() const { return open_; }

 signals:
  void scanRequested(const QString& folder);

 protected:
  void done(int result) override;

 private:
  [[nodiscard]] QWidget* makeTexts();
  [[nodiscard]] QWidget* makePictures(QWidget* model_view);
  void readRow();

  ObjectListModel& model_;
  ObjectHead* head_;
  ObjectAttributes* attributes_;
  ScanLinks* scans_;
  AlikeList* alike_;
  QListWidget* views_;
  QWidget* model_view_;
  QLabel* model_note_;
  QPushButton* open_;
  QString folder_;  ///< that open_ opens
  ObjectId object_;
};

}  // namespace scantrove
