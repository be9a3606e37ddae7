#include "ui/main_window/object_pages.h"

#include <QDateTime>
#include <QFileInfo>
#include <QFuture>
#include <QLocale>
#include <QPromise>
#include <QThreadPool>
#include <algorithm>
#include <utility>

#include "core/catalogue/view_summary.h"
#include "core/geometry/view_coverage.h"
#include "ui/main_window/main_actions.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/models/region_selection.h"
#include "ui/panels/object_head.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/start_page.h"
#include "ui/theme/theme.h"
#include "ui/view/model_view.h"

namespace scantrove {
namespace {

constexpr int kReadAfter_ms = 250;  ///< changes often come in groups
constexpr int kLargePicture_px = 360;

QImage largePicture(const ObjectView& view) {
  const cv::Mat bgr = listPicture(view.color, view.mask, kLargePicture_px);
  if (bgr.empty()) return {};
  return QImage(bgr.data, bgr.cols, bgr.rows, static_cast<qsizetype>(bgr.step[0]), QImage::Format_BGR888)
      .copy();
}

/// From which sides the views of the model's session show the object.
SeenSides sidesOfViews(const ObjectDetails& details) {
  ViewCoverage coverage;
  for (const ObjectView& view : details.views) {
    if (view.session == details.cloud.session) coverage.addDirection(view.direction);
  }
  return sidesOf(coverage, SideAxes{});
}

}  // namespace

ObjectPages::ObjectPages(MainWindow& window) : QObject(&window), window_(window), answers_(window.editor()) {
  connect(window_.parts().objects, &ObjectPanel::pageRequested, this, &ObjectPages::open);
  connect(&window_.editor(), &CatalogueEditor::changed, this, &ObjectPages::schedule);
  connect(&window_.editor(), &CatalogueEditor::edited, this, &ObjectPages::schedule);
  connect(&window_.regions().selection(), &RegionSelection::infosChanged, this, &ObjectPages::followScan);
  connect(&window_.controller(), &ScanController::opening, this, &ObjectPages::schedule);
  // Points come in parts, after the regions.
  connect(window_.parts().scene->view(), &SceneView::drawn, this, &ObjectPages::followScan);
  ScanBridge& bridge = window_.controller().bridge();
  connect(&bridge, &ScanBridge::snapshotArrived, this,
          [this](const std::shared_ptr<const ScanSnapshot>& snapshot) {
            voxel_size_m_ = snapshot->voxel_size_m;
          });
  bridge.on<ReviewOpened>(this, [this] {
    shown_regions_.clear();
    schedule();
  });
  timer_.setSingleShot(true);
  timer_.setInterval(kReadAfter_ms);
  connect(&timer_, &QTimer::timeout, this, &ObjectPages::read);
}

void ObjectPages::makePage() {
  model_view_ = new ModelView;
  page_ = new ObjectPage(window_.editor(), window_.model(), model_view_, &window_);
  page_->addActions({window_.parts().actions->undo, window_.parts().actions->redo});
  connect(page_, &ObjectPage::scanRequested, &window_, &MainWindow::openSession);
  connect(page_->alike(), &AlikeList::shown, this, &ObjectPages::open);
  connect(page_->alike(), &AlikeList::same, this,
          [this](ObjectId other) { answers_.areSame(page_->object(), other); });
  connect(page_->alike(), &AlikeList::different, this,
          [this](ObjectId other) { answers_.areDifferent(page_->object(), other); });
  // Objects of another catalogue have other numbers.
  connect(&window_.editor(), &CatalogueEditor::opened, page_, &QWidget::close);
  const auto paint = [this] {
    model_view_->setColors(Theme::instance().colors().scene_top, Theme::instance().colors().scene_bottom);
  };
  connect(&Theme::instance(), &Theme::changed, this, paint);
  paint();
}

void ObjectPages::open(ObjectId object) {
  if (window_.model().record(object) == nullptr) return;
  if (page_ == nullptr) makePage();
  if (!page_->head()->finish()) return;
  if (page_->object() != object) shown_.reset();
  page_->setObject(object);
  page_->show();
  page_->raise();
  page_->activateWindow();
  read();
}

bool ObjectPages::isShown() const { return page_ != nullptr && page_->isVisible(); }

void ObjectPages::schedule() {
  if (isShown() && !timer_.isActive()) timer_.start();
}

std::shared_ptr<ObjectPages::Reading> ObjectPages::readingOf(const std::string& database, ObjectId object,
                                                             const std::string& scans) {
  auto reading = std::make_shared<Reading>();
  Result<ObjectDetails> details = readDetails(database, object);
  if (!details) {
    reading->failure = QString::fromStdString(details.error().message());
    return reading;
  }
  for (const ObjectView& view : details->views) {
    if (QImage picture = largePicture(view); !picture.isNull()) reading->views.push_back(std::move(picture));
  }
  reading->scans = scansOfObject(scans, details->catalogue, details->ids);
  reading->details = std::move(*details);
  return reading;
}

QString ObjectPages::scansFolder() const {
  const QString session = window_.onStartPage() ? QString() : window_.controller().sessionFolder();
  return session.isEmpty() ? window_.controller().scansFolder() : QFileInfo(session).absolutePath();
}

void ObjectPages::read() {
  if (!isShown() || !window_.editor().isOpen()) return;
  const auto promise = std::make_shared<QPromise<std::shared_ptr<Reading>>>();
  promise->start();
  QThreadPool::globalInstance()->start([promise, object = page_->object(),
                                        database = window_.editor().file().toStdString(),
                                        scans = scansFolder().toStdString()] {
    promise->addResult(readingOf(database, object, scans));
    promise->finish();
  });
  const int number = ++reading_;
  promise->future().then(this, [this, number](const std::shared_ptr<Reading>& reading) {
    if (number == reading_ && isShown()) show(reading);
  });
}

void ObjectPages::show(const std::shared_ptr<Reading>& reading) {
  if (!reading->details) {
    page_->setModelNote(false, reading->failure, {});
    page_->alike()->setEntries({});
    return;
  }
  if (reading->details->object != page_->object()) return schedule();
  shown_ = reading;
  page_->setViews(reading->views);
  showScans(reading->scans);
  showAlike(reading->details->alike);
  showSides();
  showModel();
  emit filled();
}

void ObjectPages::showScans(const std::vector<ScanOfObject>& scans) {
  std::vector<ScanLinks::Entry> entries;
  for (const ScanOfObject& scan : scans) {
    ScanLinks::Entry entry;
    entry.folder = QString::fromStdString(scan.folder.string());
    entry.title = scan.source.empty() ? QFileInfo(entry.folder).fileName()
                                      : sourceTitle(QString::fromStdString(scan.source));
    QStringList details;
    const QDateTime started = QDateTime::fromString(QString::fromStdString(scan.started), Qt::ISODate);
    if (started.isValid()) details << QLocale().toString(started.toLocalTime(), tr("d MMM, HH:mm"));
    details << tr("%n key frames", nullptr, scan.key_frames);
    if (scan.regions > 1) details << tr("%n regions", nullptr, scan.regions);
    entry.details = details.join(QStringLiteral(" · "));
    entry.is_open = !window_.onStartPage() && !window_.controller().sessionFolder().isEmpty() &&
                    QFileInfo(entry.folder) == QFileInfo(window_.controller().sessionFolder());
    entries.push_back(std::move(entry));
  }
  page_->scans()->setEntries(entries);
}

void ObjectPages::showAlike(const std::vector<AlikeObject>& alike) {
  std::vector<AlikeList::Entry> entries;
  for (const AlikeObject& one : alike) {
    const ObjectRecord* const record = window_.model().record(one.object);
    if (record == nullptr) continue;
    entries.push_back({one.object, QString::fromStdString(record->name), window_.editor().picture(one.object),
                       one.isVeryAlike()});
  }
  page_->alike()->setEntries(entries);
}

void ObjectPages::showSides() {
  const QVariant in_scan = window_.model().indexOf(page_->object()).data(ObjectListModel::SeenSidesRole);
  if (in_scan.isValid()) {
    const SeenSides sides = in_scan.value<SeenSides>();
    return page_->head()->showSides(sides, tr("In this scan %1").arg(sidesInWords(sides)));
  }
  if (shown_ == nullptr || shown_->details->cloud.session == 0)
    return page_->head()->showSides(std::nullopt, {});
  const SeenSides sides = sidesOfViews(*shown_->details);
  page_->head()->showSides(sides, tr("By the views of one scan %1").arg(sidesInWords(sides)));
}

std::set<RegionId> ObjectPages::regionsOfObject() const {
  std::set<RegionId> regions;
  if (window_.onStartPage()) return regions;
  for (const RegionInfo& info : window_.regions().selection().infos()) {
    if (info.object && info.object == page_->object()) regions.insert(info.region);
  }
  return regions;
}

void ObjectPages::followScan() {
  if (!isShown() || shown_ == nullptr) return;
  showSides();
  const std::size_t points = window_.parts().scene->view()->scene().cloud().pointCount();
  const bool waits = is_model_of_views_ && points != points_at_model_;
  const std::set<RegionId> regions = regionsOfObject();
  if (regions != shown_regions_ || (waits && !regions.empty())) showModel();
}

void ObjectPages::showModel() {
  const ObjectId object = page_->object();
  const bool is_same = std::exchange(of_model_, object) == object;
  shown_regions_ = regionsOfObject();
  LabelCloudScene& scene = window_.parts().scene->view()->scene();
  points_at_model_ = scene.cloud().pointCount();
  std::vector<ViewPoint> points;
  if (!shown_regions_.empty()) {
    for (const auto& [region, of_region] : scene.cloud().pointsOfRegions(1)) {
      if (!shown_regions_.contains(region)) continue;
      for (const AppearancePoint& point : of_region) {
        const std::array<std::uint8_t, 3> gray{150, 150, 150};
        points.push_back({point.position, point.normal, point.has_color ? point.rgb : gray});
      }
    }
  }
  is_model_of_views_ = points.empty();
  if (!points.empty()) {
    model_view_->setModel(points, voxel_size_m_, scene.sideAxes().up, is_same);
    return page_->setModelNote(true, tr("From the open scan."), {});
  }
  const QString folder =
      shown_->scans.empty() ? QString() : QString::fromStdString(shown_->scans.front().folder.string());
  const ViewCloud& cloud = shown_->details->cloud;
  model_view_->setModel(cloud.points, cloud.spacing_m, SideAxes{}.up, is_same);
  const QString from_views = tr("From %n views, because no scan with it is open.", nullptr, cloud.views);
  const bool has_model = !cloud.points.empty();
  page_->setModelNote(has_model,
                      has_model ? from_views : tr("No scan with it is open, and its views have no depth."),
                      folder);
}

}  // namespace scantrove
