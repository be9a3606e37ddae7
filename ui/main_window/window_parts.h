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

/// What a person sees and uses in the window. All of it is the window's, as Qt's children.
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
