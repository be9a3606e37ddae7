#include "ui/main_window/picture_saver.h"

#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

#include "core/base/overloaded.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/scan_controller.h"
#include "ui/panels/file_dialogs.h"
#include "ui/panels/message_bar.h"

namespace scantrove {
namespace {

const QString kPictureFolderKey = QStringLiteral("picture/folder");

/// A name that is free: "kitchen.png", "kitchen-2.png".
QString freeName(const QString& folder, const QString& name, const QString& ending) {
  QString file = folder + QLatin1Char('/') + name + ending;
  for (int i = 2; QFileInfo::exists(file); ++i)
    file = folder + QLatin1Char('/') + name + QLatin1Char('-') + QString::number(i) + ending;
  return file;
}

}  // namespace

PictureSaver::PictureSaver(MainWindow& window) : QObject(&window), window_(window) {
  connect(&window.controller().bridge(), &ScanBridge::eventArrived, this, &PictureSaver::handleEvent);
}

void PictureSaver::savePicture() {
  choose(tr("Save picture"), QStringLiteral(".png"), tr("Pictures (*.png)"));
}

void PictureSaver::saveVideo() {
  choose(tr("Save turntable video"), QStringLiteral(".webm"), tr("Videos (*.webm)"));
}

void PictureSaver::choose(const QString& title, const QString& ending, const QString& filter) {
  if (progress_ != nullptr) {
    progress_->show();
    progress_->raise();
    return;
  }
  const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  const QString folder = QSettings().value(kPictureFolderKey, pictures).toString();
  const QString name = QFileInfo(window_.controller().sessionFolder()).fileName();
  QString file = chooseFileToSave(&window_, title, freeName(folder, name, ending), filter);
  if (file.isEmpty()) return;
  if (!file.endsWith(ending)) file += ending;
  QSettings().setValue(kPictureFolderKey, QFileInfo(file).path());
  saveTo(file);
}

void PictureSaver::saveTo(const QString& file) {
  is_cancelled_ = false;
  progress_ =
      new QProgressDialog(tr("Drawing %1…").arg(QFileInfo(file).fileName()), tr("&Cancel"), 0, 0, &window_);
  progress_->setWindowTitle(tr("Save picture"));
  progress_->setAutoClose(false);
  progress_->setAutoReset(false);
  progress_->setMinimumDuration(0);
  connect(progress_, &QProgressDialog::canceled, this, [this] {
    is_cancelled_ = true;
    window_.controller().bridge().post(CancelExport{});
  });
  progress_->show();
  window_.controller().bridge().post(RenderPicture{{.file = file.toStdString()}});
}

void PictureSaver::handleEvent(const ScanEvent& event) {
  if (progress_ == nullptr) return;
  std::visit(Overloaded{[this](const RenderStepped& e) {
                          if (is_cancelled_) return;
                          progress_->setMaximum(e.total);
                          progress_->setValue(e.done);
                        },
                        [this](const RenderFinished& e) {
                          const QString file = QString::fromStdString(e.file.string());
                          end();
                          window_.parts().messages->show(MessageBar::Kind::info, tr("Saved %1.").arg(file));
                        },
                        [this](const RenderFailed& e) {
                          const bool is_wanted = is_cancelled_;
                          end();
                          if (is_wanted) return;
                          window_.parts().messages->show(MessageBar::Kind::error,
                                                         QString::fromStdString(e.error.message()));
                        },
                        [](const auto&) {}},
             event);
}

void PictureSaver::end() {
  progress_->disconnect(this);
  progress_->hide();
  progress_->deleteLater();
  progress_ = nullptr;
}

}  // namespace scantrove
