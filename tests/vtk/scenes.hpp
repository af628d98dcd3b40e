// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of scenes, drawn one at a time and without a warning.
#pragma once

#include "made_scene.hpp"
#include "png_image.hpp"

namespace breccia::test {

using Outline = SpecimenShape::Outline;
constexpr std::array<unsigned char, 3> wall{243, 243, 243};

/// Rows and columns that have more than single pixels of the pale wall, and the share of their rectangle that is pale.
struct Wall {
  int wide = 0, high = 0;
  double filled = 0;
  explicit Wall(const Image& image) {
    std::vector<int> in_row(std::size_t(image.height), 0), in_column(std::size_t(image.width), 0);
    double all = 0;
    for (std::size_t k = 0; k < image.pixel.size(); ++k)
      if (image.pixel[k] == wall) {
        ++in_row[k / std::size_t(image.width)];
        ++in_column[k % std::size_t(image.width)];
        ++all;
      }
    for (const int n : in_row) high += n > 8;
    for (const int n : in_column) wide += n > 8;
    filled = high > 0 && wide > 0 ? all / (double(wide) * high) : 0;
  }
};

class Scenes : public ::testing::Test {
 protected:
  Image drawn(const Json& picture) {
    for (const auto& entry : fs::directory_iterator(to_.path())) fs::remove(entry.path());
    const auto made = render(from_.path(), to_.path(), {{"size", 400}, {"pictures", {picture}}}, host_);
    EXPECT_TRUE(host_.warnings.empty()) << host_.warnings[0];
    return read(made.at(0));
  }
  Names usual() { return names(render(from_.path(), to_.path(), {{"size", 200}}, host_)); }
  Folder from_, to_;
  QuietHost host_;
};

/// Lit from the upper left, a platen's side is a little darker than its own grey.
inline double platens(const Image& image) { return image.share_of(169, 176, 182); }
inline bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace breccia::test
