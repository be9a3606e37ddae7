#include "ui/panels/status_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <algorithm>
#include <vector>

#include "ui/common/tracking_color.h"
#include "ui/language/core_texts.h"
#include "ui/panels/elided_label.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr std::size_t kStagesInLine = 4;

QString trackingInWords(TrackingState state) {
  switch (state) {
    case TrackingState::tracking:
      return scantrove::StatusStrip::tr("Tracking");
    case TrackingState::uncertain:
      return scantrove::StatusStrip::tr("Uncertain");
    case TrackingState::lost:
      return scantrove::StatusStrip::tr("Lost: point the camera at a place that it has seen");
    case TrackingState::relocalized:
      return scantrove::StatusStrip::tr("Relocalised");
  }
  return {};
}

QString stageTable(const ScanSnapshot& snapshot, double total_ms) {
  QString rows;
  for (const ScanSnapshot::StageTime& stage : snapshot.stage_times) {
    rows += QStringLiteral("<tr><td>%1&nbsp;&nbsp;</td><td align='right'>%2 ms</td></tr>")
                .arg(coreText(stage.name).toHtmlEscaped(), QLocale().toString(stage.ms, 'f', 1));
  }
  return scantrove::StatusStrip::tr(
             "<b>Time of the last frame by stage</b><table>%1"
             "<tr><td><b>total</b></td><td align='right'><b>%2 ms</b></td></tr></table>")
      .arg(rows, QLocale().toString(total_ms, 'f', 1));
}

}  // namespace

QString stateInWords(ScanState state) {
  switch (state) {
    case ScanState::idle:
      return scantrove::StatusStrip::tr("Ready");
    case ScanState::starting:
      return scantrove::StatusStrip::tr("Starting…");
    case ScanState::scanning:
      return scantrove::StatusStrip::tr("Scanning");
    case ScanState::paused:
      return scantrove::StatusStrip::tr("Paused");
    case ScanState::finishing:
      return scantrove::StatusStrip::tr("Finishing…");
    case ScanState::refining:
      return scantrove::StatusStrip::tr("Refining objects");
    case ScanState::finished:
      return scantrove::StatusStrip::tr("Finished");
    case ScanState::failed:
      return scantrove::StatusStrip::tr("Failed");
  }
  return {};
}

StatusStrip::StatusStrip(QWidget* parent)
    : QWidget(parent),
      state_label_(new QLabel),
      speed_(new QLabel),
      stages_(new ElidedLabel),
      map_(new QLabel),
      losses_(new QLabel) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 3, 10, 3);
  layout->setSpacing(18);
  layout->addWidget(state_label_);
  layout->addWidget(speed_);
  layout->addWidget(stages_);
  layout->addStretch(1);
  layout->addWidget(losses_);
  layout->addWidget(map_);
  state_label_->setObjectName(QStringLiteral("stateLabel"));
  state_label_->setAccessibleName(tr("Tracking state"));
  speed_->setToolTip(tr("Frames per second"));
  map_->setToolTip(tr("Size of the map, and the number of regions in it"));
  losses_->setToolTip(
      tr("Frames not used: camera lost, unreadable, or dropped because the camera was faster"));
  // In a narrow window the stage times are elided first.
  stages_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  layout->setStretchFactor(stages_, 10);
  for (QLabel* label : {speed_, static_cast<QLabel*>(stages_), map_, losses_})
    label->setProperty("muted", true);
  connect(&Theme::instance(), &Theme::changed, this, &StatusStrip::paintState);
  paintState();
}

void StatusStrip::showState(ScanState state) {
  state_ = state;
  if (state == ScanState::starting || state == ScanState::idle) clear();
  if (state != ScanState::refining) refinement_.clear();
  if (state == ScanState::finishing || state == ScanState::refining) clearSpeed();
  state_label_->setToolTip(state == ScanState::refining
                               ? tr("The key frames are segmented again at full resolution. Regions split "
                                    "further, unlikely objects and poor views are removed, missed objects "
                                    "are added. You can skip this and do it later.")
                               : QString());
  paintState();
}

void StatusStrip::showRefinement(int key_frame, int key_frames) {
  refinement_ = tr("Refining objects: key frame %1 of %2").arg(key_frame).arg(key_frames);
  paintState();
}

void StatusStrip::showPreparing() {
  is_preparing_ = true;
  paintState();
}

void StatusStrip::clear() {
  has_pose_ = false;
  is_preparing_ = false;
  refinement_.clear();
  for (QLabel* label : {map_, losses_}) label->clear();
  clearSpeed();
}

void StatusStrip::clearSpeed() {
  speed_->clear();
  stages_->setFullText({});
}

QString StatusStrip::stateText() const {
  const bool is_running = state_ == ScanState::starting || state_ == ScanState::scanning;
  if (is_running && is_preparing_) return tr("Preparing the OpenCL device (once)");
  if (state_ == ScanState::scanning && has_pose_) return trackingInWords(tracking_);
  if (state_ == ScanState::refining && !refinement_.isEmpty()) return refinement_;
  return stateInWords(state_);
}

void StatusStrip::paintState() {
  const ThemeColors& colors = Theme::instance().colors();
  QColor color = colors.muted_text;
  if (state_ == ScanState::scanning && has_pose_) {
    const Rgb c = trackingColor(tracking_);
    color = QColor(c[0], c[1], c[2]);
  } else if (state_ == ScanState::paused || state_ == ScanState::finishing || state_ == ScanState::refining) {
    color = colors.warning;
  } else if (state_ == ScanState::finished) {
    color = colors.good;
  } else if (state_ == ScanState::failed) {
    color = colors.bad;
  }
  state_label_->setText(
      QStringLiteral("<span style='color:%1'>●</span>&nbsp;&nbsp;<b>%2</b>").arg(color.name(), stateText()));
}

void StatusStrip::showSnapshot(const ScanSnapshot& snapshot) {
  tracking_ = snapshot.pose.state;
  has_pose_ = snapshot.frame_index >= 0;
  is_preparing_ = false;
  paintState();
  showSpeed(snapshot);

  const QLocale locale;
  QString map = tr("%1   %2   %3 MB")
                    .arg(tr("%Ln regions", nullptr, snapshot.region_count),
                         tr("%Ln bricks", nullptr, snapshot.map_bricks),
                         locale.toString(snapshot.map_megabytes, 'f', 0));
  const QString voxel = locale.toString(1000 * static_cast<double>(snapshot.voxel_size_m), 'f', 1);
  if (snapshot.voxel_size_m != FusionParams{}.voxel_size_m) map += tr("   voxels %1 mm").arg(voxel);
  map_->setText(map);
  map_->setToolTip(tr("The map has voxels of %1 mm").arg(voxel));
  QStringList losses;
  if (snapshot.frames.lost > 0) losses << tr("%1 lost").arg(snapshot.frames.lost);
  if (snapshot.frames.skipped > 0) losses << tr("%1 unreadable").arg(snapshot.frames.skipped);
  if (snapshot.frames.dropped > 0) losses << tr("%1 dropped").arg(snapshot.frames.dropped);
  losses_->setText(losses.isEmpty() ? tr("no frame lost") : losses.join(QStringLiteral(" · ")));
}

void StatusStrip::showSpeed(const ScanSnapshot& snapshot) {
  // Without frames there is no speed; the last value would be misleading.
  const bool is_ending = state_ == ScanState::finishing || state_ == ScanState::refining;
  if (snapshot.stage_times.empty() || is_ending) return clearSpeed();
  speed_->setText(tr("%1 fps").arg(QLocale().toString(snapshot.fps, 'f', 1)));
  double total_ms = 0;
  for (const ScanSnapshot::StageTime& stage : snapshot.stage_times) total_ms += stage.ms;
  std::vector<ScanSnapshot::StageTime> slowest = snapshot.stage_times;
  std::stable_sort(slowest.begin(), slowest.end(), [](const auto& a, const auto& b) { return a.ms > b.ms; });
  slowest.resize(std::min(slowest.size(), kStagesInLine));
  QStringList parts;
  for (const ScanSnapshot::StageTime& stage : slowest) {
    parts << QStringLiteral("%1 %2").arg(coreText(stage.name), QString::number(stage.ms, 'f', 0));
  }
  stages_->setFullText(
      tr("%1 ms per frame:  %2").arg(total_ms, 0, 'f', 0).arg(parts.join(QStringLiteral(" · "))),
      stageTable(snapshot, total_ms));
}

}  // namespace scantrove
