#pragma once
#include <QObject>

#include "core/scan/scan_snapshot.h"

class QAction;
class QUndoStack;

namespace scantrove {

/// The actions of menus and tool bar, with icons, keys and texts.
class MainActions : public QObject {
  Q_OBJECT

 public:
  /// `undo`: the undo steps of the window.
  MainActions(QUndoStack& undo, QObject* parent);

  QAction* open_folder;
  QAction* open_recording;
  QAction* open_with_options;
  QAction* open_camera;
  QAction* open_tabletop;
  QAction* open_room;
  QAction* open_project;
  QAction* new_project;
  QAction* open_catalogue;
  QAction* connect_catalogue;
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
  QAction* continue_scan;
  QAction* save_picture;
  QAction* save_video;

  QAction* undo;
  QAction* redo;
  QAction* focus_objects;
  QAction* classes;

  QAction* theme_system;
  QAction* theme_light;
  QAction* theme_dark;
  QAction* next_picture;
  QAction* image_mode;
  QAction* frame_back;
  QAction* frame_on;
  QAction* present;
  QAction* reset_layout;

  QAction* help_keys;
  QAction* about;

  /// Enables the actions that are possible in this state.
  void enableFor(ScanState state, bool has_source);
  /// `open`: a session is open for browsing and export.
  void enableReview(bool open);
  /// `can_refine`: the open session is not refined yet.
  void enableRefinement(bool can_refine);

 private:
  QAction* make(const char* picture, const QString& text, const QString& key, const QString& help);
};

}  // namespace scantrove
