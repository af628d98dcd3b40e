// SPDX-License-Identifier: BSD-3-Clause
/// Fabric tensor of bond or contact directions. Source: Satake (1982); Kanatani (1984), Int. J. Eng. Sci. 22, 149-164.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "breccia/block_sum.hpp"
#include "breccia/postprocessor.hpp"

namespace breccia {
namespace {

enum class Of { bonds, touching };

/// <n (x) n>, and over how many directions; zero when there are none.
struct Fabric {
  Mat3 tensor = Mat3::Zero();
  std::size_t count = 0;

  Mat3 deviator(int dimension) const {
    Mat3 d = tensor;
    for (int k = 0; k < dimension; ++k) d(k, k) -= tensor.trace() / dimension;
    return d;
  }
  /// q = sqrt(3/2 F':F') of the deviator F', in the plane sqrt(2 F':F'): the difference of the principal values, in
  /// space when two of them are equal. Between 0 (isotropic) and 1 (all directions the same).
  double invariant(int dimension) const {
    return count == 0 ? 0 : std::sqrt(dimension == 3 ? 1.5 : 2.0) * deviator(dimension).norm();
  }
  /// 0 when isotropic. Size of the second-order term of the density of directions,
  /// E(n) = (1 + F : n (x) n)/(4 pi), F = 15/2 dev, sqrt(3/2 F:F); in the plane
  /// E(n) = (1 + F : n (x) n)/(2 pi), F = 4 dev, sqrt(1/2 F:F).
  double anisotropy(int dimension) const { return invariant(dimension) * (dimension == 3 ? 7.5 : 2); }
};

class Directions {
 public:
  explicit Directions(const SimulationView& view) : view_(view), tensor_(view), count_(view) {}
  void add(std::size_t lower_particle, const Vec3& branch) {
    const Vec3 n = branch.normalized();
    tensor_.add(lower_particle, n * n.transpose());
    count_.add(lower_particle, 1);
  }
  Fabric all() {
    const auto [tensor, count] = view_.sum(tensor_.exact(), count_.exact());
    return {count > 0 ? Mat3(tensor / double(count)) : tensor, count};
  }

 private:
  const SimulationView& view_;
  BlockSum<Mat3> tensor_;
  BlockSum<std::size_t> count_;
};

Json json(const Mat3& m) {
  Json rows = Json::array();
  for (int a = 0; a < 3; ++a) rows.push_back({m(a, 0), m(a, 1), m(a, 2)});
  return rows;
}

struct Principal {
  Json values = Json::array();      ///< the largest first
  Json directions = Json::array();  ///< unit vectors, their largest component positive

  Principal(const Mat3& tensor, int dimension) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(tensor.topLeftCorner(dimension, dimension));
    for (int k = dimension - 1; k >= 0; --k) {
      Vec3 n = Vec3::Zero();
      n.head(dimension) = solver.eigenvectors().col(k);
      Eigen::Index largest;
      n.cwiseAbs().maxCoeff(&largest);
      if (n[largest] < 0) n = -n;
      values.push_back(solver.eigenvalues()[k]);
      directions.push_back({n[0], n[1], n[2]});
    }
  }
};

/// Keys begin with `when`. Without directions there are no principal ones.
void report(const Fabric& f, int dimension, const std::string& when, Summary& summary) {
  summary.own(when + "_fabric", json(f.tensor));
  summary.own(when + "_anisotropy", f.anisotropy(dimension));
  summary.own(when + "_deviator", f.count > 0 ? json(f.deviator(dimension)) : Json());
  summary.own(when + "_deviatoric_invariant", f.invariant(dimension));
  const Principal principal(f.tensor, dimension);
  summary.own(when + "_principal_values", f.count > 0 ? principal.values : Json());
  summary.own(when + "_principal_directions", f.count > 0 ? principal.directions : Json());
}

bool touches(const PairForce& f) { return f.fx != 0 || f.fy != 0 || f.fz != 0; }

}  // namespace

class FabricTensor final : public Postprocessor {
 public:
  struct Config {
    Of of;
    bool columns;
  };
  static void describe(Schema<Config>& s) {
    s.summary("Fabric tensor: mean of n (x) n over the directions of bonds or contacts")
        .source("Satake (1982); Kanatani (1984); Rojek et al. (2012), section 5.1")
        .details(
            "The trace is one; an isotropic assembly has 1/3 on the diagonal (1/2 in two dimensions). The headline "
            "`fabric_diagonal` is that of all bonds made, at the start of loading. The summary has tensor, deviator "
            "and its invariant, principal values and directions, at the start and at the end.");
    s.param("of", &Config::of)
        .choice("bonds", Of::bonds, "bonds that still hold")
        .choice("touching", Of::touching, "all pairs that exert a force on each other, bonded or not")
        .doc("which directions the curves and the final tensor count")
        .fallback("bonds");
    s.param("columns", &Config::columns).fallback(true).doc("write the diagonal to the curves at each sample");
  }

  explicit FabricTensor(const Config& config) : config_(config) {}
  bool sees_parts() const override { return true; }

  void begin(const SimulationView&, Recorder& recorder, Host&) override {
    if (!config_.columns) return;
    first_ = recorder.add({"fabric_xx", "1", "mean of n_x n_x over bonds or contacts"});
    second_ = recorder.add({"fabric_yy", "1", "mean of n_y n_y"});
    third_ = recorder.add({"fabric_zz", "1", "mean of n_z n_z"});
  }

  void sample(const SimulationView& view, Recorder& recorder) override {
    if (!config_.columns) return;
    const Mat3 f = present(view).tensor;
    recorder.set(first_, f(0, 0));
    recorder.set(second_, f(1, 1));
    recorder.set(third_, f(2, 2));
  }

  void finish(const SimulationView& view, const Curves&, Summary& summary) override {
    const Fabric before = initial(view), after = present(view);
    const Mat3& f = before.tensor;
    summary.headline("fabric_diagonal", before.count > 0 ? Json{f(0, 0), f(1, 1), f(2, 2)} : Json());
    report(before, view.dimension, "initial", summary);
    summary.own("initial_bonds", before.count);
    summary.own("final_of", config_.of == Of::bonds ? "bonds" : "touching");
    report(after, view.dimension, "final", summary);
    summary.own("final_count", after.count);
  }
  bool archive(Archive&) override { return true; }

 private:
  static Fabric initial(const SimulationView& view) {
    Directions d(view);
    for (const std::size_t b : view.own_bonds())
      d.add(view.bonds.i[b], view.initial_branch(view.bonds.i[b], view.bonds.j[b]));
    return d.all();
  }
  Fabric present(const SimulationView& view) const {
    Directions d(view);
    const auto& x = view.particles.position;
    const PairsView& pairs = view.pairs;
    for (const std::size_t k : view.own_pairs())
      if (config_.of == Of::bonds ? pairs.state[k] == BondState::intact : touches(pairs.force[k]))
        d.add(pairs.i[k], view.branch(x[pairs.i[k]], x[pairs.j[k]]));
    return d.all();
  }

  Config config_;
  std::size_t first_ = 0, second_ = 0, third_ = 0;
};

}  // namespace breccia

BRECCIA_PLUGIN(breccia::FabricTensor, "postprocessor", "fabric")
