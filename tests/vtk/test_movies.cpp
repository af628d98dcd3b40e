// SPDX-License-Identifier: BSD-3-Clause
// Movies: what goes to the program that makes them, and what happens without it. Charts that are drawn with signs.
#include <sys/stat.h>

#include <cstdlib>
#include <numeric>
#include <sstream>

#include "made_scene.hpp"
#include "png_image.hpp"

namespace breccia::test {
namespace {

class Movies : public ::testing::Test {
 protected:
  void SetUp() override {
    before_ = std::getenv("PATH") ? std::getenv("PATH") : "";
    write_frames(Specimen(200, 3), from_.path());
  }
  void TearDown() override { setenv("PATH", before_.c_str(), 1); }
  /// A program of this name and text comes before all others.
  void use(const std::string& script) {
    const fs::path file = programs_.file("ffmpeg", script);
    chmod(file.c_str(), 0755);
    setenv("PATH", (programs_.path().string() + ":" + before_).c_str(), 1);
  }
  std::vector<fs::path> make_movie(const char* format) {
    const Json config = {
        {"size", 201},
        {"pictures", {{{"show", "specimen"}, {"name", "still"}}, {{"show", "specimen"}, {"movie", format}}}}};
    return render(from_.path(), to_.path(), config, host_);
  }
  void expect_nothing_left() {
    EXPECT_EQ(std::distance(fs::directory_iterator(to_.path()), fs::directory_iterator()), 1) << "the still";
    ASSERT_EQ(host_.warnings.size(), 1u);
  }
  std::string before_;
  Folder from_, to_, programs_;
  QuietHost host_;
};

TEST_F(Movies, EachFrameGoesToTheProgramOnce) {
  use("#!/bin/sh\nfor last; do :; done\nwc -c > \"${last#file:}\"\n");
  const auto made = make_movie("mp4");
  EXPECT_EQ(names(made), (Names{"still.png", "specimen.mp4"}));
  const Image still = read(made.at(0));
  std::size_t got = 0;
  std::istringstream(bytes(made.at(1))) >> got;
  EXPECT_EQ(got, std::size_t(2 * 3 * still.width * still.height)) << "two frames";
  EXPECT_EQ(std::distance(fs::directory_iterator(to_.path()), fs::directory_iterator()), 2) << "and nothing else";
}

TEST_F(Movies, WithoutTheProgramAWarningTakesTheirPlace) {
  setenv("PATH", programs_.path().c_str(), 1);
  EXPECT_EQ(names(make_movie("webm")), (Names{"still.png"}));
  expect_nothing_left();
  EXPECT_NE(host_.warnings[0].find("movie `specimen` was not made: there is no program ffmpeg"), std::string::npos)
      << host_.warnings[0];
}

TEST_F(Movies, WhatTheProgramSaysOfItsFailureIsTold) {
  use("#!/bin/sh\necho 'Unknown encoder' >&2\nexit 1\n");
  EXPECT_EQ(names(make_movie("gif")), (Names{"still.png"}));
  expect_nothing_left();
  EXPECT_NE(host_.warnings[0].find("Unknown encoder"), std::string::npos) << host_.warnings[0];
}

TEST_F(Movies, TheProgramOfThisMachineMakesThem) {
  for (const auto& [format, at, mark] :
       {std::tuple("mp4", 4, "ftyp"), std::tuple("webm", 0, "\x1A\x45\xDF\xA3"), std::tuple("gif", 0, "GIF8")}) {
    const auto made = make_movie(format);
    if (made.size() < 2) GTEST_SKIP() << host_.warnings.at(0);
    EXPECT_EQ(bytes(made[1]).substr(std::size_t(at), 4), mark);
  }
}

class Signs : public ::testing::Test {
 protected:
  /// Pulled to 10 MPa at -0.1 %, then torn; it swings to 2 MPa of pressure.
  std::string svg(const std::string& docs) {
    std::ofstream(from_.path() / "curves.csv") << "platen_strain,platen_stress_Pa,load_N,platen_displacement_m\n0,0,0,"
                                                  "0\n-5e-4,-5e6,50,1e-5\n-1e-3,-1e7,100,2e-5\n"
                                                  "-1.1e-3,2e6,-20,2.2e-5\n-1.2e-3,0,0,2.4e-5\n";
    if (!docs.empty()) from_.file("curves.json", docs);
    EXPECT_EQ(names(render(from_.path(), to_.path(), {{"size", 400}}, host_)),
              (Names{"load_curve.png", "load_curve.svg", "load_curve.pdf", "stress_strain.png", "stress_strain.svg",
                     "stress_strain.pdf"}));
    return bytes(to_.path() / "stress_strain.svg");
  }
  Folder from_, to_;
  QuietHost host_;
};

TEST_F(Signs, TensionIsDrawnUpwardWithItsPeak) {
  const std::string text = svg(
      R"([{"header": "platen_strain", "name": "platen_strain", "unit": "1", "doc": "of the plates; compression positive"},
          {"header": "platen_stress_Pa", "name": "platen_stress", "unit": "Pa", "doc": "mean load; compression positive"},
          {"header": "load_N", "name": "load", "unit": "N", "doc": "a"},
          {"header": "platen_displacement_m", "name": "platen_displacement", "unit": "m", "doc": "b"}])");
  for (const char* part :
       {"peak 10 MPa at 0.1 %", ">platen strain ε, extension + (%)<", ">platen stress σ, tension + (MPa)<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(Signs, ThePdfIsWholeAndTheSameEveryTime) {
  svg("");
  const std::string first = bytes(to_.path() / "load_curve.pdf");
  EXPECT_EQ(first.substr(0, 5), "%PDF-");
  EXPECT_NE(first.find("%%EOF"), std::string::npos);
  svg("");
  EXPECT_EQ(first, bytes(to_.path() / "load_curve.pdf"));
}

}  // namespace
}  // namespace breccia::test
