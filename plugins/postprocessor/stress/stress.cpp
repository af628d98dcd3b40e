// SPDX-License-Identifier: BSD-3-Clause
/// Micromechanical stress: volume average over the specimen, and of each particle.
/// Source: Christoffersen et al. (1981), J. Appl. Mech. 48, 339-344; Rojek et al. (2012), section 5.3.
#include <algorithm>
#include <array>
#include <cmath>

#include "breccia/block_sum.hpp"
#include "breccia/postprocessor.hpp"

namespace breccia {
namespace {

/// Compression positive. In two dimensions there is no stress out of the plane: the mean is over the two that are.
double pressure(const Mat3& stress, int dimension) { return -stress.trace() / dimension; }

/// sqrt(3/2 s:s) with the deviator s (von Mises); in two dimensions the difference of the principal stresses.
double equivalent(const Mat3& stress, int dimension) {
  Mat3 s = stress;
  for (int k = 0; k < dimension; ++k) s(k, k) += pressure(stress, dimension);
  return std::sqrt((dimension == 3 ? 1.5 : 2.0) * s.squaredNorm());
}

Mat3 symmetric(const Mat3& m) { return 0.5 * (m + m.transpose()); }

}  // namespace

class Stress final : public Postprocessor {
 public:
  struct Config {};
  static void describe(Schema<Config>& s) {
    s.summary("Stress from the forces between the particles, averaged over the specimen")
        .source(
            "Christoffersen, Mehrabadi, Nemat-Nasser (1981), J. Appl. Mech. 48, 339-344; "
            "Rojek et al. (2012), section 5.3")
        .details(
            "sigma = (1/V) [sum over pairs of l_ij (x) F on i + sum over wall contacts, applied forces and forces that "
            "hold a particle of (point where it acts - centre) (x) force on the particle], l_ij from centre i to "
            "centre j, V the volume of the specimen as measured at the start of loading. As that volume stays while "
            "the specimen grows shorter, the axial stress is that of the platens (force over the area at the start) "
            "times the present height over that at the start: 1 % below it at a strain of 1 %. Components are positive "
            "in tension; `axial_stress`, `lateral_stress` and `mean_stress` "
            "are positive in compression.");
  }

  explicit Stress(const Config&) {}
  bool sees_parts() const override { return true; }

  void begin(const SimulationView& view, Recorder& recorder, Host&) override {
    if (!(view.specimen.volume > 0))
      throw UserError("stress: the specimen has no volume to average over; check the packing");
    const std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
    for (std::size_t k = 0; k < 6; ++k)
      tensor_[k] = recorder.add({std::string("stress_") + names[k], "Pa", "mean stress, positive in tension"});
    axial_ = recorder.add(
        {"axial_stress", "Pa", "mean stress along the specimen axis, positive in compression", role::stress});
    lateral_ = recorder.add({"lateral_stress", "Pa", "mean stress across the axis, positive in compression"});
    mean_ = recorder.add({"mean_stress", "Pa", "third of the trace (half in two dimensions), positive in compression"});
    deviatoric_ = recorder.add({"deviatoric_stress", "Pa",
                                "von Mises equivalent; in two dimensions the difference of the principal stresses"});
    skew_ = recorder.add({"stress_skew_part", "Pa",
                          "norm of the antisymmetric part of the mean stress before it is dropped; zero in equilibrium "
                          "without moments"});
  }

  void sample(const SimulationView& view, Recorder& recorder) override {
    const Mat3 whole = average(view), s = symmetric(whole);
    const double components[6] = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)};
    for (std::size_t k = 0; k < 6; ++k) recorder.set(tensor_[k], components[k]);
    const double along = view.specimen.axis.dot(s * view.specimen.axis);
    recorder.set(axial_, -along);
    recorder.set(lateral_, -(s.trace() - along) / (view.dimension - 1));
    recorder.set(mean_, pressure(s, view.dimension));
    recorder.set(deviatoric_, equivalent(s, view.dimension));
    recorder.set(skew_, (whole - s).norm());
  }

  void fields(const SimulationView& view, std::vector<Field>& fields) override {
    Field p{Field::On::particles, "pressure", "Pa", 1, {}};
    Field q{Field::On::particles, "deviatoric_stress", "Pa", 1, {}};
    Field tensor{Field::On::particles, "stress", "Pa", 6, {}};
    const std::vector<Mat3> stress = of_particles(view);
    for (const Mat3& s : stress) {
      p.values.push_back(pressure(s, view.dimension));
      q.values.push_back(equivalent(s, view.dimension));
      for (const double c : {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)}) tensor.values.push_back(c);
    }
    fields.push_back(std::move(p));
    fields.push_back(std::move(q));
    fields.push_back(std::move(tensor));
  }

  void finish(const SimulationView& view, const Curves& curves, Summary& summary) override {
    const auto largest = [&](const char* name) {
      double value = 0;
      for (const double v : curves.column(name)) value = std::max(value, std::abs(v));
      return value;
    };
    summary.own({"volume", "m3"}, view.specimen.volume);
    summary.own({"largest_deviatoric_stress", "Pa"}, largest("deviatoric_stress"));
    summary.own({"largest_mean_stress", "Pa"}, largest("mean_stress"));
    summary.own({"largest_skew_part", "Pa"}, largest("stress_skew_part"));
  }
  bool archive(Archive&) override { return true; }

 private:
  /// Not symmetrised. In equilibrium equal to the sum over the boundary forces of position (x) force, over the volume:
  /// compression pushes against the branch vector, hence negative.
  static Mat3 average(const SimulationView& view) {
    const auto& x = view.particles.position;
    BlockSum<Mat3> of_pairs(view), of_boundary(view);
    for (const std::size_t k : view.own_pairs()) {
      const PairForce& f = view.pairs.force[k];
      of_pairs.add(view.pairs.i[k],
                   view.branch(x[view.pairs.i[k]], x[view.pairs.j[k]]) * Vec3(f.fx, f.fy, f.fz).transpose());
    }
    ExactSumOf<Mat3> of_walls;
    for (const WallContact& c : view.wall_contacts) of_walls.add((c.point - x[c.particle]) * c.force.transpose());
    if (const auto moment = view.particles.boundary_moment; !moment.empty())
      for (const std::size_t k : view.own_particles()) of_boundary.add(k, moment[k]);
    const auto [pairs, walls, boundary] = view.sum(of_pairs.exact(), of_walls, of_boundary.exact());
    return (pairs + walls + boundary) / view.specimen.volume;
  }

  /// Over the volume of each particle: sum over its contacts of (contact point - centre) (x) force. Of copies in a part
  /// not all contacts are there.
  static std::vector<Mat3> of_particles(const SimulationView& view) {
    const ParticlesView& p = view.particles;
    std::vector<Mat3> stress(p.size(), Mat3::Zero());
    for (std::size_t k = 0; k < view.pairs.size(); ++k) {
      const Index i = view.pairs.i[k], j = view.pairs.j[k];
      const PairForce& f = view.pairs.force[k];
      const Vec3 force(f.fx, f.fy, f.fz);
      if (force.isZero(0)) continue;
      const Mat3 unit = view.branch(p.position[i], p.position[j]).normalized() * force.transpose();
      stress[i] += (p.radius[i] + f.half_gap) * unit;  // j feels the opposite force on its opposite side
      stress[j] += (p.radius[j] + f.half_gap) * unit;
    }
    for (const WallContact& c : view.wall_contacts)
      stress[c.particle] += (c.point - p.position[c.particle]) * c.force.transpose();
    for (std::size_t k = 0; k < p.boundary_moment.size(); ++k) stress[k] += p.boundary_moment[k];
    for (std::size_t k = 0; k < stress.size(); ++k) stress[k] = symmetric(stress[k] / view.solid_volume(p.radius[k]));
    return stress;
  }

  std::array<std::size_t, 6> tensor_{};
  std::size_t axial_ = 0, lateral_ = 0, mean_ = 0, deviatoric_ = 0, skew_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::Stress, "postprocessor", "stress")
