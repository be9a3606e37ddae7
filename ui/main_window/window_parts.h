#pragma once

namespace scantrove {

class FramePanels;
class ImageMode;
class ImagePage;
class MainActions;
class MessageBar;
class NextStepStrip;
class ObjectPanel;
class ParamsPanel;
class ProgressStrip;
class ProjectPage;
class ReviewController;
class SceneNames;
class ScenePane;
class StartPage;
class StatusStrip;
class TimeLine;

/// The visible parts of the window, which owns them as Qt children.
struct WindowParts {
  MainActions* actions = nullptr;
  StartPage* start = nullptr;
  ProjectPage* project_page = nullptr;
  ScenePane* scene = nullptr;
  SceneNames* names = nullptr;
  ImagePage* image = nullptr;
  ImageMode* image_mode = nullptr;
  TimeLine* time_line = nullptr;
  ReviewController* review = nullptr;
  NextStepStrip* next_steps = nullptr;
  MessageBar* messages = nullptr;
  FramePanels* frames = nullptr;
  ObjectPanel* objects = nullptr;
  ParamsPanel* params = nullptr;
  ProgressStrip* progress = nullptr;
  StatusStrip* status = nullptr;
};

}  // namespace scantrove
