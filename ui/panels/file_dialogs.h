#pragma once
#include <QString>
#include <memory>

class QFileDialog;
class QWidget;

namespace scantrove {

/// Dialogs that ask for a file or folder, in place of QFileDialog's own functions: those, and the desktop's
/// dialogs, open every file of a folder to find out its type. Opened and closed in this process a catalogue
/// loses its locks (see ObjectDatabase). These look at names only. Each returns an empty text when the person
/// cancels; `start` is where the dialog opens, or empty for where the last one ended.
[[nodiscard]] QString chooseFolder(QWidget* parent, const QString& title, const QString& start = {});
[[nodiscard]] QString chooseFile(QWidget* parent, const QString& title, const QString& filter);
/// A file that exists may be chosen too, without a question.
[[nodiscard]] QString chooseFileToSave(QWidget* parent, const QString& title, const QString& start,
                                       const QString& filter);

/// The dialog behind them.
[[nodiscard]] std::unique_ptr<QFileDialog> makeFileDialog(QWidget* parent, const QString& title,
                                                          const QString& start);

}  // namespace scantrove
