// SPDX-License-Identifier: BSD-3-Clause
/// Movies, by the program ffmpeg: the frames go to it as they are drawn, no picture of them is kept.
#pragma once

#include <filesystem>
#include <string>

#include "caster.hpp"

namespace breccia::pictures {

enum class MovieFormat { mp4, webm, gif };

/// The ending of its files, without the dot.
std::string ending_of(MovieFormat format);

class Movie {
 public:
  /// Unavailable when there is no ffmpeg, or it cannot be started. `file` gets its name when it is whole.
  Movie(const std::filesystem::path& file, MovieFormat format, double frames_per_second);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// All of one size. UserError, with what ffmpeg says, when it gives up.
  void add(const Image& frame);
  void finish();

 private:
  void start(const Image& first);
  [[noreturn]] void fail();

  std::filesystem::path file_, partial_, log_;
  MovieFormat format_;
  double rate_;
  std::string program_;
  int pipe_ = -1, process_ = 0;
};

}  // namespace breccia::pictures
