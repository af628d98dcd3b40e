// SPDX-License-Identifier: BSD-3-Clause
#include "drive/drive.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "breccia/contact_law.hpp"
#include "breccia/renderer.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "plugin/drawing.hpp"
#include "results/curve_table.hpp"
#include "results/summary_table.hpp"
#include "run/energy_check.hpp"
#include "run/warning_log.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {
namespace {

/// What the pair exerts; as forces on the first particle, so that tension and a positive shear are positive.
struct Loads {
  double normal = 0, shear = 0, bending = 0, torsion = 0;  // [N], [N m]
};

class Drive {
 public:
  Drive(const DriveSettings& s, const DrivePath& path, const Registry& registry, const std::filesystem::path& folder,
        Host& host)
      : s_(s),
        path_(path),
        registry_(registry),
        folder_(folder),
        host_(host),
        laws_(registry, with_means(s.law)),
        start_(s.radius_i + s.radius_j + s.gap) {}

  std::vector<std::filesystem::path> operator()() {
    check();
    laws_.within([&] { build(); });
    add_columns();
    curves_.open(folder_ / "curves.csv");
    try {
      laws_.within([&] { follow(); });
    } catch (const PluginFault&) {  // the rows before it show where the law failed
      curves_.close();
      throw;
    }
    curves_.close();
    const auto off = energy_error();
    write_summary();  // whole before the charts
    std::vector<std::filesystem::path> files = {folder_ / "curves.csv", curve_units_file(folder_ / "curves.csv"),
                                                folder_ / "summary.json"};
    const auto charts = draw();
    write_summary();
    files.insert(files.end(), charts.begin(), charts.end());
    if (off) throw UserError(*off);
    return files;
  }

 private:
  void check() const {
    if (!(start_ > 0))
      throw UserError("--gap: the overlap leaves no distance between the centres of the two particles");
    for (const WayPoint& p : path_.points) {
      if (!(start_ + p.normal > 0))
        throw UserError(fmt::format(
            "normal_m: the way point {} m would bring the centres, {} m apart at the start, onto each other", p.normal,
            start_));
      if (s_.dimension == 2 && p.twist != 0)
        throw UserError("twist_rad: discs in a plane cannot twist; leave the column out, or set dimension=3");
    }
  }

  void build() {
    const double critical = make_simulation(1)->critical_step();
    double shortest = critical * 1e9 * s_.steps;  // so slow that nothing depends on rates
    if (path_.timed) {
      shortest = path_.points.back().time;
      for (std::size_t k = 1; k < path_.points.size(); ++k)
        shortest = std::min(shortest, path_.points[k].time - path_.points[k - 1].time);
      if (const double increments = path_.points.back().time / shortest * s_.steps; increments > 1e7)
        throw UserError(fmt::format(
            "time_s: increments that all take as long as those of the shortest way would be {:.3g}; make the times "
            "less different, or lower --steps",
            increments));
    }
    simulation_ = make_simulation(shortest / s_.steps / critical);
  }

  /// Two particles on the x axis. Nothing moves freely, so that the time step may be any multiple of the critical one.
  std::unique_ptr<Simulation> make_simulation(double steps_per_critical) {
    PackedParticles two;
    two.position = {Vec3::Zero(), Vec3(start_, 0, 0)};
    two.radius = {s_.radius_i, s_.radius_j};
    two.outline = SpecimenShape::Outline::box;
    double farthest = std::abs(s_.gap);
    for (const WayPoint& p : path_.points) farthest = std::max(farthest, std::abs(s_.gap) + std::abs(p.normal));
    EngineSettings settings;
    settings.safety = steps_per_critical;
    settings.skin = 1 + 8 * farthest / (s_.radius_i + s_.radius_j);  // they stay neighbours wherever the path leads
    auto simulation = std::make_unique<Simulation>(assemble(two, {s_.density}, s_.dimension, s_.thickness),
                                                   laws_.interactions(), settings);
    const double rounding = 1e-9 * (s_.radius_i + s_.radius_j);
    simulation->bond({GapMeasure::absolute, s_.bonded ? s_.gap + rounding : s_.gap - rounding, std::nullopt},
                     SpecimenToTell{s_.porosity, s_.coordination_number});
    simulation->prepare();
    for (const Index k : {0, 1}) simulation->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
    return simulation;
  }

  /// Warns when the pair's energy does not close at the end of the path; what to end with when it is far off.
  std::optional<std::string> energy_error() {
    const auto largest = [&](const char* name) {
      double most = 0;
      for (const double v : curves_.column(name)) most = std::max(most, std::abs(v));
      return most;
    };
    const double reference = std::max(largest("work"), largest("stored_energy"));
    const double error = std::max(0.0, std::abs(curves_.column("energy_error").back()) - unsure_);
    const double off = reference > 0 ? error / reference : 0;
    const EnergyLimits limits;
    if (off <= limits.warn) return std::nullopt;
    const std::string text = fmt::format(
        "energy does not close: {:.3g} % of the work done on the pair is unaccounted for: the energy function or the "
        "reported dissipation of contact law `{}` does not match its force, or the increments are too long (--steps)",
        100 * off, s_.law.names("` and `"));
    if (off > limits.end) return text;
    host_.warn(text);
    return std::nullopt;
  }

  void add_columns() {
    const Column own[] = {{"step", "1", ""},
                          {"time", "s", ""},
                          {"normal_displacement", "m", ""},
                          {"shear_displacement", "m", ""},
                          {"rotation", "rad", ""},
                          {"twist", "rad", ""},
                          {"normal_force", "N", ""},
                          {"shear_force", "N", ""},
                          {"bending_moment", "N m", ""},
                          {"torque", "N m", ""},
                          {"bond_state", "1", ""},
                          {"work", "J", ""},
                          {"stored_energy", "J", ""},
                          {"friction_work", "J", ""},
                          {"contact_work", "J", ""},
                          {"fracture_energy", "J", ""},
                          {"energy_error", "J", ""}};
    for (const Column& c : own) curves_.add(c);
    history_ = curves_.columns().size();
    for (std::size_t l = 0; l < laws_.size(); ++l)
      for (const ContactLaw::ColumnDoc& c : laws_.law(l).columns()) {
        const std::string name = laws_.column_name(l, c.name);
        const bool taken = std::any_of(std::begin(own), std::end(own), [&](const Column& o) { return o.name == name; });
        curves_.add({(taken ? "history_" : "") + name, c.unit, ""});
      }
  }

  void follow() {
    Simulation& sim = *simulation_;
    laws_.within([&] { sim.forces(); });
    sim.mark_start_of_loading();
    last_ = loads();
    record();
    for (std::size_t k = 1; k < path_.points.size(); ++k) {
      const WayPoint &from = path_.points[k - 1], &to = path_.points[k];
      const long n = path_.timed ? std::max(1L, std::lround((to.time - from.time) / sim.time_step())) : long(s_.steps);
      for (long at = 1; at <= n; ++at) {
        if (host_.cancelled()) throw Cancelled();
        increment(from, to, at, n);
      }
      host_.progress("drive", double(k) / double(path_.points.size() - 1));
    }
  }

  /// The velocities are those that lead exactly to the end of the increment; the law sees them with the geometry of its
  /// middle.
  void increment(const WayPoint& from, const WayPoint& to, long at, long n) {
    Simulation& sim = *simulation_;
    const double share = double(at) / double(n), dt = sim.time_step();
    const auto target = [&](double WayPoint::*m) { return at == n ? to.*m : from.*m + share * (to.*m - from.*m); };
    const WayPoint next{target(&WayPoint::normal), target(&WayPoint::shear), target(&WayPoint::rotation),
                        target(&WayPoint::twist), 0};
    const double distance = start_ + next.normal, middle = start_ + 0.5 * (now_.normal + next.normal),
                 half_gap = 0.5 * (middle - s_.radius_i - s_.radius_j);
    const double shear = next.shear - now_.shear, bend = next.rotation - now_.rotation, twist = next.twist - now_.twist;
    // Shear by turning both particles the same way, so that the line of centres stays; bending without shear.
    const double roll_i = (-shear - (s_.radius_j + half_gap) * bend) / middle,
                 roll_j = (-shear + (s_.radius_i + half_gap) * bend) / middle;
    const double way = distance - sim.state().particles.position()[1].x();
    sim.hold(0, dof::all, Vec3::Zero(), Vec3(-0.5 * twist, 0, roll_i) / dt);
    sim.hold(1, dof::all, Vec3(way, 0, 0) / dt, Vec3(0.5 * twist, 0, roll_j) / dt);
    const BondState before = sim.state().pairs.state[0];
    laws_.within([&] {
      sim.advance();
      sim.forces();
    });
    const Loads load = loads();
    if (sim.state().pairs.state[0] != before)  // where in the increment the force fell nobody knows
      unsure_ += 0.5 * (std::abs((load.normal - last_.normal) * (next.normal - now_.normal)) +
                        std::abs((load.shear - last_.shear) * shear) + std::abs((load.bending - last_.bending) * bend) +
                        std::abs((load.torsion - last_.torsion) * twist));
    work_ += 0.5 * ((last_.normal + load.normal) * (next.normal - now_.normal) + (last_.shear + load.shear) * shear +
                    (last_.bending + load.bending) * bend + (last_.torsion + load.torsion) * twist);
    now_ = next;
    last_ = load;
    record();
  }

  Loads loads() const {
    const Pairs& q = simulation_->state().pairs;
    BRECCIA_ASSERT(q.size() == 1);
    Loads l{q.force[0].fx, q.force[0].fy};
    if (!q.moment.empty()) {
      l.bending = q.moment[0].z();
      l.torsion = q.moment[0].x();
    }
    return l;
  }

  void record() {
    const SimulationView v = simulation_->view();
    const EnergyLedger& e = v.energy;
    const double error = work_ + e.initial - e.elastic - e.friction - e.contact - e.fracture;
    const double row[] = {double(v.step),
                          v.time,
                          now_.normal,
                          now_.shear,
                          now_.rotation,
                          now_.twist,
                          last_.normal,
                          last_.shear,
                          last_.bending,
                          last_.torsion,
                          double(v.pairs.state[0]),
                          work_,
                          e.elastic,
                          e.friction,
                          e.contact,
                          e.fracture,
                          error};
    BRECCIA_ASSERT(std::size(row) == history_);
    for (std::size_t c = 0; c < history_; ++c) curves_.set(c, row[c]);
    for (std::size_t c = 0; c < v.pairs.columns.size(); ++c) curves_.set(history_ + c, v.pairs.columns[c][0]);
    curves_.end_row();
  }

  void write_summary() {
    const auto extreme = [&](const char* name) {
      const auto c = curves_.column(name);
      return std::minmax_element(c.begin(), c.end());
    };
    SummaryTable t;
    t.set("law", s_.law.names());
    t.set("rows", curves_.rows());
    for (const char* force : {"normal_force", "shear_force"}) {
      const auto [least, most] = extreme(force);
      t.set({std::string("least_") + force, "N"}, *least);
      t.set({std::string("largest_") + force, "N"}, *most);
    }
    for (const char* name :
         {"work", "stored_energy", "friction_work", "contact_work", "fracture_energy", "energy_error"})
      t.set({name, "J"}, curves_.column(name).back());
    t.set("bond_state", int(curves_.column("bond_state").back()));
    t.set("pair", Json{{"radius_i_m", s_.radius_i},
                       {"radius_j_m", s_.radius_j},
                       {"gap_m", s_.gap},
                       {"bonded", s_.bonded},
                       {"density_kg_m3", s_.density},
                       {"dimension", s_.dimension},
                       {"thickness_m", s_.thickness},
                       {"porosity", s_.porosity},
                       {"coordination_number", s_.coordination_number}});
    Json given = Json::object();
    for (std::size_t l = 0; l < laws_.size(); ++l) {
      given[laws_.name(l)] = s_.law.plugins[l].config;
      for (auto& [name, value] : laws_.law(l).derived())
        SummaryTable::Section(t, "derived").own(name, std::move(value));
    }
    t.set("contact_law", given);
    t.update("warnings", host_.warnings());
    t.write(folder_);
  }

  std::vector<std::filesystem::path> draw() {
    if (!s_.renderer) return {};
    return drawn("charts", s_.renderer->type, Refusal::warns, host_, [&] {
      const auto renderer = registry_.create<Renderer>(*s_.renderer);
      return calling({Renderer::kind, s_.renderer->type}, "drawing", [&] {
        return renderer->compare({{{folder_, s_.law.names()}}, folder_}, host_);
      });
    });
  }

  const DriveSettings& s_;
  const DrivePath& path_;
  const Registry& registry_;
  const std::filesystem::path& folder_;
  WarningLog<Host> host_;
  ContactLaws laws_;
  double start_;  ///< distance of the centres [m]
  std::unique_ptr<Simulation> simulation_;
  CurveTable curves_;
  std::size_t history_ = 0;  ///< first column of the law's history
  WayPoint now_;
  Loads last_;
  double work_ = 0;    ///< done on the pair since the start [J]
  double unsure_ = 0;  ///< share of it that increments in which the bond broke leave open [J]
};

}  // namespace

std::vector<std::filesystem::path> drive(const DriveSettings& settings, const DrivePath& path, const Registry& registry,
                                         const std::filesystem::path& folder, Host& host) {
  return Drive(settings, path, registry, folder, host)();
}

}  // namespace breccia
