// SPDX-License-Identifier: BSD-3-Clause
/// Frames for ParaView and every other reader of VTK's XML formats.
#include <optional>

#include "../../shared/frame_interval.hpp"
#include "breccia/output.hpp"
#include "poly_data.hpp"
#include "series.hpp"

namespace breccia {
namespace {

enum class Pieces { one, ranks };

}  // namespace

class VtkOutput final : public Output {
 public:
  struct Config {
    double interval;
    vtk_output::Precision precision;
    bool bonds, cracks, walls;
    Pieces pieces;
  };

  static void describe(Schema<Config>& s) {
    s.summary("Particles, bonds, cracks and walls as VTK files (.vtp) with time series (.pvd) for ParaView")
        .details(
            "Writes `particles_NNNNNN.vtp`, `bonds_NNNNNN.vtp`, `cracks_NNNNNN.vtp` and `walls_NNNNNN.vtp` with "
            "`particles.pvd`, `bonds.pvd`, `cracks.pvd` and `walls.pvd`. The README of the plugin lists the arrays. "
            "Each array's unit is its `UNITS_LABEL` "
            "information key; all are SI.")
        .source("VTK file formats, version 9.1 (inline binary, LZ4)");
    frame_interval(s, &Config::interval);
    s.param("precision", &Config::precision)
        .choice("single", vtk_output::Precision::single_precision, "32 bits")
        .choice("double", vtk_output::Precision::double_precision, "64 bits: files about twice as large")
        .doc("of the fields; centres and radii are always written in 64 bits")
        .fallback("single");
    s.param("bonds", &Config::bonds).fallback(true).doc("write the bonds; pictures of cracks need them");
    s.param("cracks", &Config::cracks)
        .fallback(true)
        .doc("write what broke so far, a point for each crack, where there are bonds");
    s.param("walls", &Config::walls).fallback(true).doc("write the walls");
    s.param("pieces", &Config::pieces)
        .choice("one", Pieces::one, "a file a frame, written by the first rank: the same for any number of ranks")
        .choice("ranks", Pieces::ranks,
                "each rank of a job writes its part beside the others, and the first a .pvtp file that joins them")
        .doc("of a specimen that several ranks share")
        .fallback("one");
  }

  explicit VtkOutput(const Config& config) : config_(config) {}

  void begin(const std::filesystem::path& directory, Host&) override {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) throw UserError("output vtk: cannot make the folder " + directory.string() + ": " + error.message());
    particles_.emplace(directory, "particles", sees_parts());
    bonds_.emplace(directory, "bonds", sees_parts());
    cracks_.emplace(directory, "cracks", sees_parts());
    walls_.emplace(directory, "walls", sees_parts());
    specimen_.reset();
  }

  void frame(const SimulationView& view, std::span<const Field> fields) override {
    BRECCIA_ASSERT(particles_.has_value());
    // The walls keep the size of the first frame, however far fragments fly.
    if (!specimen_) specimen_ = vtk_output::bounds_of(view);
    const auto append = [&](vtk_output::Series& to, vtkPolyData* data) {
      if (sees_parts()) to.append_piece(data, view);
      else to.append(data, view.time);
    };
    append(*particles_, vtk_output::particle_data(view, fields, config_.precision));
    if (config_.bonds) append(*bonds_, vtk_output::bond_data(view, fields, config_.precision, sees_parts()));
    if (config_.cracks && view.max(double(view.bonds.size())) > 0)
      append(*cracks_, vtk_output::crack_data(view, config_.precision));
    if (config_.walls && !view.walls.empty() && (!view.part || view.part->number == 0))
      walls_->append(vtk_output::wall_data(view, *specimen_), view.time);
  }

  bool sees_parts() const override { return config_.pieces == Pieces::ranks; }
  double interval() const override { return config_.interval; }
  bool archive(Archive& archive) override {
    archive("particles", *particles_);
    archive("bonds", *bonds_);
    archive("cracks", *cracks_);
    archive("walls", *walls_);
    archive("specimen", specimen_);
    return true;
  }

 private:
  Config config_;
  std::optional<vtk_output::Series> particles_, bonds_, cracks_, walls_;
  std::optional<vtk_output::Bounds> specimen_;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::VtkOutput, "output", "vtk")
