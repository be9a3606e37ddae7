// How quickly a region lights up after the pointer came to it, while a scan runs in the window; and, when it
// has ended, whether all views say the same of random places. Needs a display (or xvfb-run).
//   pointing_benchmark SOURCE [--moves N] [--places N] [--still]
#include <QApplication>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <clocale>
#include <functional>
#include <iostream>
#include <map>
#include <random>
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

/// Hears when a widget gets an event.
class EventListener : public QObject {
 public:
  EventListener(QWidget* widget, QEvent::Type type) : type_(type) { widget->installEventFilter(this); }
  bool has_come = false;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == type_) has_come = true;
    return QObject::eventFilter(watched, event);
  }

 private:
  QEvent::Type type_;
};

/// Moves the pointer in a view like a hand would, from another thread, and waits until that view was painted
/// with what is there. None: nothing is there, or it was lit already. (Views say at once what is under the
/// pointer; what comes there with a later drawing is no answer to this move.)
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
    if (now != before && now && paint.has_come) return millisecondsSince(start);
    if (now != before && now) continue;
    if (move.has_come) return std::nullopt;
    paint.has_come = false;
  }
  return std::nullopt;
}

void say(const char* what, std::vector<double> ms) {
  if (ms.empty()) return;
  std::sort(ms.begin(), ms.end());
  std::cout << what << ": " << ms.size() << " times, median " << ms[ms.size() / 2] << " ms, p95 "
            << ms[ms.size() * 95 / 100] << " ms, most " << ms.back() << " ms\n";
}

void wait(int ms) {
  const Clock::time_point start = Clock::now();
  while (millisecondsSince(start) < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
}

/// What is truly there: what a ray in the demo's world meets, and where the camera of a frame sees a place of
/// its picture (in fractions).
struct Truth {
  std::shared_ptr<SyntheticSource> source;
  int frame_index = 0;

  /// What is nearest to a place (in metres on the map), along the axes: the map has drifted a little, and
  /// walls are seen at a glancing angle. None: nothing is near.
  [[nodiscard]] std::optional<int> near(const Eigen::Vector3f& point) const {
    constexpr double kNear_m = 0.05;
    const Eigen::Vector3d at =
        source->pose(0) * point.cast<double>();  // the map begins with the first camera
    double least_m = kNear_m;
    std::optional<int> nearest;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        // From before it: surfaces are seen from outside only, and the place may lie a little behind.
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
  [[nodiscard]] RayHit inPicture(const QPointF& fraction) const {
    const Intrinsics K = SyntheticOptions{}.K;
    const Eigen::Isometry3d T_world_camera = source->pose(frame_index);
    const Eigen::Vector3f ray = K.backProject(static_cast<float>(fraction.x() * K.width - 0.5),
                                              static_cast<float>(fraction.y() * K.height - 0.5), 1);
    return along(T_world_camera.translation(), T_world_camera.linear() * ray.cast<double>());
  }
};

std::optional<Truth> truthOf(const std::string& source, int frame_index) {
  if (source != "demo") return {};
  auto made = makeSyntheticSource(SyntheticOptions{});
  if (!made) return {};
  return Truth{std::shared_ptr<SyntheticSource>(std::move(*made)), frame_index};
}

/// Of places picked as (region, instance): those whose region is mostly of that instance.
double rightOf(const std::vector<std::pair<RegionId, int>>& picked) {
  std::map<RegionId, std::map<int, int>> of_region;
  for (const auto& [region, instance] : picked) ++of_region[region][instance];
  int right = 0;
  for (const auto& [region, instances] : of_region) {
    right += std::ranges::max_element(instances, {}, [](const auto& one) { return one.second; })->second;
  }
  return 100.0 * right / std::max<double>(1, static_cast<double>(picked.size()));
}

void comparePlaces(MainWindow& window, const std::optional<Truth>& truth, int places) {
  SceneView* const view = window.scenePane()->view();
  const FramePanels& frames = *window.framePanels();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.02, 0.98);
  int compared = 0, same = 0;
  std::vector<std::pair<RegionId, int>> in_frames, in_scenes;  // with the instance that is there
  view->fitAll();
  wait(3000);
  for (int i = 0; i < 40 * places && compared < places; ++i) {
    const QPointF fraction(unit(random), unit(random));
    const RegionPoint in_frame = frames.pointing().at(fraction, FramePointing::Picture::other);
    if (!in_frame.region || !in_frame.point_world) continue;
    const auto place = view->scene().viewpoint().placeOf(
        *in_frame.point_world, static_cast<float>(view->width()) / static_cast<float>(view->height()));
    if (!place) continue;
    const RegionPoint in_scene =
        view->at({(place->x() + 1) / 2.0 * view->width(), (1 - place->y()) / 2.0 * view->height()});
    // Something else may stand before it from there.
    if (!in_scene.point_world || (*in_scene.point_world - *in_frame.point_world).norm() > 0.02F) continue;
    ++compared;
    same += in_scene.region == in_frame.region ? 1 : 0;
    if (truth) in_frames.emplace_back(in_frame.region, static_cast<int>(truth->inPicture(fraction).instance));
  }
  std::cout << "places: " << compared << ", the same region in 3D " << same << '\n';
  if (!truth) return;
  // The 3D view is asked for itself: what is drawn at a place, and what the viewer would see there.
  int other = 0;
  for (int i = 0; i < 40 * places && static_cast<int>(in_scenes.size()) < places; ++i) {
    const RegionPoint at = view->at({unit(random) * view->width(), unit(random) * view->height()});
    if (!at.region || !at.point_world) continue;
    const auto instance = truth->near(*at.point_world);
    if (instance) {
      in_scenes.emplace_back(at.region, *instance);
    } else {
      ++other;
    }
  }
  std::cout << "of the instance that is truly there: in the pictures " << rightOf(in_frames) << " %, in 3D "
            << rightOf(in_scenes) << " % (and " << other << " places near nothing)\n";
}

int run(const std::string& source, int moves, int places, bool still) {
  WindowOptions options;
  const QTemporaryDir folder;
  options.database = (folder.path() + QStringLiteral("/catalogue.sqlite")).toStdString();
  options.width = 1480;
  options.height = 920;
  MainWindow window(makeScanSessionPort, options);
  window.show();
  bool has_ended = false, is_open = false;
  int frame_index = -1;
  SessionBridge& bridge = window.controller().bridge();
  QObject::connect(&bridge, &SessionBridge::scanFinished, &window, [&](const ScanReport& report) {
    has_ended = true;
    std::cout << "scan: " << report.fps << " fps, median frame " << report.frame_median_ms << " ms\n";
  });
  QObject::connect(&bridge, &SessionBridge::snapshotArrived, &window,
                   [&](const std::shared_ptr<const ScanSnapshot>& snapshot) {
                     if (!snapshot->pose.usable()) return;
                     frame_index = snapshot->frame_index;
                   });
  QObject::connect(&bridge, &SessionBridge::reviewOpened, &window, [&] { is_open = true; });
  window.open(QString::fromStdString(source));
  wait(8000);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.1, 0.9);
  std::vector<double> in_scene, in_picture;
  SceneView* const view = window.scenePane()->view();
  ColorPanel* const color = window.framePanels()->colorPanel();
  for (int i = 0; i < moves && !has_ended && !still; ++i) {
    const auto scene = timeOfLighting(window, *view, *window.scenePane()->overlay(),
                                      {unit(random) * view->width(), unit(random) * view->height()});
    if (scene) in_scene.push_back(*scene);
    QCoreApplication::postEvent(view, new QEvent(QEvent::Leave));
    wait(60);
    const auto picture = timeOfLighting(window, *color, *color, color->placeOf({unit(random), unit(random)}));
    if (picture) in_picture.push_back(*picture);
    QCoreApplication::postEvent(color, new QEvent(QEvent::Leave));
    wait(60);
  }
  say("3D view", in_scene);
  say("colour", in_picture);
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
  CLI::App app{"How quickly and how rightly regions are pointed at"};
  app.add_option("SOURCE", source);
  app.add_option("--moves", moves, "of the pointer, while the scan runs");
  app.add_option("--places", places, "to compare when it has ended");
  app.add_flag("--still", still, "do not move the pointer: for the scan's own rate");
  CLI11_PARSE(app, argc, argv);
  const QTemporaryDir home;
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"})
    qputenv(variable, home.path().toLocal8Bit());
  QSurfaceFormat::setDefaultFormat(scantrove::SceneView::surfaceFormat());
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove-benchmark"));
  scantrove::initialiseResources();
  scantrove::Theme::instance().choose(scantrove::ThemeChoice::dark);
  return scantrove::run(source, moves, places, still);
}
