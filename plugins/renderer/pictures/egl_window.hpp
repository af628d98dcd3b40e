// SPDX-License-Identifier: BSD-3-Clause
/// An OpenGL window for VTK that needs no display server, no graphics card and no rights: EGL on Mesa's surfaceless
/// platform. (Debian's VTK knows X11 windows only, and ends the program when there is no X server.)
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

namespace breccia::pictures {

class EglWindow final : public vtkGenericOpenGLRenderWindow {
 public:
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);

  /// Throws Unavailable with the reason when this machine gives no OpenGL 3.2 context. VTK is not touched before that.
  static vtkSmartPointer<EglWindow> create(int width, int height);

  void MakeCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 1; }
  void Frame() override {}  ///< there is no screen to copy to
  void Finalize() override;
  void OpenGLInitContext() override;

 private:
  static EglWindow* New();
  EglWindow() = default;
  ~EglWindow() override;

  void* context_ = nullptr;  // an EGLContext
};

}  // namespace breccia::pictures
