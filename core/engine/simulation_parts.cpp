// SPDX-License-Identifier: BSD-3-Clause
// A specimen in parts: who owns what, and how it is brought together and seen by those who ask for all of it.
#include <algorithm>
#include <chrono>
#include <numeric>

#include "engine/cell_motion.hpp"
#include "engine/simulation.hpp"

namespace breccia {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void Simulation::gather(bool everywhere) {
  if (!link() || (whole_ && (whole_->everywhere || !everywhere))) return;
  const Stopwatch watch(seconds_gathering_);
  gatherings_ += !everywhere;
  auto whole = std::make_unique<Whole>();
  whole->everywhere = everywhere;
  whole->state = parts_->whole(state_, everywhere);
  whole_ = std::move(whole);
}

/// What one rank has found wrong ends all of them, with its text; nothing where none has. All call it together.
void Simulation::fail_together(const std::optional<std::string>& here) const {
  if (!link()) {
    if (here) throw UserError(*here);
    return;
  }
  const std::string text = here.value_or("");
  const std::vector<std::size_t> sizes = link()->numbers_of_all(text.size());
  const auto first = std::find_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size > 0; });
  if (first == sizes.end()) return;
  std::string all(std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)), ' ');
  link()->gather(text.data(), sizes, 1, all.data(), true);
  throw UserError(all.substr(0, *first));
}

/// What stands by particle goes with its particle. Accounts of chunks and blocks are in the ledger, and what walls and
/// the protocol apply is added up anew.
void Simulation::deal_again() {
  const Particles& p = state_.particles;
  const auto name_by_rows = [&](std::vector<WallTouch>& touches) {
    for (WallTouch& t : touches) t.particle = p.row_of(t.particle);
  };
  name_by_rows(spectral_.known_touches_);
  const std::size_t first = p.first_own(), own = p.end_own() - first;
  const Migration move = parts_->deal_again(state_, contacts_);
  if (auto& mode = spectral_.mode_; !mode.empty()) {
    const std::vector<Vec6> moved = move.rows(std::span<const Vec6>(mode).subspan(first, own));
    mode.assign(p.size() + 1, Vec6::Zero());
    std::copy(moved.begin(), moved.end(), mode.begin() + std::ptrdiff_t(p.first_own()));
  }
  auto& touches = spectral_.known_touches_;
  touches = move.by_row(touches, [](const WallTouch& t) { return t.particle; });
  std::stable_sort(touches.begin(), touches.end(),
                   [](const WallTouch& a, const WallTouch& b) { return a.wall < b.wall; });
  for (WallTouch& t : touches) t.particle = here(t.particle);
  led_ = move.by_row(led_, [](const Led& l) { return l.particle; });
}

/// Before the list of pairs is made anew: who owns what, where work is dealt unevenly, and whose copies stand here.
void Simulation::balance() {
  if (parts_->imbalance(state_) > parts_->link().tolerated_imbalance()) deal_again();
  if (state_.cell.repeats()) refuse_narrow_cell(state_, pair_length_);  // on all ranks or on none
  const Particles& p = state_.particles;
  const std::size_t before = p.first_own();
  parts_->renew_copies(state_, contacts_, skin_);
  if (auto& mode = spectral_.mode_; !mode.empty()) {
    std::vector<Vec6> moved(p.size() + 1, Vec6::Zero());
    std::copy_n(mode.begin() + std::ptrdiff_t(before), p.end_own() - p.first_own(),
                moved.begin() + std::ptrdiff_t(p.first_own()));
    mode.swap(moved);
  }
  for (WallTouch& t : spectral_.known_touches_) t.particle = Index(t.particle + p.first_own() - before);
  loads_.shift_to(p);
}

void Simulation::see_particles() const {
  if (seen_ && seen_are_now_) return;
  const Stopwatch watch(seconds_gathering_);
  const Particles& p = state_.particles;
  if (!seen_) {
    seen_.emplace();
    seen_->id = parts_->gathered_rows(p.id, p, true);
    seen_->material = parts_->gathered_rows(p.material, p, true);
    seen_->reference_position = parts_->gathered_rows(p.reference_position, p, true);
  }
  seen_->motion = parts_->gathered_rows(p.motion, p, true);
  seen_->load = parts_->gathered_rows(p.load, p, true);
  seen_->applied_force = parts_->gathered_rows(p.applied_force, p, true);
  seen_->held = parts_->gathered_rows(p.held, p, true);
  seen_are_now_ = true;
}

}  // namespace breccia
