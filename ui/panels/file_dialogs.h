#pragma once
#include <QString>
#include <memory>

class QFileDialog;
class QWidget;

namespace scantrove {

/// Dialogs that ask for a file or folder. QFileDialog's static functions and the desktop's dialogs open every
/// file of a folder to find its type; closing a catalogue in this process would release its locks (see
/// ObjectDatabase). These dialogs read names only. Each returns an empty string if the user cancels. `start`
/// is the initial folder or file; empty: the last folder.
[[nodiscard]] QString chooseFolder(QWidget* parent, const QString& title, const QString& start = {});
[[nodiscard]] QString chooseFile(QWidget* parent, const QString& title, const QString& filter);
/// An existing file may be chosen too, without confirmation.
[[nodiscard]] QString chooseFileToSave(QWidget* parent, const QString& title, const QString& start,
                                       const QString& filter);

/// Creates the dialog that these functions use.
[[nodiscard]] std::unique_ptr<QFileDialog> makeFileDialog(QWidget* parent, const QString& title,
                                                          const QString& start);

}  // namespace scantrove
