// SPDX-License-Identifier: BSD-3-Clause
// A specimen in parts: how it is cut, brought together and seen by those who ask for all of it.
#include <algorithm>
#include <chrono>

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

template <class T>
std::vector<T> slice(const std::vector<T>& of, std::size_t begin, std::size_t end) {
  return {of.begin() + std::ptrdiff_t(begin), of.begin() + std::ptrdiff_t(end)};
}

}  // namespace

/// Of the whole specimen, which is the same on all ranks, to this rank's part.
void Simulation::cut() {
  const Chunks chunks = chunks_;
  const auto dissipated = chunk_dissipated_;
  const auto accounts = block_accounts_;
  const bool dealt = rebuilds_ > 0;
  parts_->cut(state_, contacts_);
  const Particles& p = state_.particles;
  if (!spectral_.mode_.empty()) {
    std::vector<Vec6> mode;
    for (const Index row : p.row) mode.push_back(spectral_.mode_[row]);
    mode.push_back(Vec6::Zero());
    spectral_.mode_.swap(mode);
  }
  std::erase_if(spectral_.known_touches_, [&](const WallTouch& t) {
    return t.particle < parts_->first_row() || t.particle >= parts_->end_row();
  });
  for (WallTouch& t : spectral_.known_touches_) t.particle -= Index(p.shift());
  std::erase_if(led_,
                [&](const Led& l) { return l.particle < parts_->first_row() || l.particle >= parts_->end_row(); });
  if (!parts_->link().first()) led_work_ = {};  // until now each had all of it
  loads_.shift_to(p);
  seen_.reset();
  whole_.reset();
  if (!dealt) return;
  deal_pairs();
  const std::size_t first = parts_->first_row() / particle_block, laws = laws_.size();
  const std::size_t begin = chunks.block_start[first], end = chunks.block_start[first + chunks_.blocks()];
  const auto own = slice(dissipated, begin * laws, end * laws);
  std::copy(own.begin(), own.end(), chunk_dissipated_.begin() + std::ptrdiff_t(chunks_.first_counted() * laws));
  block_accounts_ = slice(accounts, first, first + chunks_.blocks());
}

void Simulation::gather() {
  if (link()) gather(true, false);
}

void Simulation::gather(bool for_archive, bool everywhere) {
  if (whole_ && (whole_->for_archive || !for_archive)) return;
  const Stopwatch watch(seconds_gathering_);
  gatherings_ += !everywhere;
  auto whole = std::make_unique<Whole>();
  whole->for_archive = for_archive;
  const Particles& p = state_.particles;
  if (for_archive) {
    const std::size_t laws = laws_.size();
    whole->chunk_dissipated = parts_->gathered(
        std::span<const Dissipated>(chunk_dissipated_).subspan(chunks_.first_counted() * laws), everywhere);
    whole->block_accounts = parts_->gathered(std::span<const BlockAccount>(block_accounts_), everywhere);
    whole->spectral = spectral_;
    whole->spectral.mode_ = parts_->gathered_rows(spectral_.mode_, p, everywhere);
    if (!whole->spectral.mode_.empty()) whole->spectral.mode_.push_back(Vec6::Zero());
    std::vector<WallTouch> touches = spectral_.known_touches_;
    for (WallTouch& t : touches) t.particle += Index(p.shift());
    touches = parts_->gathered(std::span<const WallTouch>(touches), everywhere);
    std::stable_sort(touches.begin(), touches.end(),
                     [](const WallTouch& a, const WallTouch& b) { return a.wall < b.wall; });
    whole->spectral.known_touches_.swap(touches);
    std::vector<std::pair<Index, ExternalLoads::Load>> loads;
    loads_.for_each(p, [&](Index row, const ExternalLoads::Load& load) { loads.emplace_back(row, load); });
    whole->loads.clear(parts_->rows());
    for (const auto& [row, load] :
         parts_->gathered(std::span<const std::pair<Index, ExternalLoads::Load>>(loads), everywhere))
      whole->loads.put(row, load);
    if (everywhere) whole->contacts = parts_->whole(contacts_, p, true);
  }
  whole->state = parts_->whole(state_, everywhere);
  whole_ = std::move(whole);
}

/// All of it on all ranks, as before `cut()`.
void Simulation::join() {
  whole_.reset();
  gather(true, true);
  const std::unique_ptr<Whole> whole = std::move(whole_);
  const double led = totals({&led_work_, 1}, link())[0];
  parts_->join();
  std::swap(state_, whole->state);
  contacts_ = std::move(whole->contacts);
  spectral_ = std::move(whole->spectral);
  loads_ = std::move(whole->loads);
  led_work_ = {};
  led_work_.add(led);
  deal_pairs();
  chunk_dissipated_ = std::move(whole->chunk_dissipated);
  block_accounts_ = std::move(whole->block_accounts);
  seen_.reset();
}

/// Before the list of pairs is made anew: who owns what, where work is dealt unevenly, and whose copies stand here.
void Simulation::balance() {
  if (parts_->imbalance(state_) > parts_->link().tolerated_imbalance()) {
    join();
    cut();
  }
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
