#pragma once
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>

namespace scantrove {

/// VTK's render window in its own offscreen OpenGL context; drawings are read back as pictures. The main
/// window thus needs no OpenGL: with software rendering, composing it would take as long as drawing the
/// scene.
class QtRenderWindow {
 public:
  explicit QtRenderWindow(vtkRenderer* renderer);
  ~QtRenderWindow();
  QtRenderWindow(const QtRenderWindow&) = delete;
  QtRenderWindow& operator=(const QtRenderWindow&) = delete;

  /// False if the display lacks the OpenGL that VTK needs; nothing is drawn then.
  [[nodiscard]] bool works() const { return window_ != nullptr; }
  /// Call before objects that own OpenGL resources are destroyed. draw() does it itself.
  void makeCurrent();
  /// Draws the scene at this size into VTK's framebuffer.
  void draw(const QSize& pixels);
  /// The last drawing, which had this size.
  [[nodiscard]] QImage picture(const QSize& pixels);

 private:
  using Callback = void (*)(vtkObject*, unsigned long, void*, void*);
  void observe(unsigned long event, Callback callback);
  static void onMakeCurrent(vtkObject* caller, unsigned long event, void* client, void* data);
  static void onIsCurrent(vtkObject* caller, unsigned long event, void* client, void* data);

  QOffscreenSurface surface_;
  QOpenGLContext context_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace scantrove
