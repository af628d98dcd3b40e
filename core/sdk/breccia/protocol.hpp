// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `protocol`: loads the specimen (walls, held particles, applied forces) and says when to stop.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// A rigid plane that particles press on through a linear penalty spring and Coulomb friction.
struct WallSpec {
  std::string name;
  Vec3 point = Vec3::Zero();          ///< [m]
  Vec3 normal = Vec3::UnitZ();        ///< toward the specimen
  double normal_stiffness = 0;        ///< [N/m]
  double shear_stiffness = 0;         ///< [N/m]; 0 without friction
  double friction = 0;
};

/// What a protocol may change, before the first step and at each step.
class LoadControl {
 public:
  virtual std::size_t add_wall(const WallSpec& spec) = 0;  ///< only in `setup`
  virtual void set_wall_velocity(std::size_t wall, const Vec3& velocity) = 0;
  /// Holds the velocity components in `mask` (bits of `dof`) of a particle at the given values.
  virtual void hold(Index particle, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity) = 0;
  virtual void release(Index particle, std::uint8_t mask) = 0;
  virtual void set_applied_force(Index particle, const Vec3& force) = 0;  ///< stays until set again [N]
  /// Starts the ledger of energies and the reference positions (displacements) afresh; rows of curves.csv begin here.
  virtual void mark_start_of_loading() = 0;
  virtual double time() const = 0;
  virtual double time_step() const = 0;

 protected:
  ~LoadControl() = default;
};

enum class Progress { running, finished };

class BRECCIA_API Protocol : public Plugin {
 public:
  static constexpr const char* kind = "protocol";
  /// Bonds exist; no step was made. Adds walls and columns.
  virtual void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) = 0;
  /// Before the forces of each step. Cheap: no allocation, no loop over particles unless needed.
  virtual void step(LoadControl& control) = 0;
  /// At each sample, with forces and positions of the same instant; fills its columns and may end the run.
  virtual Progress sample(const SimulationView& view, LoadControl& control, Recorder& recorder) = 0;
  virtual double share_done() const = 0;         ///< estimate, 0 to 1, for the progress bar
  virtual std::string status() const { return {}; }  ///< a few words for it ("stress 120 MPa")
  virtual void finish(const SimulationView&, const Curves&, Summary&) {}
  /// Everything that changes while it runs, as one trivially copyable object: goes into checkpoints.
  virtual std::span<std::byte> state() { return {}; }
};

}  // namespace breccia
