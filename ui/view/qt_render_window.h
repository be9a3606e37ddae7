#pragma once
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>

namespace scantrove {

/// VTK's render window in an OpenGL context of its own that no widget shows: what it draws is read back as a
/// picture. So the window around it needs no OpenGL; where a processor draws, having it put the window
/// together would take as long as the scene.
class QtRenderWindow {
 public:
  explicit QtRenderWindow(vtkRenderer* renderer);
  ~QtRenderWindow();
  QtRenderWindow(const QtRenderWindow&) = delete;
  QtRenderWindow& operator=(const QtRenderWindow&) = delete;

  /// False: this machine has not the OpenGL that VTK needs; nothing can be drawn.
  [[nodiscard]] bool works() const { return window_ != nullptr; }
  /// Before anything that OpenGL objects hang on is freed. Draws do it by themselves.
  void makeCurrent();
  /// Draws the scene, so many pixels of it, into VTK's framebuffer.
  void draw(const QSize& pixels);
  /// What was drawn last, of that size.
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
