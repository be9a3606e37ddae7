#include "ui/panels/start_page.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/models/plain_text.h"
#include "ui/panels/elided_label.h"
#include "ui/panels/saved_scans_panel.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

namespace scantrove {
namespace {

constexpr int kColumnWidth = 860;
constexpr int kMaxRecent = 5;

QLabel* mutedLabel(const QString& text) {
  auto* label = new QLabel(text);
  label->setTextFormat(Qt::PlainText);
  label->setProperty("muted", true);
  label->setWordWrap(true);
  return label;
}

/// A large button with picture, title and explanation.
class StartCard : public QToolButton {
 public:
  StartCard(const QString& icon_name, const QString& title, const QString& explanation) {
    setObjectName(QStringLiteral("startCard"));
    setAccessibleName(title);
    setAccessibleDescription(explanation);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setFixedHeight(76);
    setCursor(Qt::PointingHandCursor);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(16, 8, 16, 8);
    row->setSpacing(14);
    picture_ = new QLabel;
    row->addWidget(picture_);
    auto* texts = new QVBoxLayout;
    texts->setSpacing(2);
    texts->addStretch();
    auto* heading = new QLabel(title);
    QFont bold = heading->font();
    bold.setWeight(QFont::DemiBold);
    heading->setFont(bold);
    texts->addWidget(heading);
    texts->addWidget(mutedLabel(explanation));
    texts->addStretch();
    row->addLayout(texts, 1);
    for (QLabel* label : findChildren<QLabel*>()) label->setAttribute(Qt::WA_TransparentForMouseEvents);
    const auto tint = [this, icon_name] {
      picture_->setPixmap(scantrove::icon(icon_name, Theme::instance().colors().accent).pixmap(30, 30));
    };
    connect(&Theme::instance(), &Theme::changed, this, tint);
    tint();
  }

 private:
  QLabel* picture_;
};

}  // namespace

QString sourceTitle(const QString& source) {
  if (source == QLatin1String("demo")) return StartPage::tr("Demo: tabletop");
  if (source == QLatin1String("demo:room")) return StartPage::tr("Demo: room");
  if (source == QLatin1String("camera")) return StartPage::tr("Camera");
  if (source == QLatin1String("camera:Dummy")) return StartPage::tr("Virtual test camera");
  if (source.startsWith(QLatin1String("camera:"))) return StartPage::tr("Camera %1").arg(source.mid(7));
  if (source == QLatin1String("freenect")) return StartPage::tr("Kinect");
  if (source.startsWith(QLatin1String("freenect:"))) return StartPage::tr("Kinect %1").arg(source.mid(9));
  if (source == QLatin1String("realsense")) return StartPage::tr("RealSense");
  if (source.startsWith(QLatin1String("realsense:")))
    return StartPage::tr("RealSense %1").arg(source.mid(10));
  if (source == QLatin1String("record3d")) return StartPage::tr("iPhone with Record3D");
  if (source.startsWith(QLatin1String("record3d:"))) return StartPage::tr("iPhone %1").arg(source.mid(9));
  const QString name = QFileInfo(source).fileName();
  return name.isEmpty() ? source : name;
}

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
  auto* column = new QWidget;
  column->setMaximumWidth(kColumnWidth);
  auto* layout = new QVBoxLayout(column);
  layout->setContentsMargins(20, 20, 20, 20);
  layout->setSpacing(10);
  layout->addStretch(2);

  auto* head = new QHBoxLayout;
  head->setSpacing(18);
  auto* logo = new QLabel;
  logo->setPixmap(icon(QStringLiteral("scantrove")).pixmap(72, 72));
  head->addWidget(logo);
  auto* words = new QVBoxLayout;
  words->setSpacing(2);
  auto* name = new QLabel(QStringLiteral("Scantrove"));
  QFont large = name->font();
  large.setPointSizeF(large.pointSizeF() * 2.1);
  large.setWeight(QFont::DemiBold);
  name->setFont(large);
  words->addWidget(name);
  words->addWidget(
      mutedLabel(tr("Sweep a depth camera over a scene. Scantrove discovers its objects, recognises known "
                    "ones, and collects the others for you to name and confirm.")));
  head->addLayout(words, 1);
  layout->addLayout(head);
  layout->addSpacing(16);

  auto* cards = new QGridLayout;
  cards->setSpacing(10);
  const auto add = [&](int row, int column_index, const char* picture, const QString& title,
                       const QString& text) {
    auto* card = new StartCard(QString::fromLatin1(picture), title, text);
    cards->addWidget(card, row, column_index);
    return card;
  };
  connect(add(0, 0, "folder", tr("Open folder…"), tr("Phones, 7-Scenes, TUM, ScanNet, NYUv2, any images")),
          &QToolButton::clicked, this, &StartPage::folderRequested);
  connect(add(0, 1, "recording", tr("Open recording…"), tr("RealSense, Azure Kinect, ROS, Record3D, OpenNI")),
          &QToolButton::clicked, this, &StartPage::recordingRequested);
  connect(add(1, 0, "camera", tr("Camera…"), tr("A depth camera on this computer")), &QToolButton::clicked,
          this, &StartPage::cameraRequested);
  connect(add(1, 1, "table", tr("Demo: tabletop"), tr("A built-in scene; no camera needed")),
          &QToolButton::clicked, this, [this] { emit sourceChosen(QStringLiteral("demo")); });
  cards->setColumnStretch(0, 1);
  cards->setColumnStretch(1, 1);
  layout->addLayout(cards);

  layout->addWidget(makeProjectRow());
  saved_scans_ = new SavedScansPanel;
  layout->addWidget(saved_scans_);
  recent_box_ = new QWidget;
  auto* recent_column = new QVBoxLayout(recent_box_);
  recent_column->setContentsMargins(0, 14, 0, 0);
  recent_column->setSpacing(2);
  auto* recent_title = new QLabel(tr("Scan again"));
  QFont bold = recent_title->font();
  bold.setWeight(QFont::DemiBold);
  recent_title->setFont(bold);
  recent_column->addWidget(recent_title);
  recent_ = new QVBoxLayout;
  recent_->setSpacing(0);
  recent_column->addLayout(recent_);
  layout->addWidget(recent_box_);

  layout->addSpacing(10);
  auto* hint = mutedLabel(tr("Or drop a folder or a recording on this window. Press ? for all keys."));
  layout->addWidget(hint);
  layout->addStretch(3);

  auto* page = new QWidget;
  auto* centered = new QHBoxLayout(page);
  centered->setContentsMargins(0, 0, 0, 0);
  centered->addStretch(1);
  centered->addWidget(column, 100);
  centered->addStretch(1);
  auto* scroll = new QScrollArea;  // so that the window can be small
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidgetResizable(true);
  scroll->setWidget(page);
  auto* layout_of_page = new QVBoxLayout(this);
  layout_of_page->setContentsMargins(0, 0, 0, 0);
  layout_of_page->addWidget(scroll);
  setRecent({});
}

QWidget* StartPage::makeProjectRow() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 14, 0, 0);
  project_ = new ElidedLabel;
  project_->setObjectName(QStringLiteral("projectName"));
  QFont bold = project_->font();
  bold.setWeight(QFont::DemiBold);
  project_->setFont(bold);
  row->addWidget(project_, 1);
  const auto add = [&](const QString& text, auto signal) {
    auto* button = new QToolButton;
    button->setText(text);
    connect(button, &QToolButton::clicked, this, signal);
    row->addWidget(button);
  };
  add(tr("Open project…"), &StartPage::projectRequested);
  add(tr("New project…"), &StartPage::newProjectRequested);
  return box;
}

void StartPage::setProject(const QString& name, const QString& folder) {
  project_->setFullText(tr("Project: %1").arg(name),
                        plainTip(tr("Catalogue and scans of this project: %1").arg(folder)));
}

void StartPage::setRecent(const QStringList& sources) {
  while (QLayoutItem* item = recent_->takeAt(0)) {
    item->widget()->deleteLater();
    delete item;
  }
  for (const QString& source : sources.mid(0, kMaxRecent)) {
    auto* button = new QToolButton;
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setIcon(icon(QStringLiteral("clock")));
    button->setIconSize({16, 16});
    const QFileInfo file(source);
    button->setText(file.exists() ? QStringLiteral("  %1    %2").arg(sourceTitle(source), file.absolutePath())
                                  : QStringLiteral("  %1").arg(sourceTitle(source)));
    button->setToolTip(plainTip(source));
    button->setCursor(Qt::PointingHandCursor);
    connect(button, &QToolButton::clicked, this, [this, source] { emit sourceChosen(source); });
    recent_->addWidget(button);
  }
  recent_box_->setVisible(!sources.isEmpty());
}

}  // namespace scantrove
