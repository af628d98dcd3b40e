// SPDX-License-Identifier: BSD-3-Clause
#include "egl_window.hpp"

#include <dlfcn.h>
// glew.h must precede any other OpenGL header
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glew.h>
#include <vtkObjectFactory.h>

#include <string>

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

[[noreturn]] void unavailable(const std::string& why) { throw Unavailable("pictures cannot be drawn here: " + why); }

/// The functions of libEGL that are used, found at run time so that a missing library is a message and no failed load.
struct Egl {
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetCurrentContext) current_context = nullptr;
  EGLDisplay display = EGL_NO_DISPLAY;

  Egl() {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);  // stays open: VTK keeps its functions
    if (!library) unavailable("the library libEGL.so.1 cannot be loaded (Debian: apt install libegl1 libegl-mesa0)");
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (!function) unavailable(std::string("libEGL.so.1 has no function ") + name);
    };
    find(get_proc_address, "eglGetProcAddress");
    find(initialize, "eglInitialize");
    find(bind_api, "eglBindAPI");
    find(create_context, "eglCreateContext");
    find(destroy_context, "eglDestroyContext");
    find(make_current, "eglMakeCurrent");
    find(current_context, "eglGetCurrentContext");
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get_proc_address("eglGetPlatformDisplayEXT"));
    if (!platform_display) unavailable("EGL has no eglGetPlatformDisplayEXT");
    display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !initialize(display, nullptr, nullptr))
      unavailable("EGL has no surfaceless display (Debian: apt install libegl-mesa0 libgl1-mesa-dri)");
  }

  EGLContext make_context() const {
    constexpr EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    if (!bind_api(EGL_OPENGL_API)) unavailable("EGL offers no desktop OpenGL");
    const EGLContext context = create_context(display, EGLConfig(nullptr), EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) unavailable("EGL gives no OpenGL 3.2 core context");
    if (!make_current(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
      destroy_context(display, context);
      unavailable("EGL cannot use an OpenGL context without a surface");
    }
    return context;
  }
};

const Egl& egl() {
  static const Egl instance;  // tried again at the next call when it threw
  return instance;
}

/// GLEW also looks for an X display, which is not needed: the OpenGL functions are loaded by then.
bool load_opengl_functions() {
  const GLenum result = glewInit();
  return (result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) && GLEW_VERSION_3_2;
}

}  // namespace

vtkStandardNewMacro(EglWindow);

vtkSmartPointer<EglWindow> EglWindow::create(int width, int height) {
  const EGLContext context = egl().make_context();
  if (!load_opengl_functions()) {
    egl().destroy_context(egl().display, context);
    unavailable("the OpenGL 3.2 functions cannot be loaded");
  }
  auto window = vtkSmartPointer<EglWindow>::Take(EglWindow::New());
  window->context_ = context;
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(1);
  window->SetSize(width, height);
  return window;
}

EglWindow::~EglWindow() { Finalize(); }

void EglWindow::MakeCurrent() {
  if (context_) egl().make_current(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

bool EglWindow::IsCurrent() { return context_ && egl().current_context() == context_; }

void EglWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  GlewInitValid = true;  // done in create()
  Initialized = true;
}

void EglWindow::Finalize() {
  if (!context_) return;
  MakeCurrent();
  vtkGenericOpenGLRenderWindow::Finalize();
  egl().make_current(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  egl().destroy_context(egl().display, context_);
  context_ = nullptr;
}

}  // namespace breccia::pictures
