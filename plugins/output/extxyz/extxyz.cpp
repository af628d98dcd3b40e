// SPDX-License-Identifier: BSD-3-Clause
/// Frames for OVITO, ASE and whatever else reads the extended XYZ format.
#include "../../shared/frame_interval.hpp"
#include "breccia/atomic_file.hpp"
#include "breccia/output.hpp"
#include "frame.hpp"
#include "gzip.hpp"

namespace breccia {
namespace fs = std::filesystem;

class ExtxyzOutput final : public Output {
 public:
  struct Config {
    double interval;
    extxyz::Precision precision;
    bool gzip;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Particles as extended XYZ files (.xyz), for OVITO and ASE")
        .details(
            "Writes `particles_NNNNNN.xyz`, one file a frame: each has its name only when it is whole, and a run that "
            "goes on from a checkpoint need not cut a file. OVITO opens the first as a series; `cat particles_*.xyz` "
            "makes one file of all. The README of the plugin lists the columns; all are SI.")
        .source("the extended XYZ format, as OVITO and ASE read it");
    frame_interval(s, &Config::interval);
    s.param("precision", &Config::precision)
        .choice("single", extxyz::Precision::single_precision, "some 8 digits")
        .choice("double", extxyz::Precision::double_precision, "some 16 digits: files about twice as large")
        .doc("of the fields; centres and radii always come back with the same bits")
        .fallback("single");
    s.param("gzip", &Config::gzip).fallback(false).doc("compress each file (`.xyz.gz`): a third of the size");
  }

  explicit ExtxyzOutput(const Config& config) : config_(config) {}

  void begin(const fs::path& directory, Host&) override {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error) throw CannotWrite(directory, error.value());
    directory_ = directory;
    frames_ = 0;
  }

  void frame(const SimulationView& view, std::span<const Field> fields) override {
    const std::string text = extxyz::frame_text(view, fields, config_.precision);
    write_file(file(frames_), config_.gzip ? gzipped(text) : text);
    ++frames_;
  }

  double interval() const override { return config_.interval; }

  bool archive(Archive& archive) override {
    archive("frames", frames_);
    if (!archive.reading()) return true;
    std::error_code none;  // frames after the checkpoint
    for (std::uint64_t k = frames_; fs::remove(file(k), none); ++k) continue;
    return true;
  }

 private:
  fs::path file(std::uint64_t number) const {
    std::string count = std::to_string(number);
    if (count.size() < 6) count.insert(0, 6 - count.size(), '0');
    return directory_ / ("particles_" + count + (config_.gzip ? ".xyz.gz" : ".xyz"));
  }

  Config config_;
  fs::path directory_;
  std::uint64_t frames_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::ExtxyzOutput, "output", "extxyz")
