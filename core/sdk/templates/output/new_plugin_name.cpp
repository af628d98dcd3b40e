// SPDX-License-Identifier: BSD-3-Clause
/// The particles as tables of text: one CSV file for each frame.
/// Sources: name the description of the format here; README.md says more.
#include <charconv>
#include <cstdio>

#include "breccia/atomic_file.hpp"
#include "breccia/output.hpp"

class NewPluginName final : public breccia::Output {
 public:
  /// What the workflow says, in SI units and within its range when it comes here.
  struct Config {
    double interval;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Particles as CSV, one file for each frame")
        .source("say where the format is described")
        .details("Writes `particles_000000.csv`, ... and `frames.csv` with their times.");
    s.param("interval", &Config::interval)
        .unit("s")
        .above(0)
        .fallback(1e-4)
        .doc("time between frames; the first and the last state are always written");
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  double interval() const override { return config_.interval; }

  /// Before the first frame. The folder is there, unless the workflow gives this output a name of its own.
  void begin(const std::filesystem::path& directory, breccia::Host&) override {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) throw breccia::UserError("cannot make the folder " + directory.string() + ": " + error.message());
    directory_ = directory;
  }

  /// `fields` are the core's and the post-processors': name, unit, values. Files are written by `write_file`, so that
  /// a name that exists is a whole file, and a full disk ends in a message.
  void frame(const breccia::SimulationView& view, std::span<const breccia::Field> fields) override {
    std::vector<const breccia::Field*> of_particles;
    std::string text = "id,x_m,y_m,z_m,radius_m";
    for (const breccia::Field& field : fields) {
      if (field.on != breccia::Field::On::particles) continue;
      of_particles.push_back(&field);
      for (int c = 0; c < field.components; ++c) text += "," + header(field, c);
    }
    text += "\n";
    const breccia::ParticlesView& p = view.particles;
    std::vector<std::size_t> row(p.size());  // in the order of the packing, not in that of the engine
    for (std::size_t k = 0; k < p.size(); ++k) row[p.id[k]] = k;
    for (const std::size_t k : row) {
      text += std::to_string(p.id[k]);
      for (const double x : {p.position[k].x(), p.position[k].y(), p.position[k].z(), p.radius[k]}) add(text, x);
      for (const breccia::Field* field : of_particles)
        for (int c = 0; c < field->components; ++c)
          add(text, field->values[k * std::size_t(field->components) + std::size_t(c)]);
      text += "\n";
    }
    char name[40];
    std::snprintf(name, sizeof name, "particles_%06zu.csv", times_.size());
    breccia::write_file(directory_ / name, text);

    times_.push_back(view.time);
    std::string frames = "frame,time_s\n";
    for (std::size_t f = 0; f < times_.size(); ++f) {
      frames += std::to_string(f);
      add(frames, times_[f]);
      frames += "\n";
    }
    breccia::write_file(directory_ / "frames.csv", frames);
  }

  /// All that changes while the test runs, for checkpoints: a run that goes on numbers its frames from here.
  bool archive(breccia::Archive& archive) override {
    archive("times", times_);
    return true;
  }

 private:
  /// As in curves.csv: the unit ends the header.
  static std::string header(const breccia::Field& field, int component) {
    std::string name = field.name;
    if (field.components == 3) name += std::string("_") + "xyz"[component];
    else if (field.components > 1) name += "_" + std::to_string(component);
    return breccia::ResultName(name, field.unit).key();
  }
  /// The shortest text that gives the same number when it is read.
  static void add(std::string& text, double value) {
    char digits[40];
    text += ',';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }

  Config config_;
  std::filesystem::path directory_;
  std::vector<double> times_;  // [s]
};

BRECCIA_PLUGIN(NewPluginName, "output", "new_plugin_name")
