#include "ui/main_window/saved_scan_list.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLocale>
#include <algorithm>
#include <cmath>

#include "core/session/session_list.h"
#include "ui/panels/start_page.h"

namespace scantrove {
namespace {

constexpr std::size_t kMaxNamesInList = 3;

QString detailsOf(const SessionSummary& scan) {
  if (!scan.damage.empty())
    return scantrove::SavedScansPanel::tr("damaged") + QLatin1Char('\n') +
           QString::fromStdString(scan.damage);
  QStringList words;
  const QDateTime started =
      QDateTime::fromString(QString::fromStdString(scan.started), Qt::ISODate).toLocalTime();
  if (started.isValid()) words << QLocale().toString(started, scantrove::SavedScansPanel::tr("d MMM, HH:mm"));
  if (scan.in_use) words << scantrove::SavedScansPanel::tr("in use");
  if (scan.isRecovered()) words << scantrove::SavedScansPanel::tr("recovered");
  QStringList lines{words.join(QStringLiteral(" · "))};
  words.clear();
  const auto named = static_cast<int>(scan.names.size());
  if (const int found = std::max(scan.objects, named); found > 0) {
    words << scantrove::SavedScansPanel::tr("%1 of %n objects named", nullptr, found).arg(named);
  } else {
    words << scantrove::SavedScansPanel::tr("%n frames", nullptr, scan.frames);
  }
  if (scan.reviews.all() > 0)
    words << scantrove::SavedScansPanel::tr("%1 of %n images reviewed", nullptr, scan.reviews.all())
                 .arg(scan.reviews.reviewed());
  words << scantrove::SavedScansPanel::tr("%1 MB").arg(std::max(1L, std::lround(scan.megabytes)));
  QStringList names;
  for (const std::string& name : scan.names) {
    if (static_cast<std::size_t>(names.size()) == kMaxNamesInList) {
      names << QStringLiteral("…");
      break;
    }
    names << QString::fromStdString(name);
  }
  lines << words.join(QStringLiteral(" · "));
  if (!names.isEmpty()) lines << names.join(QStringLiteral(", "));
  return lines.join(QLatin1Char('\n'));
}

/// The trash's note about a folder in it (freedesktop.org), which moveToTrash() wrote.
QString trashNoteOf(const QString& in_trash) {
  const QFileInfo place(in_trash);
  return QDir::cleanPath(place.path() + QStringLiteral("/../info/") + place.fileName() +
                         QStringLiteral(".trashinfo"));
}

}  // namespace

std::vector<SavedScanEntry> savedScansIn(const QString& folder) {
  std::vector<SavedScanEntry> scans;
  for (const SessionSummary& scan : listSessions(folder.toStdString())) {
    // Omits scans that were interrupted before their first frame.
    if (scan.damage.empty() && scan.frames == 0) continue;
    const QString source = QString::fromStdString(scan.source);
    const QString picture = QString::fromStdString(scan.picture.string());
    scans.push_back({QString::fromStdString(scan.folder.string()),
                     source.isEmpty() ? QString::fromStdString(scan.name) : sourceTitle(source),
                     detailsOf(scan), picture, readScanPicture(picture), scan.damage.empty() && !scan.in_use,
                     scan.can_be_refined});
  }
  return scans;
}

QStringList savedScanNamesIn(const QString& folder) {
  QStringList names;
  for (const SessionSummary& scan : listSessions(folder.toStdString())) {
    if (scan.damage.empty()) names << QString::fromStdString(scan.name);
  }
  names.sort();
  return names;
}

DeleteScan::DeleteScan(const QString& folder, std::function<void()> done, Fail fail)
    : QUndoCommand(scantrove::SavedScansPanel::tr("Delete the scan %1").arg(QFileInfo(folder).fileName())),
      folder_(folder),
      done_(std::move(done)),
      fail_(std::move(fail)) {}

void DeleteScan::redo() {
  // What the program that has it open still writes would be lost with the trash.
  if (isSessionInUse(folder_.toStdString())) {
    setObsolete(true);
    fail_(scantrove::SavedScansPanel::tr("The scan %1 is in use and was not deleted. Close it first.")
              .arg(folder_));
    return done_();
  }
  if (!QFile::moveToTrash(folder_, &in_trash_)) {
    setObsolete(true);
    fail_(scantrove::SavedScansPanel::tr("The scan %1 cannot be moved to the trash. It was not changed.")
              .arg(folder_));
  }
  done_();
}

void DeleteScan::undo() {
  if (!QDir().rename(in_trash_, folder_)) {
    fail_(scantrove::SavedScansPanel::tr("The scan cannot be restored from the trash. It is in %1.")
              .arg(in_trash_));
  } else {
    QFile::remove(trashNoteOf(in_trash_));  // else the desktop shows a folder that is not there
  }
  done_();
}

}  // namespace scantrove
