#include "ui/main_window/project_page.h"

#include <QFileInfo>
#include <QTimer>
#include <memory>
#include <utility>
#include <vector>

#include "core/session/session_list.h"
#include "ui/main_window/background_reading.h"
#include "ui/main_window/main_window.h"
#include "ui/main_window/saved_scan_list.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/window_dialogs.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/object_list_view.h"
#include "ui/panels/object_panel.h"
#include "ui/panels/source_dialog.h"
#include "ui/panels/start_page.h"

namespace scantrove {

ProjectPage::ProjectPage(MainWindow& window) : QObject(&window), window_(window) {
  SavedScansPanel* const scans = window_.parts().start->savedScans();
  connect(scans, &SavedScansPanel::chosen, &window_, &MainWindow::openSession);
  connect(scans, &SavedScansPanel::deleteRequested, this, &ProjectPage::remove);
  connect(scans, &SavedScansPanel::actionRequested, this, &ProjectPage::perform);
  ScanBridge& bridge = window_.controller().bridge();
  connect(&window_.controller(), &ScanController::opening, this, [this](const QString& opened) {
    if (QFileInfo(opened) != QFileInfo(exported_next_)) exported_next_.clear();
  });
  bridge.on<ScanFailed>(this, [this] { exported_next_.clear(); });
  bridge.on<ReviewOpened>(this, [this] {
    if (std::exchange(exported_next_, {}).isEmpty() || window_.onStartPage()) return;
    window_.dialogs().showExport();
  });
}

void ProjectPage::refresh() {
  const int number = ++reading_;
  readInBackground(
      this, [folder = window_.controller().scansFolder()] { return savedScansIn(folder); },
      [this, number](const std::vector<SavedScanEntry>& scans) {
        if (number != reading_) return;  // another project or a change followed meanwhile
        window_.parts().start->savedScans()->setScans(scans);
        emit shown();
      });
}

void ProjectPage::perform(const QString& folder, SavedScanAction action) {
  if (!window_.parts().objects->list()->finishEditing()) return;
  window_.parts().messages->dismiss();
  switch (action) {
    case SavedScanAction::resume:
      // Later: while the dialog is open the list may be read anew, which deletes the menu that was clicked.
      return QTimer::singleShot(0, this, [this, folder] { continueScan(folder); });
    case SavedScanAction::refine:
      return window_.controller().refineSession(folder);
    case SavedScanAction::export_data:
      exported_next_ = folder;
      return window_.openSession(folder);
  }
}

void ProjectPage::continueScan(const QString& folder) {
  if (folder.isEmpty()) return;
  const SessionMetadata metadata = readSessionMetadata(folder.toStdString());
  const auto source = metadata.find("source");
  SourceDialog dialog(source == metadata.end() ? QString() : QString::fromStdString(source->second),
                      &window_);
  dialog.askToContinue(QFileInfo(folder).fileName());
  if (dialog.exec() != QDialog::Accepted) return;
  window_.parts().messages->dismiss();
  window_.controller().continueSession(folder, dialog.source(), dialog.options(), dialog.poses());
}

void ProjectPage::remove(const QString& folder) {
  const auto fail = [this](const QString& message) {
    window_.parts().messages->show(MessageBar::Kind::error, message);
  };
  window_.history().push(window_.parts().start, std::make_shared<DeleteScan>(
                                                    folder, [this] { refresh(); }, fail));
}

}  // namespace scantrove
