// SPDX-License-Identifier: BSD-3-Clause
/// Pictures made by the plugin, as tests look at them.
#pragma once

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <array>
#include <set>

#include "breccia/renderer.hpp"
#include "plugin_under_test.hpp"

namespace breccia::test {
namespace fs = std::filesystem;

struct Image {
  int width = 0, height = 0;
  std::vector<std::array<unsigned char, 3>> pixel;
  double drawn() const {  ///< share of pixels that are not background
    const auto blank = std::count(pixel.begin(), pixel.end(), std::array<unsigned char, 3>{255, 255, 255});
    return 1 - double(blank) / double(pixel.size());
  }
  std::size_t colours() const { return std::set(pixel.begin(), pixel.end()).size(); }
  /// Share of pixels within a few steps of a colour.
  double share_of(int r, int g, int b) const {
    return double(std::count_if(
               pixel.begin(), pixel.end(),
               [&](const auto& p) { return std::abs(p[0] - r) + std::abs(p[1] - g) + std::abs(p[2] - b) < 60; })) /
           double(pixel.size());
  }
};

inline Image read(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  Image image;
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  image.width = size[0];
  image.height = size[1];
  const auto* p = static_cast<const unsigned char*>(reader->GetOutput()->GetScalarPointer());
  for (int k = 0; k < size[0] * size[1]; ++k, p += 3) image.pixel.push_back({p[0], p[1], p[2]});
  return image;
}

inline std::string bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<fs::path> render(const fs::path& source, const fs::path& to, const Json& given, QuietHost& host) {
  return make<Renderer>(BRECCIA_PICTURES_PLUGIN, given)->render({source, to}, host);
}

inline std::vector<std::string> names(const std::vector<fs::path>& files) {
  std::vector<std::string> all;
  for (const fs::path& file : files) all.push_back(file.filename());
  return all;
}

using Names = std::vector<std::string>;

}  // namespace breccia::test
