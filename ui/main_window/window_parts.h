#pragma once

namespace scantrove {

class FramePanels;
class MainActions;
class MessageBar;
class ObjectPanel;
class ParamsPanel;
class ProgressStrip;
class ScenePane;
class StartPage;
class StatusStrip;
class TimeLine;

/// The visible parts of the window, which owns them as Qt children.
struct WindowParts {
  MainActions* actions = nullptr;
  StartPage* start = nullptr;
  ScenePane* scene = nullptr;
  TimeLine* time_line = nullptr;
  MessageBar* messages = nullptr;
  FramePanels* frames = nullptr;
  ObjectPanel* objects = nullptr;
  ParamsPanel* params = nullptr;
  ProgressStrip* progress = nullptr;
  StatusStrip* status = nullptr;
};

}  // namespace scantrove
