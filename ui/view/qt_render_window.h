#pragma once
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <QOpenGLContext>
#include <QOpenGLWidget>

namespace scantrove {

/// VTK's render window in Qt's context: answers VTK's questions about that. It draws into framebuffers of its
/// own. The context is current while it is made and while it goes.
class QtRenderWindow {
 public:
  QtRenderWindow(QOpenGLWidget& widget, vtkRenderer* renderer)
      : widget_(widget), window_(vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New()) {
    window_->SetOwnContext(0);
    window_->SetFrameBlitModeToNoBlit();
    window_->SetMultiSamples(0);
    window_->SetReadyForRendering(true);
    window_->SetMapped(1);
    window_->SetIsDirect(1);
    window_->SetSupportsOpenGL(1);
    observe(vtkCommand::WindowMakeCurrentEvent, onMakeCurrent);
    observe(vtkCommand::WindowIsCurrentEvent, onIsCurrent);
    window_->AddRenderer(renderer);
    window_->OpenGLInitContext();
  }

  ~QtRenderWindow() { window_->Finalize(); }
  QtRenderWindow(const QtRenderWindow&) = delete;
  QtRenderWindow& operator=(const QtRenderWindow&) = delete;

  /// Draws the scene, so many pixels of it, into VTK's framebuffer.
  void draw(const QSize& pixels);
  /// Copies what was drawn last, of that size, to the widget's framebuffer, which is bound then.
  void copyToWidget(const QSize& pixels);

 private:
  using Callback = void (*)(vtkObject*, unsigned long, void*, void*);

  void observe(unsigned long event, Callback callback) {
    const auto command = vtkSmartPointer<vtkCallbackCommand>::New();
    command->SetCallback(callback);
    command->SetClientData(&widget_);
    window_->AddObserver(event, command);
  }

  /// makeCurrent() also binds Qt's framebuffer: harmful while VTK is drawing into its own. Only when needed.
  static void onMakeCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client, void* /*data*/) {
    auto* widget = static_cast<QOpenGLWidget*>(client);
    if (QOpenGLContext::currentContext() != widget->context()) widget->makeCurrent();
  }

  static void onIsCurrent(vtkObject* /*caller*/, unsigned long /*event*/, void* client, void* data) {
    const auto* widget = static_cast<QOpenGLWidget*>(client);
    *static_cast<bool*>(data) =
        widget->context() != nullptr && QOpenGLContext::currentContext() == widget->context();
  }

  QOpenGLWidget& widget_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace scantrove
