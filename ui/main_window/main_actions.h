#pragma once
#include <QObject>

#include "core/scan/scan_snapshot.h"

class QAction;
class QUndoStack;

namespace scantrove {

/// The window's commands, each with its icon, key and words; menus and tool bar are made of them.
class MainActions : public QObject {
  Q_OBJECT

 public:
  /// `undo`: of all that can be undone.
  MainActions(QUndoStack& undo, QObject* parent);

  QAction* open_folder;
  QAction* open_recording;
  QAction* open_with_options;
  QAction* open_camera;
  QAction* open_tabletop;
  QAction* open_room;
  QAction* open_catalogue;
  QAction* open_session;
  QAction* export_data;
  QAction* close_scan;
  QAction* quit;

  QAction* start;
  QAction* pause;
  QAction* step;
  QAction* stop;
  QAction* skip_refinement;
  QAction* refine;

  QAction* undo;
  QAction* redo;
  QAction* focus_objects;

  QAction* theme_system;
  QAction* theme_light;
  QAction* theme_dark;
  QAction* next_picture;
  QAction* frame_back;
  QAction* frame_on;
  QAction* present;
  QAction* reset_layout;

  QAction* help_keys;
  QAction* about;

  /// What can be done in this state of the session.
  void enableFor(ScanState state, bool has_source);
  /// A session is open, of which data sets can be made.
  void enableReview(bool open);
  /// That session has not been refined.
  void enableRefinement(bool can_refine);

 private:
  QAction* make(const char* picture, const QString& text, const QString& key, const QString& help);
};

}  // namespace scantrove
