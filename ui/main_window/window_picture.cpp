#include "ui/main_window/window_picture.h"

#include <QCoreApplication>
#include <QPixmap>

#include "ui/main_window/main_window.h"
#include "ui/main_window/scene_pane.h"

namespace scantrove {

Result<void> saveWindowPicture(MainWindow& window, const QString& file) {
  SceneView* view = window.parts().scene->view();
  view->drawing().setFullDetail(true);
  view->update();
  QCoreApplication::processEvents();
  const QPixmap picture = window.grab();
  view->drawing().setFullDetail(false);
  if (picture.save(file)) return {};
  return fail("Cannot write the picture " + file.toStdString() + ".",
              "Check that the folder exists and may be written to, and that the name ends in .png.");
}

}  // namespace scantrove
