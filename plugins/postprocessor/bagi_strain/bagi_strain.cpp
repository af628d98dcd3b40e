// SPDX-License-Identifier: BSD-3-Clause
/// Strain of the whole specimen and around each particle. Source: Bagi (1996), Mech. Mater. 22, 165-177.
#include <algorithm>
#include <array>

#include "breccia/postprocessor.hpp"
#include "mean_strain.hpp"

namespace breccia {
namespace {

/// What rock mechanics reads off a strain tensor that is positive in extension.
struct RockStrain {
  double axial, lateral, volumetric;
  RockStrain(const Mat3& strain, const Vec3& axis, int dimension) {
    const double along = axis.dot(strain * axis), trace = strain.trace();
    axial = -along;
    lateral = (trace - along) / (dimension - 1);
    volumetric = -trace;
  }
};

Mat3 symmetric(const Mat3& g) { return 0.5 * (g + g.transpose()); }

}  // namespace

class BagiStrain final : public Postprocessor {
 public:
  struct Config {
    double hull_gap;
    long min_bonds;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Equivalent-continuum strain of the specimen, from the displacements of all particles")
        .source("Bagi (1996), Mechanics of Materials 22, 165-177; Rojek et al. (2012), section 5.3")
        .details(
            "The centres are joined to tetrahedra (triangles in two dimensions) by their regular triangulation, at the "
            "first step and again at the start of loading. Displacements are linear in each; the strain is the "
            "symmetric part of their volume-weighted mean gradient, for small strains. Where all corners of a simplex "
            "are held, in the grips of a tension test, it does not count. Components are positive in "
            "extension; `axial_strain` and `volumetric_strain` are positive in compression, `lateral_strain` in "
            "extension.");
    s.param("hull_gap", &Config::hull_gap)
        .above(0)
        .fallback(1.0)
        .doc(
            "simplices on the outline that bridge a gap between two particles wider than this many mean particle "
            "diameters are left out, from outside inward");
    s.param("min_bonds", &Config::min_bonds)
        .at_least(0)
        .at_most(12)
        .fallback(0)
        .doc(
            "particles that have fewer bonds when the specimen is bonded do not count: loose ones on the surface move "
            "without it");
  }

  explicit BagiStrain(const Config& config) : config_(config) {}

  void begin(const SimulationView& view, Recorder& recorder, Host& host) override {
    if (view.cell.repeats())
      throw UserError(
          "bagi_strain: where space repeats itself (`periodic`) a specimen has no outline to measure strain within: "
          "use the "
          "strain of the cell, which the protocol periodic_cell writes");
    const std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    for (std::size_t k = 0; k < 6; ++k)
      tensor_[k] = recorder.add({std::string("strain_") + names[k], "1", "mean strain, positive in extension"});
    axial_ = recorder.add(
        {"axial_strain", "1", "mean strain along the specimen axis, positive in compression", role::strain});
    lateral_ = recorder.add(
        {"lateral_strain", "1", "mean strain across the axis, positive in extension", role::lateral_strain});
    volumetric_ = recorder.add({"volumetric_strain", "1", "mean volumetric strain, positive in compression"});
    refer(view);
    if (mean_.report().peeled_volume_share > 0.25)
      host.warn(
          "bagi_strain: more than a quarter of the volume spanned by the particle centres counts as gaps of the "
          "outline and is left out of the strain; if the packing is meant to be this loose, raise hull_gap");
  }

  void start_of_loading(const SimulationView& view) override { refer(view); }

  void sample(const SimulationView& view, Recorder& recorder) override {
    if (stale_) triangulate_reference(view);
    const Mat3 e = symmetric(mean_.gradient(of_kept(view.particles.position, position_)));
    const double components[6] = {e(0, 0), e(1, 1), e(2, 2), e(0, 1), e(1, 2), e(2, 0)};
    for (std::size_t k = 0; k < 6; ++k) recorder.set(tensor_[k], components[k]);
    const RockStrain rock(e, view.specimen.axis, view.dimension);
    recorder.set(axial_, rock.axial);
    recorder.set(lateral_, rock.lateral);
    recorder.set(volumetric_, rock.volumetric);
  }

  void fields(const SimulationView& view, std::vector<Field>& fields) override {
    if (stale_) triangulate_reference(view);
    Field axial{Field::On::particles, "axial_strain_local", "1", 1, {}};
    Field volumetric{Field::On::particles, "volumetric_strain_local", "1", 1, {}};
    const std::vector<Mat3> gradients = mean_.local_gradients(of_kept(view.particles.position, position_));
    for (const Index k : shown_as_) {
      const RockStrain rock(symmetric(gradients[k]), view.specimen.axis, view.dimension);
      axial.values.push_back(rock.axial);
      volumetric.values.push_back(rock.volumetric);
    }
    fields.push_back(std::move(axial));
    fields.push_back(std::move(volumetric));
  }

  void finish(const SimulationView& view, const Curves&, Summary& summary) override {
    const MeanStrain::Report& r = mean_.report();
    const double volume = r.volume * (view.dimension == 2 ? view.thickness : 1.0);
    summary.own("simplices", r.simplices);
    summary.own("flat_simplices_left_out", r.flat);
    summary.own("outline_simplices_left_out", r.peeled);
    summary.own("gripped_simplices_left_out", r.gripped);
    summary.own("outline_volume_share_left_out", r.peeled_volume_share);
    summary.own("hidden_particles", r.hidden);
    summary.own("loose_particles_left_out", shown_as_.size() - kept_.size());
    summary.own("boundary_particles", r.boundary);
    summary.own({"triangulated_volume", "m3"}, volume);
    const double specimen = view.specimen.volume;
    summary.own("triangulated_share_of_specimen", specimen > 0 ? Json(volume / specimen) : Json());
  }
  bool archive(Archive& archive) override {
    archive("reference", reference_);
    archive("held", held_);
    stale_ = archive.reading();
    return true;
  }

 private:
  /// The reference is what the engine counts displacements from; it, and who is held, can only change at the start of
  /// loading.
  void refer(const SimulationView& view) {
    const ParticlesView& p = view.particles;
    const auto now = p.initial_position;
    std::vector<std::uint8_t> held(p.held.begin(), p.held.end());
    if (held == held_ && std::equal(now.begin(), now.end(), reference_.begin(), reference_.end())) return;
    reference_.assign(now.begin(), now.end());
    held_ = std::move(held);
    triangulate_reference(view);
  }

  void triangulate_reference(const SimulationView& view) {
    const ParticlesView& p = view.particles;
    stale_ = false;
    double mean_radius = 0;
    for (const double r : p.radius) mean_radius += r / double(p.size());
    choose(view);
    std::vector<double> radius;
    std::vector<std::uint8_t> rigid;
    const std::uint8_t all = view.dimension == 2 ? dof::x | dof::y : dof::x | dof::y | dof::z;
    for (const Index k : kept_) {
      radius.push_back(p.radius[k]);
      rigid.push_back(!held_.empty() && (held_[k] & all) == all);
    }
    mean_ =
        MeanStrain(view.dimension, of_kept(reference_, position_), radius, config_.hull_gap * 2 * mean_radius, rigid);
  }

  /// The particles that count, and for each particle the one whose local strain it shows: itself, or the nearest that
  /// counts.
  void choose(const SimulationView& view) {
    const ParticlesView& p = view.particles;
    std::vector<long> bonds(p.size(), 0);
    for (std::size_t k = 0; k < view.bonds.size(); ++k) {
      ++bonds[view.bonds.i[k]];
      ++bonds[view.bonds.j[k]];
    }
    kept_.clear();
    shown_as_.assign(p.size(), 0);
    for (Index k = 0; k < p.size(); ++k) {
      if (bonds[k] < config_.min_bonds) continue;
      shown_as_[k] = Index(kept_.size());
      kept_.push_back(k);
    }
    if (kept_.size() <= std::size_t(view.dimension))
      throw UserError("bagi_strain: hardly a particle has min_bonds bonds: lower it, or bond more neighbours");
    for (Index k = 0; k < p.size(); ++k) {
      if (bonds[k] >= config_.min_bonds) continue;
      double least = 1e300;
      for (std::size_t n = 0; n < kept_.size(); ++n) {
        const double d = (p.initial_position[kept_[n]] - p.initial_position[k]).squaredNorm();
        if (d < least) {
          least = d;
          shown_as_[k] = Index(n);
        }
      }
    }
  }

  Strided<const Vec3> of_kept(Strided<const Vec3> all, std::vector<Vec3>& into) const {
    if (kept_.size() == all.size()) return all;
    into.clear();
    for (const Index k : kept_) into.push_back(all[k]);
    return into;
  }

  Config config_;
  MeanStrain mean_;
  std::vector<Index> kept_, shown_as_;
  std::vector<Vec3> reference_, position_;
  std::vector<std::uint8_t> held_;
  bool stale_ = false;  ///< the reference came from a checkpoint
  std::array<std::size_t, 6> tensor_{};
  std::size_t axial_ = 0, lateral_ = 0, volumetric_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::BagiStrain, "postprocessor", "bagi_strain")
