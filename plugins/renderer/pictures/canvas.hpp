// SPDX-License-Identifier: BSD-3-Clause
/// The sheet a picture is drawn on: rendered larger and averaged down, because sphere impostors have hard edges that
/// multisampling does not reach.
#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <filesystem>

#include "breccia/types.hpp"
#include "egl_window.hpp"

namespace breccia::pictures {

class Canvas {
 public:
  static constexpr int oversampling = 2;

  /// Pixels of the picture; `background` is red, green, blue in 0 to 1. Throws Unavailable without OpenGL.
  Canvas(int width, int height, const Vec3& background);

  vtkRenderer* renderer() { return renderer_; }
  vtkRenderWindow* window() { return window_; }
  int width() const { return width_; }  ///< of the picture, in pixels
  int height() const { return height_; }

  /// Draws and writes a PNG file, which appears under its name only when it is whole.
  void save(const std::filesystem::path& file);

 private:
  int width_, height_;
  vtkSmartPointer<EglWindow> window_;
  vtkNew<vtkRenderer> renderer_;
};

}  // namespace breccia::pictures
