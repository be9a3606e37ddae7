// A script labels in the real window: number of clicks and keys, and seconds of a task. xdotool (must be
// installed) sends mouse and keyboard events to the display, so the widget under the pointer gets them. Needs
// a display.
//   labeling_benchmark SOURCE --script FILE [--pictures DIR] [--data DIR]
// A script has one command per line; # starts a comment:
//   pause N       pause shortly before frame N, then step to it
//   review        wait for the review of the ended scan
//   show N        show the key frame of frame N, or the last before it
//   click U V [ctrl|shift|right|double]    in the colour picture, in pixels of a 640 x 480 image
//   key K         a key in xdotool's notation: Return, ctrl+z, space
//   type TEXT     into the focused field
//   picture NAME  save a screenshot of the display
//   wait MS
#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QScreen>
#include <QTemporaryDir>
#include <QTextStream>

#include <CLI/CLI.hpp>
#include <clocale>
#include <iostream>

#include "ui/main_window/main_window.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/frame_panels.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kPatience_ms = 600'000;

class Person {
 public:
  Person(MainWindow& window, QString pictures) : window_(window), pictures_(std::move(pictures)) {
    ScanBridge& bridge = window.controller().bridge();
    QObject::connect(&bridge, &ScanBridge::snapshotArrived, &window,
                     [this](const std::shared_ptr<const ScanSnapshot>& snapshot) { shown_ = snapshot; });
    bridge.on<ReviewOpened>(&window, [this] { in_review_ = true; });
    bridge.on<ScanFinished>(&window, [](const ScanFinished& finished) {
      std::cout << "scan: " << finished.report.fps << " fps\n";
    });
  }

  /// False: the command is unknown, or it timed out.
  bool obey(const QString& line) {
    const QString command = line.section(QLatin1Char(' '), 0, 0);
    const QString rest = line.section(QLatin1Char(' '), 1).trimmed();
    const QStringList words = rest.split(QLatin1Char(' '));
    if (command == "pause") return pauseAt(words[0].toInt());
    if (command == "review") return waitFor([&] { return in_review_ && !shown_->key_frames->empty(); });
    if (command == "show") return showKeyFrame(words[0].toInt());
    if (command == "click" && words.size() >= 2) return click(words);
    if (command == "key") return press({"key", rest}, 1);
    if (command == "type") return press({"type", "--delay", "12", rest}, static_cast<int>(rest.size()));
    if (command == "picture") return picture(rest);
    if (command == "wait") return wait(words[0].toInt());
    return false;
  }

  void report() const {
    std::cout << "clicks: " << clicks_ << ", keys: " << keys_ << ", seconds: "
              << static_cast<double>(since_first_.isValid() ? since_first_.elapsed() : 0) / 1000 << '\n';
  }

 private:
  static bool wait(int ms) {
    QElapsedTimer timer;
    timer.start();
    while (timer.elapsed() < ms) QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    return true;
  }
  template <class Holds>
  static bool waitFor(Holds&& holds) {
    QElapsedTimer timer;
    timer.start();
    while (!holds() && timer.elapsed() < kPatience_ms)
      QCoreApplication::processEvents(QEventLoop::AllEvents, 10);
    return holds();
  }
  /// Processes events of the window while another program runs.
  static bool run(const QString& program, const QStringList& arguments) {
    QProcess process;
    process.start(program, arguments);
    return waitFor([&] { return process.state() == QProcess::NotRunning; }) && process.exitCode() == 0;
  }

  bool press(const QStringList& arguments, int keys) {
    began();
    keys_ += keys;
    return run("xdotool", arguments) && wait(60);
  }

  bool click(const QStringList& words) {
    began();
    const ColorPanel* const color = window_.parts().frames->colorPanel();
    const QPointF fraction((words[0].toDouble() + 0.5) / 640, (words[1].toDouble() + 0.5) / 480);
    const QPointF place = color->mapToGlobal(color->positionOf(fraction)) * window_.devicePixelRatioF();
    const auto number = [](double value) { return QString::number(qRound(value)); };
    const QString how = words.value(2);
    const bool holds = how == "ctrl" || how == "shift";
    ++clicks_;
    bool done = run("xdotool", {"mousemove", number(place.x()), number(place.y())}) && wait(80);
    if (holds) done = done && run("xdotool", {"keydown", how});
    const QStringList press{"click",   "--repeat", how == "double" ? "2" : "1",
                            "--delay", "60",       how == "right" ? "3" : "1"};
    done = done && run("xdotool", press);
    if (holds) done = done && run("xdotool", {"keyup", how});
    return done && wait(120);
  }

  /// A scan does not pause at once, so the shown frame would depend on the speed of the machine.
  bool pauseAt(int frame) {
    constexpr int kEarlier = 30, kStands_ms = 800;
    const auto shown = [&] { return shown_ ? shown_->frame_index : -1; };
    if (!waitFor([&] { return shown() >= frame - kEarlier; }) || !press({"key", "space"}, 1)) return false;
    for (int last = -1; last != shown();) {
      last = shown();
      wait(kStands_ms);
    }
    while (shown() < frame) {
      const int last = shown();
      if (!press({"key", "n"}, 1) || !waitFor([&] { return shown() != last; })) return false;
    }
    return shown() == frame;
  }

  bool showKeyFrame(int frame) {
    if (!shown_ || !shown_->key_frames) return false;
    for (std::size_t step = 0; step < 2 * shown_->key_frames->size(); ++step) {
      const std::vector<int>& key_frames = *shown_->key_frames;
      const auto after = std::ranges::upper_bound(key_frames, frame);
      const int requested = std::max(0, static_cast<int>(after - key_frames.begin()) - 1);
      const int now = shown_->shown_key_frame;
      if (now == requested) return wait(200);
      if (!press({"key", now > requested ? "Prior" : "Next"}, 1)) return false;
      if (!waitFor([&] { return shown_->shown_key_frame != now; })) return false;
    }
    return false;
  }

  bool picture(const QString& name) {
    wait(400);
    if (pictures_.isEmpty()) return true;
    return window_.screen()->grabWindow(0).save(QDir(pictures_).filePath(name + QStringLiteral(".png")));
  }

  void began() {
    if (!since_first_.isValid()) since_first_.start();
  }

  MainWindow& window_;
  QString pictures_;
  std::shared_ptr<const ScanSnapshot> shown_;
  bool in_review_ = false;
  int clicks_ = 0, keys_ = 0;
  QElapsedTimer since_first_;
};

int run(const std::string& source, const QString& script, const QString& pictures, const QString& data,
        bool light) {
  Theme::instance().choose(light ? ThemeChoice::light : ThemeChoice::dark);
  QFile file(script);
  if (!file.open(QIODevice::ReadOnly)) {
    std::cerr << script.toStdString() << " cannot be read.\n";
    return 1;
  }
  WindowOptions options;
  options.database = QDir(data).filePath(QStringLiteral("catalogue.sqlite")).toStdString();
  options.width = 1480;
  options.height = 920;
  MainWindow window(startScanWorker, options);
  window.show();
  window.activateWindow();
  Person person(window, pictures);
  window.open(QString::fromStdString(source));
  QTextStream lines(&file);
  while (!lines.atEnd()) {
    const QString line = lines.readLine().section(QLatin1Char('#'), 0, 0).trimmed();
    if (line.isEmpty() || person.obey(line)) continue;
    std::cerr << "The command failed: " << line.toStdString() << '\n';
    person.report();
    return 1;
  }
  person.report();
  window.closeScan();
  return 0;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  std::string source, script, pictures, data;
  bool light = false;
  CLI::App app{"Labels by a script in the real window"};
  app.add_option("SOURCE", source)->required();
  app.add_option("--script", script)->required();
  app.add_option("--pictures", pictures, "folder to save them in");
  app.add_option("--data", data, "folder for settings, scans and catalogue; a temporary one otherwise");
  app.add_flag("--light", light, "the light theme");
  CLI11_PARSE(app, argc, argv);
  const QTemporaryDir temporary;
  const QString home = data.empty() ? temporary.path() : QDir(QString::fromStdString(data)).absolutePath();
  for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME"}) qputenv(variable, home.toLocal8Bit());
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setOrganizationName(QStringLiteral("scantrove"));
  QApplication::setApplicationName(QStringLiteral("scantrove"));
  scantrove::initializeResources();
  return scantrove::run(source, QString::fromStdString(script), QString::fromStdString(pictures), home,
                        light);
}
