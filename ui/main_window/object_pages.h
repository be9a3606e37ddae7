#pragma once
#include <QImage>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/catalogue/object_details.h"
#include "core/fusion/fusion_params.h"
#include "core/session/scans_of_object.h"
#include "ui/models/object_answers.h"
#include "ui/panels/object_page.h"

namespace scantrove {

class MainWindow;
class ModelView;

/// Opens the page of an object and fills it. Another thread reads the catalogue and the scans of the project.
/// The 3D model is that of the open scan if the object is in it, else what the views show of it.
class ObjectPages : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit ObjectPages(MainWindow& window);

  /// Shows the page of that object, in the place of another one.
  void open(ObjectId object);
  /// Null: it was not open yet.
  [[nodiscard]] ObjectPage* page() const { return page_; }
  [[nodiscard]] ModelView* modelView() const { return model_view_; }

 signals:
  void filled();  ///< the page shows what was read

 private:
  /// What another thread reads for one page.
  struct Reading {
    std::optional<ObjectDetails> details;  ///< none: `failure`
    QString failure;
    std::vector<QImage> views;
    std::vector<ScanOfObject> scans;
  };

  void makePage();
  void schedule();
  /// Of the open scan's project, which may be opened by its path; else of the chosen project.
  [[nodiscard]] QString scansFolder() const;
  void read();
  void show(const std::shared_ptr<Reading>& reading);
  void showScans(const std::vector<ScanOfObject>& scans);
  void showAlike(const std::vector<AlikeObject>& alike);
  void showSides();
  void showModel();
  void followScan();
  [[nodiscard]] bool isShown() const;
  [[nodiscard]] std::set<RegionId> regionsOfObject() const;
  [[nodiscard]] static std::shared_ptr<Reading> readingOf(const std::string& database, ObjectId object,
                                                          const std::string& scans);

  MainWindow& window_;
  ObjectAnswers answers_;
  ObjectPage* page_ = nullptr;
  ModelView* model_view_ = nullptr;
  std::shared_ptr<Reading> shown_;    ///< null: not read yet
  std::set<RegionId> shown_regions_;  ///< that the model is made of; empty: of views
  ObjectId of_model_;                 ///< the object that the model shows
  bool is_model_of_views_ = false;
  std::size_t points_at_model_ = 0;  ///< of the scan, when the model was made
  float voxel_size_m_ = FusionParams{}.voxel_size_m;
  QTimer timer_;
  int reading_ = 0;  ///< number of the newest reading
};

}  // namespace scantrove
