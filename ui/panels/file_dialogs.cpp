#include "ui/panels/file_dialogs.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileIconProvider>

namespace scantrove {
namespace {

/// Chooses icons by file type only and never opens a file.
class NameIconProvider final : public QFileIconProvider {
 public:
  [[nodiscard]] QIcon icon(const QFileInfo& info) const override {
    return QFileIconProvider::icon(info.isDir() ? Folder : File);
  }
  [[nodiscard]] QString type(const QFileInfo& info) const override {
    return info.isDir() ? QCoreApplication::translate("FileDialog", "Folder")
                        : QCoreApplication::translate("FileDialog", "%1 file").arg(info.suffix());
  }
};

QString& lastFolder() {
  static QString folder = QDir::currentPath();
  return folder;
}

QString answerOf(QFileDialog& dialog) {
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  lastFolder() = dialog.directory().absolutePath();
  return dialog.selectedFiles().constFirst();
}

}  // namespace

std::unique_ptr<QFileDialog> makeFileDialog(QWidget* parent, const QString& title, const QString& start) {
  static NameIconProvider provider;
  // The dialog lists its first folder before the icon provider is set. The root folder holds no catalogue.
  auto dialog = std::make_unique<QFileDialog>(parent, title, QDir::rootPath());
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  dialog->setIconProvider(&provider);
  const QFileInfo place(start);
  if (!start.isEmpty() && place.isDir()) {
    dialog->setDirectory(place.absoluteFilePath());
  } else if (!start.isEmpty() && place.dir().exists()) {
    dialog->setDirectory(place.absolutePath());
    dialog->selectFile(place.fileName());
  } else {
    dialog->setDirectory(lastFolder());
  }
  return dialog;
}

QString chooseFolder(QWidget* parent, const QString& title, const QString& start) {
  const auto dialog = makeFileDialog(parent, title, QFileInfo(start).isDir() ? start : QString());
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  return answerOf(*dialog);
}

QString chooseFile(QWidget* parent, const QString& title, const QString& filter) {
  const auto dialog = makeFileDialog(parent, title, {});
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilter(filter);
  return answerOf(*dialog);
}

QString chooseFileToSave(QWidget* parent, const QString& title, const QString& start, const QString& filter) {
  const auto dialog = makeFileDialog(parent, title, start);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setOption(QFileDialog::DontConfirmOverwrite);
  dialog->setNameFilter(filter);
  return answerOf(*dialog);
}

}  // namespace scantrove
