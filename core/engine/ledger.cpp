// SPDX-License-Identifier: BSD-3-Clause
// The ledger of energies: accounts are kept by chunk of pairs and block of particles, and added up exactly when
// somebody looks at it. So a step needs no sum over all of them, and no cut between parts shows.
#include "engine/cell_motion.hpp"
#include "engine/law_probe.hpp"
#include "engine/simulation.hpp"
#include "engine/walls.hpp"

namespace breccia {

void Simulation::fold_accounts() {
  const std::size_t laws = laws_.size();
  std::vector<ExactSum> sums(3 * laws + 3);
  for (std::size_t k = chunks_.first_counted() * laws; k < chunk_dissipated_.size(); ++k) {
    ExactSum* const of_law = &sums[3 * (k % laws)];
    of_law[0].add(chunk_dissipated_[k].friction);
    of_law[1].add(chunk_dissipated_[k].contact);
    of_law[2].add(chunk_dissipated_[k].fracture);
  }
  for (const BlockAccount& block : block_accounts_) {
    sums[3 * laws].add(block.damping);
    sums[3 * laws + 1].add(block.boundary_work);
  }
  sums.back() = led_work_;
  const std::vector<double> all = totals(sums, link());
  EnergySums& energy = state_.energy;
  for (std::size_t l = 0; l < laws; ++l) {
    Dissipated& of_law = state_.dissipated[l];
    of_law.friction += all[3 * l];
    of_law.contact += all[3 * l + 1];
    of_law.fracture += all[3 * l + 2];
    energy.friction += all[3 * l];
    energy.contact += all[3 * l + 1];
    energy.fracture += all[3 * l + 2];
  }
  energy.damping += all[3 * laws];
  energy.boundary_work += all[3 * laws + 1];
  energy.boundary_work += all.back();
  chunk_dissipated_.assign(chunk_dissipated_.size(), {});
  block_accounts_.assign(block_accounts_.size(), {});
  led_work_ = {};
  any_led_ = false;
}

void Simulation::fold_led() {
  state_.energy.boundary_work += totals({&led_work_, 1}, link())[0];
  led_work_ = {};
  any_led_ = false;
}

void Simulation::add_energy_of_pairs(ExactSum& to) {
  std::vector<double*> columns;
  const PairBatch all = whole_batch(state_, columns);
  std::vector<double> sums(chunks_.blocks());
#pragma omp parallel for schedule(static) num_threads(settings_.threads)
  for (std::size_t b = 0; b < sums.size(); ++b) {
    PairBatch mine = all;
    mine.begin = chunks_.start[chunks_.block_start[b]];
    mine.end = chunks_.start[chunks_.block_start[b + 1]];
    sums[b] = laws_.energy(mine);
  }
  for (const double sum : sums) to.add(sum);
}

double Simulation::energy_of_pairs() {
  std::vector<ExactSum> sum(1);
  add_energy_of_pairs(sum[0]);
  const double energy = totals(sum, link())[0];
  if (!std::isfinite(energy)) blame();
  return energy;
}

/// Whoever states an energy that is not a finite number. All ranks know that somebody does.
void Simulation::blame() { fail_together(blame_energy(state_, laws_)); }

EnergyLedger Simulation::ledger() {
  fold_accounts();
  const State& s = state_;
  std::vector<ExactSum> sums(4);
  add_energy_of_pairs(sums[0]);
  add_wall_energy(s, sums[1]);
  add_kinetic_energy(s, sums[2]);
  add_led_work_behind(s, sums[3]);
  const std::vector<double> all = totals(sums, link());
  if (!std::isfinite(all[0])) blame();
  EnergyLedger e;
  e.initial = s.energy.initial;
  e.boundary_work = s.energy.boundary_work - wall_work_ahead(s) + all[3] + cell_work_behind(s);
  e.elastic = all[0] + all[1];
  e.kinetic = all[2];
  e.friction = s.energy.friction;
  e.damping = s.energy.damping;
  e.contact = s.energy.contact;
  e.fracture = s.energy.fracture;
  return e;
}

void Simulation::begin_ledger() {
  fold_accounts();
  state_.energy = {};
  state_.dissipated.assign(laws_.size(), {});
  const EnergyLedger now = ledger();
  state_.energy.boundary_work = -now.boundary_work;
  state_.energy.initial = now.elastic + now.kinetic;
}

}  // namespace breccia
