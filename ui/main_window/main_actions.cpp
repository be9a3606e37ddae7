#include "ui/main_window/main_actions.h"

#include <QAction>
#include <QActionGroup>
#include <QUndoStack>

#include "ui/models/plain_text.h"
#include "ui/theme/icon.h"

namespace scantrove {

MainActions::MainActions(QUndoStack& undo_stack, QObject* parent) : QObject(parent) {
  open_folder =
      make("folder", tr("Open &folder…"), tr("Ctrl+O"), tr("Open a recording in a folder of images"));
  open_recording = make("recording", tr("Open &recording…"), tr("Ctrl+Shift+O"),
                        tr("Open a recorded file (.oni, .bag, .db3, .mcap, .mkv, .r3d, .sens)"));
  open_with_options = make("sliders", tr("Open &with options…"), tr("Ctrl+Alt+O"),
                           tr("Set intrinsics, depth scale, or a part of the recording"));
  open_camera = make("camera", tr("&Camera…"), tr("Ctrl+K"), tr("Scan with a depth camera"));
  open_tabletop = make("table", tr("&Tabletop"), {}, tr("The built-in table with objects"));
  open_room = make("room", tr("&Room"), {}, tr("The built-in room"));
  open_project = make("database", tr("Open pro&ject…"), tr("Ctrl+J"),
                      tr("Open another project: a folder with a catalogue and its scans"));
  new_project = make("", tr("&New project…"), tr("Ctrl+N"), tr("Make a project in a new folder"));
  open_catalogue = make("", tr("Open ca&talogue…"), {}, tr("Open or create a catalogue outside projects"));
  connect_catalogue = make("", tr("Connect to catalo&gue…"), {},
                           tr("Use a catalogue on a PostgreSQL server, which several scanners share"));
  open_session = make("clock", tr("Open &scan…"), {}, tr("Open a saved scan to label it"));
  export_data = make("image", tr("&Export data set…"), tr("Ctrl+E"),
                     tr("Export the labelled scan (COCO, BOP, meshes, …)"));
  close_scan = make("close", tr("C&lose scan"), tr("Ctrl+W"),
                    tr("Close this scan and show the start page; the scan stays saved"));
  quit = make("", tr("&Quit"), tr("Ctrl+Q"), tr("Quit Scantrove"));

  start = make("start", tr("&Start"), tr("Ctrl+R"), tr("Scan from the beginning, or resume"));
  pause = make("pause", tr("&Pause"), tr("Space"), tr("Pause or resume"));
  step = make("step", tr("Step one &frame"), tr("N"), tr("Process one frame, then pause"));
  stop = make("stop", tr("S&top"), tr("Ctrl+."), tr("Stop the scan; its results are saved"));

  skip_refinement = make("skip", tr("S&kip refinement"), tr("Ctrl+Shift+S"),
                         tr("Refine later; the results so far are saved"));
  refine = make("refine", tr("&Refine objects"), tr("Ctrl+Shift+R"),
                tr("Refine the objects of this scan with its key frames"));
  continue_scan = make("camera", tr("&Continue scan…"), tr("Ctrl+Alt+R"),
                       tr("Add frames of a recording or a camera to this saved scan"));
  save_picture =
      make("image", tr("Save p&icture…"), tr("Ctrl+Shift+P"), tr("Draw the whole scan into a new PNG file"));
  save_video = make("", tr("Save turntable &video…"), {},
                    tr("Draw a video that goes around the scan once into a new WebM file"));

  undo = undo_stack.createUndoAction(this, tr("Undo"));
  undo->setIcon(icon(QStringLiteral("undo")));
  undo->setShortcut(QKeySequence(tr("Ctrl+Z")));
  redo = undo_stack.createRedoAction(this, tr("Redo"));
  redo->setIcon(icon(QStringLiteral("redo")));
  // Steps have the names of objects, which need not be plain words.
  connect(&undo_stack, &QUndoStack::undoTextChanged, undo,
          [this] { undo->setToolTip(plainTip(undo->text())); });
  connect(&undo_stack, &QUndoStack::redoTextChanged, redo,
          [this] { redo->setToolTip(plainTip(redo->text())); });
  redo->setShortcuts({QKeySequence(tr("Ctrl+Shift+Z")), QKeySequence(tr("Ctrl+Y"))});
  focus_objects = make("search", tr("Go to the object &list"), tr("Ctrl+L"),
                       tr("Move the keyboard focus to the object list"));
  classes = make("", tr("&Classes…"), tr("Ctrl+Shift+L"),
                 tr("Rename, merge, colour, import and export the classes of the catalogue"));

  theme_system = make("", tr("&System"), {}, tr("Follow the desktop"));
  theme_light = make("sun", tr("&Light"), {}, tr("Use light colours"));
  theme_dark = make("moon", tr("&Dark"), {}, tr("Use dark colours"));
  auto* themes = new QActionGroup(this);
  for (QAction* action : {theme_system, theme_light, theme_dark}) {
    action->setCheckable(true);
    themes->addAction(action);
  }
  next_picture = make("", tr("&Enlarge next image"), tr("V"), tr("Show the next image of the frame large"));
  image_mode = make("image-mode", tr("&Image mode"), tr("Ctrl+I"),
                    tr("Show an image in the main area, to look closer and to paint masks"));
  image_mode->setCheckable(true);
  frame_back = make("", tr("&Previous key frame"), tr("PgUp"), tr("Go to the previous key frame"));
  frame_on = make("", tr("Ne&xt key frame"), tr("PgDown"), tr("Go to the next key frame"));
  present = make("", tr("&Presentation mode"), tr("F11"), tr("Show the scene full screen; Escape ends"));
  reset_layout = make("", tr("&Reset layout"), {}, tr("Move all panels back to their default positions"));
  help_keys = make("help", tr("&Keys and mouse"), tr("?"), tr("Show all keys and mouse actions"));
  help_keys->setShortcuts({QKeySequence(tr("?")), QKeySequence(Qt::Key_F1)});
  about = make("info", tr("&About Scantrove"), {}, tr("Show the version"));
  enableFor(ScanState::idle, false);
  enableReview(false);
  enableRefinement(false);
}

void MainActions::enableReview(bool open) {
  if (!open) continue_scan->setEnabled(false);
  for (QAction* action : {export_data, save_picture, save_video, frame_back, frame_on})
    action->setEnabled(open);
}

void MainActions::enableRefinement(bool can_refine) { refine->setEnabled(can_refine); }

QAction* MainActions::make(const char* picture, const QString& text, const QString& key,
                           const QString& help) {
  auto* action = new QAction(text, this);
  if (*picture != '\0') action->setIcon(icon(QString::fromLatin1(picture)));
  if (!key.isEmpty()) action->setShortcut(QKeySequence(key));
  action->setToolTip(key.isEmpty() ? help
                                   : QStringLiteral("%1 (%2)").arg(
                                         help, action->shortcut().toString(QKeySequence::NativeText)));
  return action;
}

void MainActions::enableFor(ScanState state, bool has_source) {
  const bool busy = isBusy(state);
  const bool paused = state == ScanState::paused;
  start->setEnabled(has_source && (!busy || paused));
  start->setText(paused ? tr("Res&ume") : tr("&Start"));
  pause->setEnabled(state == ScanState::scanning || paused);
  step->setEnabled(state == ScanState::scanning || paused);
  stop->setEnabled(state == ScanState::starting || state == ScanState::scanning || paused);
  skip_refinement->setEnabled(state == ScanState::refining);
  if (busy) enableRefinement(false);
  for (QAction* action : {open_project, new_project, open_catalogue, connect_catalogue})
    action->setEnabled(!busy);
}

}  // namespace scantrove
