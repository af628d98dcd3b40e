// SPDX-License-Identifier: BSD-3-Clause
/// A pair of spheres that is moved as one likes, with a law between them and nothing else: no engine.
#pragma once

#include <memory>
#include <random>

#include "breccia/contact_law.hpp"
#include "workflow/guarded_law.hpp"

namespace breccia {

/// How a pair moves, at constant rates over a step.
struct PairMotion {
  Vec3 velocity_i = Vec3::Zero(), velocity_j = Vec3::Zero();  // [m/s]
  Vec3 spin_i = Vec3::Zero(), spin_j = Vec3::Zero();          // [rad/s]
};

/// What the law answers, as the two spheres feel it.
struct PairResponse {
  Vec3 force = Vec3::Zero();                                   ///< on i, minus this on j [N]
  Vec3 torque_i = Vec3::Zero(), torque_j = Vec3::Zero();       // [N m]
  double breaks = 0, friction = 0, contact = 0, fracture = 0;  // -, [J]
  bool finite() const {
    return force.allFinite() && torque_i.allFinite() && torque_j.allFinite() &&
           std::isfinite(friction + contact + fracture);
  }
};

class LawRig {
 public:
  /// Of the spring whose force a law that adds to others sees before its own [N/m].
  static constexpr double spring_before = 1e7;

  struct Start {
    double radius_i = 1e-3, radius_j = 0.8e-3, gap = 0;  ///< [m]; the gap is without force
    bool bonded = true;
    Mat3 turned = Mat3::Identity();  ///< of the whole set-up, from a pair along x
    bool swapped = false;            ///< i is the one that would be j
  };
  /// `law` is prepared; `width`: how many such pairs stand in the chunk.
  LawRig(ContactLaw& law, const Start& start, double time_step, std::size_t width = 8);

  /// Moves on by a step. The motion is that of the pair along x, i first.
  PairResponse step(const PairMotion& motion);
  double energy();  ///< stored [J]
  ContactStiffness stiffness();
  double work() const { return work_; }  ///< done on the pair by whoever moves it [J]
  double way() const { return way_; }    ///< the same, each step's in absolute value [J]
  const PairResponse& last() const { return last_; }
  std::vector<double> history() const;
  bool intact() const { return intact_; }
  double distance() const { return (x_[1] - x_[0]).norm(); }
  PairChunk& chunk() { return *chunk_; }  ///< the pair as the law last saw it

 private:
  void gather();
  PairResponse evaluate();

  ContactLaw& law_;
  Start start_;
  double dt_;
  std::size_t width_;
  Vec3 x_[2], v_[2], w_[2];
  double r_[2], rest_ = 0;
  bool intact_ = true;
  std::vector<std::vector<double>> columns_;
  std::vector<double*> history_;
  std::unique_ptr<PairChunk> chunk_;
  PairResponse last_;
  double work_ = 0, way_ = 0;
};

}  // namespace breccia
