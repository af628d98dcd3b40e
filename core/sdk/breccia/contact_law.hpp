// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `contact_law`: the force between two particles.
///
/// A law is a small, trivially copyable struct over scalars, written once (see `plugins/contact_law/elastic_brittle`):
///
///   struct MyLaw {
///     struct Config { ... };                                    // what the workflow says, checked and documented
///     static void describe(Schema<Config>&);
///     struct State { double spring_x, spring_y, spring_z; };    // history of one pair, doubles only
///     static constexpr std::array columns{StateColumn<State>{&State::spring_x, "shear_spring_x", "m"}, ...};
///     static constexpr bool has_moments = false;
///     MyLaw(const Config&, const Assembly&);                    // derive constants once
///     BRECCIA_KERNEL State initial(const Contact&) const;
///     BRECCIA_KERNEL ContactForce operator()(const Contact&, State&) const;   // no branches: use ?: so that it vectorises
///     BRECCIA_KERNEL double energy(const Contact&, const State&) const;       // stored, recoverable [J]
///     BRECCIA_KERNEL ContactStiffness stiffness(const Contact&) const;        // for the time step
///   };
///   BRECCIA_CONTACT_LAW(MyLaw, "my_law")
///
/// The loop over pairs is a template instantiated inside the plugin: one virtual call per batch, none per pair.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "breccia/plugin.hpp"
#include "breccia/views.hpp"

/// Kernel functions must end up inside the vector loop.
#define BRECCIA_KERNEL inline __attribute__((always_inline))

// One binary, the widest vectors the machine has. Bits agree between them (-ffp-contract=off). Sanitizers cannot
// cope with the resolver functions that this makes.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__x86_64__)
#define BRECCIA_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BRECCIA_VECTOR_CLONES
#endif

namespace breccia {

/// The geometry and motion of one pair, as its law sees it. n points from i to j.
struct Contact {
  double distance;          ///< of the centres [m]
  double rest_length;       ///< bonded: distance when the bond was made; others: min(first distance, r_i + r_j) [m]
  double radius_i, radius_j;  // [m]
  double nx, ny, nz;        ///< unit normal
  double normal_velocity;   ///< rate of the distance [m/s]
  double shear_x, shear_y, shear_z;  ///< tangential motion of j relative to i at the contact point in this step [m]
  double spin;              ///< mean rotation of the two about n in this step [rad]
  double turn_x, turn_y, turn_z;     ///< rotation of j relative to i in this step [rad]
  double intact;            ///< 1 while the bond holds, else 0
  double reduced_mass;      ///< m_i m_j/(m_i + m_j) [kg]
  double time_step;         // [s]
};

/// What a law answers. Tension is positive; shear and moment act on i, their opposites on j.
struct ContactForce {
  double normal = 0;                              // [N]
  double shear_x = 0, shear_y = 0, shear_z = 0;   // [N]
  double moment_x = 0, moment_y = 0, moment_z = 0;  ///< only when `has_moments` [N m]
  double breaks = 0;                              ///< 0, or the BondState it breaks into, as a number
  double friction_work = 0;                       ///< dissipated by sliding in this step [J]
  double contact_work = 0;                        ///< dissipated otherwise (viscous, plastic, damage) [J]
  double fracture_energy = 0;                     ///< stored energy lost because it broke in this step [J]
};

/// Linearised stiffness for the time step: translations [N/m], rotations [N m/rad]; and the constant of a dashpot along
/// the normal [N s/m].
struct ContactStiffness {
  double normal = 0, shear = 0, bending = 0, torsion = 0;
  double damping = 0;
};

template <class State> struct StateColumn {
  double State::* member;
  const char* name;
  const char* unit;
};

/// What a law may know of the whole specimen when it derives its constants.
struct Assembly {
  int dimension = 3;
  double thickness = 1;                  // [m]
  std::span<const double> radius, mass;  // [m], [kg]
  std::span<const Index> bond_i, bond_j;
  double porosity = 0, coordination_number = 0;
};

/// Pairs [begin, end) of the engine's arrays. `begin` is a multiple of `chunk`.
struct PairBatch {
  static constexpr std::size_t chunk = 64;   ///< pairs gathered at a time, and the grain of deterministic sums
  std::size_t begin = 0, end = 0;
  const Index *i = nullptr, *j = nullptr;
  const double* rest_length = nullptr;
  BondState* state = nullptr;
  double* const* columns = nullptr;          ///< the law's history, one array each
  const Vec3 *position = nullptr, *velocity = nullptr, *angular_velocity = nullptr;
  const double *radius = nullptr, *mass = nullptr;
  PairForce* force = nullptr;
  Vec3* moment = nullptr;
  double *friction_work = nullptr, *contact_work = nullptr, *fracture_energy = nullptr;  ///< one per chunk, added to
  std::uint8_t* chunk_broke = nullptr;       ///< one per chunk, set when a bond in it broke
  double time_step = 0;
};

class BRECCIA_API ContactLaw : public Plugin {
 public:
  static constexpr const char* kind = "contact_law";
  struct ColumnDoc { std::string name, unit; };
  virtual std::vector<ColumnDoc> columns() const = 0;
  virtual bool has_moments() const = 0;
  virtual void prepare(const Assembly& assembly) = 0;         ///< once, before anything else
  virtual void initialise(const PairBatch& batch) = 0;        ///< history of new pairs
  virtual void evaluate(const PairBatch& batch) = 0;
  virtual void stiffness(const PairBatch& batch, ContactStiffness* out) = 0;  ///< out[k - begin]
  virtual double energy(const PairBatch& batch) = 0;          ///< stored in the batch, summed in order [J]
  virtual Json derived() const { return Json::object(); }     ///< constants it derived, for the summary
};

namespace detail {

// The member pointer must be a constant for the compiler's front end: read at run time from the table it would take the
// State's address, keep it in memory and stop the loop from vectorising. An aggregate initialiser would do the same.
template <class Law, std::size_t K> BRECCIA_KERNEL double& column_of(typename Law::State& s) {
  constexpr auto member = Law::columns[K].member;
  return s.*member;
}
template <class Law, std::size_t... K>
BRECCIA_KERNEL void load_state(typename Law::State& s, double* const* h, std::size_t k, std::index_sequence<K...>) {
  ((column_of<Law, K>(s) = h[K][k]), ...);
}
template <class Law, std::size_t... K>
BRECCIA_KERNEL void store_state(typename Law::State& s, double* const* h, std::size_t k, std::index_sequence<K...>) {
  ((h[K][k] = column_of<Law, K>(s)), ...);
}

/// One chunk of gathered pairs: structure of arrays, so that the law vectorises over it.
struct alignas(64) Gathered {
  static constexpr std::size_t n = PairBatch::chunk;
  double dx[n], dy[n], dz[n], vx[n], vy[n], vz[n];
  double wix[n], wiy[n], wiz[n], wjx[n], wjy[n], wjz[n];
  double ri[n], rj[n], mass[n], intact[n];
};

BRECCIA_KERNEL void gather(const PairBatch& b, std::size_t first, std::size_t n, bool with_mass, Gathered& g) {
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = b.i[first + k], j = b.j[first + k];
    const double *xi = b.position[i].data(), *xj = b.position[j].data();
    const double *vi = b.velocity[i].data(), *vj = b.velocity[j].data();
    const double *wi = b.angular_velocity[i].data(), *wj = b.angular_velocity[j].data();
    g.dx[k] = xj[0] - xi[0]; g.dy[k] = xj[1] - xi[1]; g.dz[k] = xj[2] - xi[2];
    g.vx[k] = vj[0] - vi[0]; g.vy[k] = vj[1] - vi[1]; g.vz[k] = vj[2] - vi[2];
    g.wix[k] = wi[0]; g.wiy[k] = wi[1]; g.wiz[k] = wi[2];
    g.wjx[k] = wj[0]; g.wjy[k] = wj[1]; g.wjz[k] = wj[2];
    g.ri[k] = b.radius[i]; g.rj[k] = b.radius[j];
    g.mass[k] = with_mass ? b.mass[i] * b.mass[j] / (b.mass[i] + b.mass[j]) : 0.0;
    g.intact[k] = b.state[first + k] == BondState::intact ? 1.0 : 0.0;
  }
}

/// Coincident centres have no normal: the floor on the distance keeps the result finite (and the force zero).
BRECCIA_KERNEL Contact contact_of(const Gathered& g, std::size_t k, double rest_length, double dt) {
  const double d = std::sqrt(g.dx[k] * g.dx[k] + g.dy[k] * g.dy[k] + g.dz[k] * g.dz[k]);
  const double inverse = 1.0 / (d > 1e-300 ? d : 1e-300);
  Contact c;
  c.distance = d;
  c.rest_length = rest_length;
  c.radius_i = g.ri[k];
  c.radius_j = g.rj[k];
  c.nx = g.dx[k] * inverse; c.ny = g.dy[k] * inverse; c.nz = g.dz[k] * inverse;
  c.normal_velocity = g.vx[k] * c.nx + g.vy[k] * c.ny + g.vz[k] * c.nz;
  // Velocity of j relative to i at the contact point: v_j - v_i - (a_i w_i + a_j w_j) x n, with lever arms a.
  const double half_gap = 0.5 * (d - g.ri[k] - g.rj[k]);
  const double ai = g.ri[k] + half_gap, aj = g.rj[k] + half_gap;
  const double px = ai * g.wix[k] + aj * g.wjx[k], py = ai * g.wiy[k] + aj * g.wjy[k], pz = ai * g.wiz[k] + aj * g.wjz[k];
  c.shear_x = dt * (g.vx[k] - c.normal_velocity * c.nx - (py * c.nz - pz * c.ny));
  c.shear_y = dt * (g.vy[k] - c.normal_velocity * c.ny - (pz * c.nx - px * c.nz));
  c.shear_z = dt * (g.vz[k] - c.normal_velocity * c.nz - (px * c.ny - py * c.nx));
  c.spin = 0.5 * dt * ((g.wix[k] + g.wjx[k]) * c.nx + (g.wiy[k] + g.wjy[k]) * c.ny + (g.wiz[k] + g.wjz[k]) * c.nz);
  c.turn_x = dt * (g.wjx[k] - g.wix[k]); c.turn_y = dt * (g.wjy[k] - g.wiy[k]); c.turn_z = dt * (g.wjz[k] - g.wiz[k]);
  c.intact = g.intact[k];
  c.reduced_mass = g.mass[k];
  c.time_step = dt;
  return c;
}

template <class Law> constexpr bool law_has_moments() {
  if constexpr (requires { Law::has_moments; }) return Law::has_moments;
  else return false;
}
template <class Law> constexpr bool law_needs_mass() {
  if constexpr (requires { Law::needs_mass; }) return Law::needs_mass;
  else return false;
}

/// What one chunk yields, before it is scattered.
struct alignas(64) Evaluated {
  static constexpr std::size_t n = PairBatch::chunk;
  double fx[n], fy[n], fz[n], tx[n], ty[n], tz[n], mx[n], my[n], mz[n], half_gap[n], breaks[n];
  double friction[n], contact[n], fracture[n];
};

/// One lane of the vector loop. A function of its own: aggregates declared in an `omp simd` body stay in memory, those
/// of an inlined function become registers (a factor of three).
template <class Law> BRECCIA_KERNEL void evaluate_lane(const Law& law, const Gathered& g, double* const* h, double rest, double dt,
                                                       std::size_t k, Evaluated& out) {
  constexpr auto all = std::make_index_sequence<Law::columns.size()>{};
  const Contact c = contact_of(g, k, rest, dt);
  typename Law::State s;
  load_state<Law>(s, h, k, all);
  const ContactForce f = law(c, s);
  store_state<Law>(s, h, k, all);
  out.fx[k] = f.normal * c.nx + f.shear_x;
  out.fy[k] = f.normal * c.ny + f.shear_y;
  out.fz[k] = f.normal * c.nz + f.shear_z;
  out.tx[k] = c.ny * f.shear_z - c.nz * f.shear_y;
  out.ty[k] = c.nz * f.shear_x - c.nx * f.shear_z;
  out.tz[k] = c.nx * f.shear_y - c.ny * f.shear_x;
  if constexpr (law_has_moments<Law>()) { out.mx[k] = f.moment_x; out.my[k] = f.moment_y; out.mz[k] = f.moment_z; }
  out.half_gap[k] = 0.5 * (c.distance - c.radius_i - c.radius_j);
  out.breaks[k] = f.breaks;
  out.friction[k] = f.friction_work;
  out.contact[k] = f.contact_work;
  out.fracture[k] = f.fracture_energy;
}

/// Sum in eight lanes, always the same ones: quick, and the same bits whatever the vector width.
BRECCIA_KERNEL double lane_sum(const double* v, std::size_t n) {
  double lane[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += v[k + l];
  for (; k < n; ++k) lane[k % 8] += v[k];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/// Pairs [first, first + n) of the batch.
template <class Law> BRECCIA_KERNEL void evaluate_chunk(const Law& law, const PairBatch& b, std::size_t first, std::size_t n, Gathered& g, Evaluated& e) {
  gather(b, first, n, law_needs_mass<Law>(), g);
  double* h[Law::columns.size() + 1];
  for (std::size_t c = 0; c < Law::columns.size(); ++c) h[c] = b.columns[c] + first;
  const double* rest = b.rest_length + first;
  const double dt = b.time_step;
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) evaluate_lane(law, g, h, rest[k], dt, k, e);
  for (std::size_t k = 0; k < n; ++k)
    b.force[first + k] = {e.fx[k], e.fy[k], e.fz[k], e.tx[k], e.ty[k], e.tz[k], e.half_gap[k], 0.0};
  if constexpr (law_has_moments<Law>())
    for (std::size_t k = 0; k < n; ++k) b.moment[first + k] = Vec3(e.mx[k], e.my[k], e.mz[k]);
  const std::size_t at = first / PairBatch::chunk;
  b.friction_work[at] += lane_sum(e.friction, n);
  b.contact_work[at] += lane_sum(e.contact, n);
  b.fracture_energy[at] += lane_sum(e.fracture, n);
  if (lane_sum(e.breaks, n) > 0) {
    b.chunk_broke[at] = 1;
    for (std::size_t k = 0; k < n; ++k)
      if (e.breaks[k] > 0) b.state[first + k] = static_cast<BondState>(static_cast<int>(e.breaks[k]));
  }
}

/// The step loop. `law` comes by value: its constants stay in registers.
template <class Law> BRECCIA_VECTOR_CLONES void evaluate_pairs(const Law law, const PairBatch& b) {
  Gathered g;
  Evaluated e;
  for (std::size_t first = b.begin; first < b.end; first += PairBatch::chunk)
    evaluate_chunk(law, b, first, std::min(PairBatch::chunk, b.end - first), g, e);
}

/// Calls `f(contact, k)` for each pair of the batch: for what is done rarely.
template <class Law, class F> void for_each_contact(const PairBatch& b, F&& f) {
  Gathered g;
  for (std::size_t k = b.begin; k < b.end; ++k) {
    gather(b, k, 1, true, g);
    f(contact_of(g, 0, b.rest_length[k], b.time_step), k);
  }
}

}  // namespace detail

/// Makes a plugin of a law struct.
template <class Law> class ContactLawOf final : public ContactLaw {
  static_assert(std::is_trivially_copyable_v<Law>, "a law is copied into the step loop: keep containers in its Config");
  static constexpr auto all = std::make_index_sequence<Law::columns.size()>{};

 public:
  using Config = typename Law::Config;
  static void describe(Schema<Config>& s) { Law::describe(s); }
  explicit ContactLawOf(const Config& config) : config_(config) {}

  std::vector<ColumnDoc> columns() const override {
    std::vector<ColumnDoc> docs;
    for (const auto& c : Law::columns) docs.push_back({c.name, c.unit});
    return docs;
  }
  bool has_moments() const override { return detail::law_has_moments<Law>(); }
  void prepare(const Assembly& assembly) override { law_.emplace(config_, assembly); }
  void initialise(const PairBatch& b) override {
    detail::for_each_contact<Law>(b, [&](const Contact& c, std::size_t k) {
      typename Law::State s = law_->initial(c);
      detail::store_state<Law>(s, b.columns, k, all);
    });
  }
  void evaluate(const PairBatch& b) override { detail::evaluate_pairs<Law>(*law_, b); }
  void stiffness(const PairBatch& b, ContactStiffness* out) override {
    detail::for_each_contact<Law>(b, [&](const Contact& c, std::size_t k) { out[k - b.begin] = law_->stiffness(c); });
  }
  double energy(const PairBatch& b) override {
    double sum = 0;
    detail::for_each_contact<Law>(b, [&](const Contact& c, std::size_t k) {
      typename Law::State s;
      detail::load_state<Law>(s, b.columns, k, all);
      sum += law_->energy(c, s);
    });
    return sum;
  }
  Json derived() const override {
    if constexpr (requires { law_->derived(); }) return law_->derived();
    else return Json::object();
  }

 private:
  Config config_;
  std::optional<Law> law_;
};

/// A vector kept in the contact plane (a tangential spring, a bending spring) follows the pair: it is turned into the
/// present plane and with the pair's mean spin about n. First order in the step, exact in the limit.
struct PlaneVector {
  double x, y, z;
};
BRECCIA_KERNEL PlaneVector follow_plane(const Contact& c, double x, double y, double z) {
  const double along = x * c.nx + y * c.ny + z * c.nz;
  x -= along * c.nx; y -= along * c.ny; z -= along * c.nz;
  return {x + c.spin * (c.ny * z - c.nz * y), y + c.spin * (c.nz * x - c.nx * z), z + c.spin * (c.nx * y - c.ny * x)};
}

}  // namespace breccia

#define BRECCIA_CONTACT_LAW(Law, name) BRECCIA_PLUGIN(::breccia::ContactLawOf<Law>, "contact_law", name)
