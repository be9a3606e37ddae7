// During a scan in the window: time from a pointer move to the highlighted region. After it: whether all
// views return the same region for random points. Needs a display (or xvfb-run).
//   pointing_benchmark SOURCE [--moves N] [--places N] [--still]
#include <QApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <clocale>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <thread>

#include "core/synthetic/scene.h"
#include "core/synthetic/synthetic_source.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/frame_panels.h"
#include "ui/panels/scene_overlay.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Observes the events of a widget.
class EventListener : public QObject {
 public:
  EventListener(QWidget* widget, QEvent::Type type) : type_(type) { widget->installEventFilter(this); }
  bool has_appeared = false;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == type_) has_appeared = true;
    return QObject::eventFilter(watched, event);
  }

 private:
  QEvent::Type type_;
};

/// Moves the pointer in a view from another thread and waits until the view highlights the region there.
/// Empty: no region is there, or it was highlighted already. Regions that a later frame brings do not count.
std::optional<double> timeOfLighting(MainWindow& window, QWidget& view, QWidget& painted,
                                     const QPointF& place) {
  const RegionId before = window.regions().selection().hovered();
  EventListener paint(&painted, QEvent::Paint), move(&view, QEvent::MouseMove);
  const Clock::time_point start = Clock::now();
  std::thread hand([&] {
    QCoreApplication::postEvent(&view, new QMouseEvent(QEvent::MouseMove, place, view.mapToGlobal(place),
                                                       Qt::NoButton, Qt::NoButton, Qt::NoModifier));
  });
  hand.join();
  while (millisecondsSince(start) < 1000) {
    QCoreApplication::processEvents(QEventLoop::AllEvents, 5);
    const RegionId now = window.regions().selection().hovered();
    if (now != before && now && paint.has_appeared) return millisecondsSince(start);
    if (now != before && now) continue;
    if (move.has_appeared) return std::nullopt;
    paint.has_appeared = false;
  }
  return std::nullopt;
}

void print(const char* what, std::vector<double> ms) {
  if (ms.empty()) return;
  std::sort(ms.begin(), ms.end());
  std::cout << what << ": " << ms.size() << " times, median " << ms[ms.size() / 2] << " ms, p95 "
            << ms[ms.size() * 95 / 100] << " ms, most " << ms.back() << " ms\n";
}

void wait(int ms) {
  const Clock::time_point start = Clock::now();
  while (millisecondsSince(start) < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
}

/// The truth: the surface that a ray of the demo's world meets, and rays through points of a picture (in
/// fractions).
struct Truth {
  std::shared_ptr<SyntheticSource> source;
  int frame_index = 0;

  /// The instance nearest to a point of the map (metres), along the axes: the map drifts a little, and walls
  /// are seen at a grazing angle. Empty: none is near.
  [[nodiscard]] std::optional<int> near(const Eigen::Vector3f& point) const {
    constexpr double kNear_m = 0.05;
    const Eigen::Vector3d at =
        source->pose(0) * point.cast<double>();  // the first camera is the origin of the map
    double least_m = kNear_m;
    std::optional<int> nearest;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        // Rays start before the point: surfaces are visible from outside only, and the point may lie behind.
        const Eigen::Vector3d direction = sign * Eigen::Vector3d::Unit(axis);
        const RayHit hit = along(at - kNear_m * direction, direction);
        const double off_m = std::abs(hit.distance - kNear_m);
        if (off_m >= least_m) continue;
        least_m = off_m;
        nearest = static_cast<int>(hit.instance);
      }
    }
    return nearest;
  }
  [[nodiscard]] RayHit along(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const {
    return source->scene().cast(from, direction);
  }
  [[nodiscard]] int inPicture(const QPointF& fraction) const {
    const Intrinsics K = SyntheticOptions{}.K;
    const Eigen::Isometry3d T_world_camera = source->pose(frame_index);
    const Eigen::Vector3f ray = K.backProject(static_cast<float>(fraction.x() * K.width - 0.5),
                                              static_cast<float>(fraction.y() * K.height - 0.5), 1);
    return static_cast<int>(
        along(T_world_camera.translation(), T_world_camera.linear() * ray.cast<double>()).instance);
  }
  [[nodiscard]] std::string nameOf(int instance) const {
    return instance == 0 ? "nothing"
                         : source->scene().instances()[static_cast<std::size_t>(instance - 1)].name;
  }

  static constexpr double kWorkingWidth = 320;  ///< width of the region image in pixels
};

/// The neighbours of a pixel.
constexpr std::array<QPointF, 4> kAround = {QPointF{-1, 0}, QPointF{1, 0}, QPointF{0, -1}, QPointF{0, 1}};

std::optional<Truth> truthOf(const std::string& source, int frame_index) {
  if (source != "demo") return {};
  auto made = makeSyntheticSource(SyntheticOptions{});
  if (!made) return {};
  return Truth{std::shared_ptr<SyntheticSource>(std::move(*made)), frame_index};
}

/// A tested point with its true instance.
struct Picked {
  RegionId region;
  int instance = 0;
  bool at_border = false;  ///< another instance is one pixel away
};

/// Counts the points in a region that is mostly of their instance, and lists the instances of the others.
void printRight(const char* where, const std::vector<Picked>& picked, const Truth& truth) {
  std::map<RegionId, std::map<int, int>> of_region;
  for (const Picked& one : picked) ++of_region[one.region][one.instance];
  int right = 0, off_border = 0, right_off_border = 0;
  std::map<std::string, int> wrong;
  for (const Picked& one : picked) {
    const auto& instances = of_region[one.region];
    const auto most = std::ranges::max_element(instances, {}, [](const auto& entry) { return entry.second; });
    const bool is_right = most->first == one.instance;
    right += is_right ? 1 : 0;
    off_border += one.at_border ? 0 : 1;
    right_off_border += is_right && !one.at_border ? 1 : 0;
    if (!is_right && !one.at_border) ++wrong[truth.nameOf(one.instance)];
  }
  std::cout << "of the instance that is truly there, " << where << ": " << right << " of " << picked.size()
            << "; a pixel off its border " << right_off_border << " of " << off_border;
  for (const auto& [name, count] : wrong) std::cout << ", not " << count << " on '" << name << "'";
  std::cout << '\n';
}

void comparePlaces(MainWindow& window, const std::optional<Truth>& truth, int places) {
  SceneView* const view = window.parts().scene->view();
  const FramePanels& frames = *window.parts().frames;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.02, 0.98);
  int compared = 0, same = 0, inside = 0, same_inside = 0;
  std::vector<Picked> in_frames, in_scenes;
  view->fitAll();
  wait(3000);
  for (int i = 0; i < 40 * places && compared < places; ++i) {
    const QPointF fraction(unit(random), unit(random));
    const RegionPoint in_frame = frames.pointing().at(fraction, FramePointing::Picture::other);
    if (!in_frame.region || !in_frame.point_world) continue;
    const auto place = view->scene().viewpoint().positionOf(
        *in_frame.point_world, static_cast<float>(view->width()) / static_cast<float>(view->height()));
    if (!place) continue;
    const QPointF pixel((place->x() + 1) / 2.0 * view->width(), (1 - place->y()) / 2.0 * view->height());
    const RegionPoint in_scene = view->at(pixel);
    // Another surface may hide it from there.
    if (!in_scene.point_world || (*in_scene.point_world - *in_frame.point_world).norm() > 0.01F) continue;
    ++compared;
    const bool is_same = in_scene.region == in_frame.region;
    const bool is_inside = std::ranges::all_of(kAround, [&](const QPointF& step) {
      const QPointF beside = fraction + step / Truth::kWorkingWidth;
      return frames.pointing().at(beside, FramePointing::Picture::other).region == in_frame.region &&
             view->at(pixel + step).region == in_scene.region;
    });
    same += is_same ? 1 : 0;
    inside += is_inside ? 1 : 0;
    same_inside += is_same && is_inside ? 1 : 0;
    if (!truth) continue;
    const int instance = truth->inPicture(fraction);
    const bool at_border = std::ranges::any_of(kAround, [&](const QPointF& step) {
      return truth->inPicture(fraction + step / Truth::kWorkingWidth) != instance;
    });
    in_frames.push_back({in_frame.region, instance, at_border});
  }
  std::cout << "places: " << compared << ", the same region in 3D " << same << "; a pixel off its border "
            << same_inside << " of " << inside << '\n';
  if (!truth) return;
  // The 3D view is compared with the surface that the viewer should see at the pixel.
  int other = 0;
  for (int i = 0; i < 40 * places && static_cast<int>(in_scenes.size()) < places; ++i) {
    const QPointF place(unit(random) * view->width(), unit(random) * view->height());
    const RegionPoint at = view->at(place);
    if (!at.region || !at.point_world) continue;
    const auto instance = truth->near(*at.point_world);
    if (!instance) {
      ++other;
      continue;
    }
    const bool at_border = std::ranges::any_of(kAround, [&](const QPointF& step) {
      const RegionPoint beside = view->at(place + step);
      return !beside.point_world || truth->near(*beside.point_world) != instance;
    });
    in_scenes.push_back({at.region, *instance, at_border});
  }
  printRight("in the pictures", in_frames, *truth);
  printRight("in 3D", in_scenes, *truth);
  std::cout << other << " places in 3D near nothing\n";
}

int run(const std::string& source, int moves, int places, bool still) {
  WindowOptions options;
  const QTemporaryDir folder;
  options.database = (folder.path() + QStringLiteral("/catalogue.sqlite")).toStdString();
  options.width = 1480;
  options.height = 920;
  MainWindow window(startScanWorker, options);
  window.show();
  bool has_ended = false, is_open = false;
  int frame_index = -1;
  ScanBridge& bridge = window.controller().bridge();
  bridge.on<ScanFinished>(&window, [&](const ScanFinished& finished) {
    const ScanReport& report = finished.report;
    has_ended = true;
    std::cout << "scan: " << report.fps << " fps, median frame " << report.frame_median_ms << " ms\n";
  });
  QObject::connect(&bridge, &ScanBridge::snapshotArrived, &window,
                   [&](const std::shared_ptr<const ScanSnapshot>& snapshot) {
                     if (!snapshot->pose.usable()) return;
                     frame_index = snapshot->frame_index;
                   });
  bridge.on<ReviewOpened>(&window, [&] { is_open = true; });
  window.open(QString::fromStdString(source));
  if (!still) wait(8000);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.1, 0.9);
  std::vector<double> in_scene, in_picture;
  SceneView* const view = window.parts().scene->view();
  ColorPanel* const color = window.parts().frames->colorPanel();
  for (int i = 0; i < moves && !has_ended && !still; ++i) {
    const auto scene = timeOfLighting(window, *view, *window.parts().scene->overlay(),
                                      {unit(random) * view->width(), unit(random) * view->height()});
    if (scene) in_scene.push_back(*scene);
    QCoreApplication::postEvent(view, new QEvent(QEvent::Leave));
    wait(60);
    const auto picture =
        timeOfLighting(window, *color, *color, color->positionOf({unit(random), unit(random)}));
    if (picture) in_picture.push_back(*picture);
    QCoreApplication::postEvent(color, new QEvent(QEvent::Leave));
    wait(60);
  }
  print("3D view", in_scene);
  print("colour", in_picture);
  while (!is_open) wait(100);
  wait(2000);
  comparePlaces(window, truthOf(source, frame_index), places);
  return 0;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  std::string source = "demo";
  int moves = 60, places = 500;
  bool still = false;
  CLI::App app{"Speed and accuracy of pointing at regions"};
  app.add_option("SOURCE", source);
  app.add_option("--moves", moves, "of the pointer, while the scan runs");
  app.add_option("--places", places, "to compare when it has ended");
  app.add_flag("--still", still, "do not move the pointer: for the scan's own rate");
  CLI11_PARSE(app, argc, argv);
  const QTemporaryDir home;
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"})
    qputenv(variable, home.path().toLocal8Bit());
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove-benchmark"));
  scantrove::initializeResources();
  scantrove::Theme::instance().choose(scantrove::ThemeChoice::dark);
  return scantrove::run(source, moves, places, still);
}
