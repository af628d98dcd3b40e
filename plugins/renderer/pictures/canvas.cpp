// SPDX-License-Identifier: BSD-3-Clause
#include "canvas.hpp"

#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "breccia/atomic_file.hpp"

namespace breccia::pictures {
namespace fs = std::filesystem;

namespace {

/// Mean of square blocks of pixels.
void average_down(vtkImageData* large, vtkImageData* small, int factor) {
  int size[3];
  large->GetDimensions(size);
  const int width = size[0] / factor, height = size[1] / factor;
  small->SetDimensions(width, height, 1);
  small->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* from = static_cast<const unsigned char*>(large->GetScalarPointer());
  auto* to = static_cast<unsigned char*>(small->GetScalarPointer());
  const int block = factor * factor;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int b = 0; b < factor; ++b)
          for (int a = 0; a < factor; ++a)
            sum += from[3 * ((y * factor + b) * std::size_t(size[0]) + x * factor + a) + c];
        *to++ = static_cast<unsigned char>((sum + block / 2) / block);
      }
}

}  // namespace

Canvas::Canvas(int width, int height, const Vec3& background)
    : width_(width), height_(height), window_(EglWindow::create(width * oversampling, height * oversampling)) {
  renderer_->SetBackground(background.data());
  window_->AddRenderer(renderer_);
}

void Canvas::save(const fs::path& file) {
  window_->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window_);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  vtkNew<vtkImageData> picture;
  average_down(grab->GetOutput(), picture, oversampling);
  vtkNew<vtkPNGWriter> png;
  png->SetInputData(picture);
  png->WriteToMemoryOn();
  png->Write();
  vtkUnsignedCharArray* bytes = png->GetResult();
  write_file(file, {reinterpret_cast<const char*>(bytes->GetPointer(0)), std::size_t(bytes->GetNumberOfValues())});
}

}  // namespace breccia::pictures
