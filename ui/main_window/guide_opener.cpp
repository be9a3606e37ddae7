#include "ui/main_window/guide_opener.h"

#include <QAction>
#include <QCoreApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QUrl>

#include "ui/main_window/main_window.h"
#include "ui/panels/message_bar.h"

namespace scantrove {

QString guidePage(const QString& program_folder) {
  // PREFIX/bin/scantrove and BUILD/release/app/scantrove
  for (const char* place : {"../share/doc/scantrove/guide/index.html", "../../guide/index.html"}) {
    const QString page = QDir::cleanPath(program_folder + QLatin1Char('/') + QLatin1String(place));
    if (QFileInfo(page).isFile()) return page;
  }
  return {};
}

GuideOpener::GuideOpener(MainWindow& window)
    : QObject(&window), window_(window), action_(new QAction(tr("&Guide"), this)) {
  action_->setShortcut(QKeySequence(tr("Ctrl+F1")));
  action_->setToolTip(tr("Show the guide in the browser (Ctrl+F1)"));
  connect(action_, &QAction::triggered, this, [this] { open(QCoreApplication::applicationDirPath()); });
}

void GuideOpener::open(const QString& program_folder) {
  MessageBar& messages = *window_.parts().messages;
  const QString page = guidePage(program_folder);
  if (page.isEmpty()) {
    messages.show(
        MessageBar::Kind::info,
        tr("The guide is not installed with this program. It is in the source as docs/guide/index.md; "
           "packaging/guide builds it."));
  } else if (!QDesktopServices::openUrl(QUrl::fromLocalFile(page))) {
    messages.show(MessageBar::Kind::warning,
                  tr("No program shows the guide. Open this file with a browser: %1").arg(page));
  }
}

}  // namespace scantrove
