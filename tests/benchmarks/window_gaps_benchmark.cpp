// How long the window blocks: gaps between ticks of a 10 ms timer on its thread, and between drawings of the
// 3D view. Covers a scan with many named objects, opening a session, resizing, naming, and an export. Names
// the longest event. Needs a display (or xvfb-run).
//   window_gaps_benchmark SOURCE [--session DIR] [--objects N] [--scan-seconds S]
#include <QApplication>
#include <QElapsedTimer>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <clocale>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/catalogue/object_database.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kTick_ms = 10;
constexpr double kGap_ms = 100;  ///< noticeable from here on

/// Records the time of each kind of event, by the class of its receiver.
class TimedApplication : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override {
    // Only the outermost event: nested events are part of its time.
    if (depth_ > 0) return QApplication::notify(receiver, event);
    ++depth_;
    std::string kind =
        std::string(receiver->metaObject()->className()) + " event " + std::to_string(event->type());
    if (receiver->parent() != nullptr)
      kind += std::string(" of ") + receiver->parent()->metaObject()->className();
    QElapsedTimer timer;
    timer.start();
    const bool handled = QApplication::notify(receiver, event);
    double& longest = longest_ms[kind];
    longest = std::max(longest, static_cast<double>(timer.nsecsElapsed()) * 1e-6);
    --depth_;
    return handled;
  }
  std::map<std::string, double> longest_ms;

 private:
  int depth_ = 0;
};

/// Measures one phase of the run.
class GapWatch {
 public:
  GapWatch(TimedApplication& application, MainWindow& window) : application_(application), window_(window) {
    timer_.setTimerType(Qt::PreciseTimer);
    QObject::connect(&timer_, &QTimer::timeout, [this] { note(since_tick_, tick_gaps_); });
    QObject::connect(window.parts().scene->view(), &SceneView::drawn, &timer_,
                     [this] { note(since_drawn_, drawn_gaps_); });
  }

  /// Processes events until `is_over`, at most `limit_s`, and prints the gaps. False: it took longer.
  bool watch(const std::string& what, double limit_s, const std::function<bool()>& is_over) {
    tick_gaps_.clear();
    drawn_gaps_.clear();
    application_.longest_ms.clear();
    since_tick_.start();
    since_drawn_.invalidate();
    timer_.start(kTick_ms);
    QElapsedTimer all;
    all.start();
    bool is_done = false;
    while (!is_done && static_cast<double>(all.elapsed()) < limit_s * 1000) {
      QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
      is_done = is_over();
    }
    note(since_tick_, tick_gaps_);  // the gap that is still open
    timer_.stop();
    print(what, static_cast<double>(all.elapsed()) / 1000);
    return is_done;
  }

 private:
  static void note(QElapsedTimer& since, std::vector<double>& gaps) {
    if (since.isValid()) gaps.push_back(static_cast<double>(since.nsecsElapsed()) * 1e-6);
    since.start();
  }

  void print(const std::string& what, double seconds) {
    std::ranges::sort(tick_gaps_);
    std::ranges::sort(drawn_gaps_);
    const auto over = std::ranges::count_if(tick_gaps_, [](double gap) { return gap > kGap_ms; });
    std::cout << what << ": " << seconds << " s, longest gap " << (tick_gaps_.empty() ? 0 : tick_gaps_.back())
              << " ms, " << over << " of " << tick_gaps_.size() << " over " << kGap_ms << " ms; "
              << drawn_gaps_.size() << " drawings";
    if (!drawn_gaps_.empty())
      std::cout << ", between them median " << drawn_gaps_[drawn_gaps_.size() / 2] << ", most "
                << drawn_gaps_.back() << " ms";
    std::cout << '\n';
    std::vector<std::pair<double, std::string>> held;
    for (const auto& [kind, ms] : application_.longest_ms) held.emplace_back(ms, kind);
    std::ranges::sort(held, std::greater<>());
    held.resize(std::min<std::size_t>(held.size(), 4));
    for (const auto& [ms, kind] : held) std::cout << "    " << ms << " ms in " << kind << '\n';
    std::cout.flush();
  }

  TimedApplication& application_;
  MainWindow& window_;
  QTimer timer_;
  QElapsedTimer since_tick_, since_drawn_;
  std::vector<double> tick_gaps_, drawn_gaps_;  // milliseconds
};

/// A catalogue of named, confirmed objects with two views each; none is similar to a scanned object.
void fillCatalogue(const std::string& file, int objects) {
  auto database = ObjectDatabase::open(file);
  if (!database) throw std::runtime_error(database.error().message());
  const auto session = (*database)->sessions().begin("earlier");
  for (int i = 0; i < objects; ++i) {
    ObjectView view;
    view.session = session.value();
    view.color = cv::Mat(120, 160, CV_8UC3, cv::Scalar(i * 37 % 256, i * 91 % 256, i * 53 % 256));
    cv::putText(view.color, std::to_string(i), {20, 80}, cv::FONT_HERSHEY_SIMPLEX, 2, {255, 255, 255}, 3);
    view.mask = cv::Mat(120, 160, CV_8UC1, cv::Scalar(255));
    view.depth_mm = cv::Mat(120, 160, CV_16UC1, cv::Scalar(900));
    view.size_m = {0.12F, 0.09F, 0.08F};
    const auto added = (*database)->addObject(view);
    if (!added) throw std::runtime_error(added.error().message());
    view.object = added->id;
    static_cast<void>((*database)->addView(view));
    static_cast<void>((*database)->rename(added->id, "object " + std::to_string(i)));
    static_cast<void>((*database)->setConfirmed(std::vector{added->id}, true));
  }
}

/// Names the largest regions, one after the other.
void nameRegions(MainWindow& window, GapWatch& gaps, int count) {
  RegionController& regions = window.regions();
  int done = 0;
  bool is_waiting = false;
  QElapsedTimer since_done;
  const QMetaObject::Connection heard = window.controller().bridge().on<Edited>(&window, [&] {
    is_waiting = false;
    since_done.start();
  });
  gaps.watch("naming " + std::to_string(count) + " regions", 120, [&] {
    if (is_waiting || (since_done.isValid() && since_done.elapsed() < 400)) return false;
    if (done >= count) return true;
    regions.selection().selectBySize(true);
    if (regions.selection().selected().empty()) return true;
    regions.operations().name(
        {{regions.selection().selected().front(), {"named " + std::to_string(++done)}}});
    is_waiting = true;
    return false;
  });
  QObject::disconnect(heard);
}

void resizeOften(MainWindow& window, GapWatch& gaps) {
  int step = 0;
  QTimer resizing;
  QObject::connect(&resizing, &QTimer::timeout, [&] {
    ++step;
    window.resize(1280 + 20 * (step % 10), 800 + 10 * (step % 10));
  });
  resizing.start(50);
  gaps.watch("resizing", 20, [&] { return step >= 100; });
  resizing.stop();
}

void exportIt(MainWindow& window, GapWatch& gaps, const QString& folder) {
  bool is_done = false;
  ScanBridge& bridge = window.controller().bridge();
  const QMetaObject::Connection done = bridge.on<ExportFinished>(&window, [&] { is_done = true; });
  const QMetaObject::Connection failed = bridge.on<ExportFailed>(&window, [&](const ExportFailed& event) {
    std::cout << "export: " << event.error.message() << '\n';
    is_done = true;
  });
  ExportOptions options;
  options.format = DatasetFormat::coco;
  options.folder = folder.toStdString();
  options.background = true;
  bridge.post(ExportDataset{options});
  gaps.watch("exporting", 300, [&] { return is_done; });
  QObject::disconnect(done);
  QObject::disconnect(failed);
}

struct Wishes {
  std::string source = "demo:room";
  std::string session;
  int objects = 200;
  double scan_s = 30;
  double idle_s = 3;
  int names = 10;
};

int run(TimedApplication& application, const Wishes& wishes) {
  const QTemporaryDir folder;
  WindowOptions options;
  options.database = (folder.path() + QStringLiteral("/catalogue.sqlite")).toStdString();
  options.width = 1480;
  options.height = 920;
  fillCatalogue(options.database, wishes.objects);
  MainWindow window(startScanWorker, options);
  window.show();
  GapWatch gaps(application, window);
  ScanBridge& bridge = window.controller().bridge();
  bool is_open = false, has_ended = false;
  bridge.on<ReviewOpened>(&window, [&] { is_open = true; });
  bridge.on<ScanFinished>(&window, [&] { has_ended = true; });
  QString session = QString::fromStdString(wishes.session);
  gaps.watch("first page", wishes.idle_s, [] { return false; });
  if (session.isEmpty() || wishes.scan_s > 0) {
    window.open(QString::fromStdString(wishes.source));
    const QString scanned = window.controller().sessionFolder();
    gaps.watch("scanning with " + std::to_string(wishes.objects) + " objects", wishes.scan_s,
               [&] { return has_ended; });
    if (session.isEmpty()) session = scanned;
    window.controller().stop();
    gaps.watch("ending the scan", 120, [&] { return is_open; });
  }
  window.closeScan();
  gaps.watch("closing", wishes.idle_s, [] { return false; });
  is_open = false;
  window.openSession(session);
  gaps.watch("opening the session", 120, [&] { return is_open; });
  gaps.watch("after opening", wishes.idle_s, [] { return false; });
  std::cout << "  " << window.parts().scene->view()->scene().cloud().pointCount() << " points\n";
  resizeOften(window, gaps);
  nameRegions(window, gaps, wishes.names);
  exportIt(window, gaps, folder.path() + QStringLiteral("/data"));
  return 0;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  scantrove::Wishes wishes;
  CLI::App app{"How long the window blocks"};
  app.add_option("SOURCE", wishes.source, "to scan");
  app.add_option("--session", wishes.session, "to open; else what was scanned");
  app.add_option("--objects", wishes.objects, "named ones in the catalogue");
  app.add_option("--scan-seconds", wishes.scan_s, "0 with --session: no scan");
  app.add_option("--idle-seconds", wishes.idle_s, "while nothing is to be done");
  app.add_option("--names", wishes.names, "regions to name in the session");
  CLI11_PARSE(app, argc, argv);
  const QTemporaryDir home;
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"})
    qputenv(variable, home.path().toLocal8Bit());
  scantrove::TimedApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove-benchmark"));
  scantrove::initializeResources();
  scantrove::Theme::instance().choose(scantrove::ThemeChoice::dark);
  return scantrove::run(application, wishes);
}
