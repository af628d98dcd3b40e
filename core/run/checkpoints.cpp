// SPDX-License-Identifier: BSD-3-Clause
#include "run/checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "archive/archive_size.hpp"
#include "breccia/atomic_file.hpp"
#include "config/places.hpp"
#include "plugin/out_of_memory.hpp"

namespace breccia {
namespace fs = std::filesystem;

Checkpoints::Checkpoints(const CheckpointsConfig& config, const fs::path& folder, const Curves& curves,
                         std::function<std::vector<std::string>(Archive&)> write, const RunRanks& ranks, Host& host)
    : config_(config),
      folder_(folder / "checkpoints"),
      curves_(curves),
      write_(std::move(write)),
      ranks_(ranks),
      host_(host) {
  if (!config.every_strain || !ranks.first()) return;
  if (const Column* const c = role::find(curves.columns(), {role::strain, role::machine_strain}))
    strain_curve_ = c->name;
  else
    throw AtPath(
        "checkpoints.every_strain",
        "checkpoints.every_strain: this workflow has no curve of a strain along the axis, as `axial_strain` or "
        "`platen_strain`");
}

void Checkpoints::start_from(const RunProgress& now) {
  from_ = now;
  from_strain_ = strain();
  last_ = Clock::now();
}

/// Of the last row; 0 where nobody asks.
double Checkpoints::strain() {
  if (strain_curve_ && curves_.rows() != rows_) {
    rows_ = curves_.rows();
    strain_ = curves_.column(*strain_curve_).back();
  }
  return strain_;
}

bool Checkpoints::is_time(const RunProgress& now) {
  if (config_.every_steps && now.step - from_.step >= std::uint64_t(*config_.every_steps)) return true;
  if (config_.every_strain && std::abs(strain() - from_strain_) >= *config_.every_strain) return true;
  if (config_.every_simulated && now.time - from_.time >= *config_.every_simulated) return true;
  return std::chrono::duration<double>(Clock::now() - last_).count() >= config_.every;
}

bool Checkpoints::due(const RunProgress& now, bool stop) {
  return config_.keep > 0 && !impossible_ && now.step > 0 && now.step != from_.step && (stop || is_time(now));
}

void Checkpoints::write(const RunProgress& now) {
  try {
    save(now);
    failing_ = false;
  } catch (const UserError& e) { missed(now, e.what()); } catch (const std::bad_alloc&) {
    if (ranks_.several()) throw;  // the others wait for this one
    missed(now, out_of_memory());
  }
  start_from(now);
}

/// The same disk is full at the next one, too: said once.
void Checkpoints::missed(const RunProgress& now, const std::string& why) {
  if (!failing_)
    host_.warn(fmt::format("no checkpoint at step {}: {}; the run goes on, and tries again when the next ones are due",
                           now.step, why));
  failing_ = true;
}

void Checkpoints::save(const RunProgress& now) {
  ArchiveSize size(ranks_.first());
  std::vector<std::string> unknown;
  ranks_.together([&] { unknown = write_(size); });
  if (any_rank(ranks_.link(), !unknown.empty())) {
    impossible_ = true;
    host_.warn(
        fmt::format("this run has no checkpoints and cannot go on once it is stopped: {} does not say what changes "
                    "in it while it runs (`archive` of the plugin)",
                    fmt::join(unknown, ", ")));
    return;
  }
  const fs::path file = folder_ / checkpoint_name(now.step);
  if (ranks_.several()) save_together(ranks_.told(file.string()), size.bytes());
  else save(file, size.bytes());
  if (!ranks_.first()) return;
  std::error_code error;
  const auto there = checkpoints_in(folder_);
  for (std::size_t k = std::size_t(config_.keep); k < there.size(); ++k) fs::remove(there[k], error);
  remove_what_never_arrived();
}

/// Of a process that was killed while it wrote one.
void Checkpoints::remove_what_never_arrived() const {
  std::vector<fs::path> left;
  std::error_code error;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".arriving") left.push_back(at->path());
  for (const fs::path& file : left) fs::remove(file, error);
}

void Checkpoints::save(const fs::path& file, std::size_t bytes) {
  const auto writer = begin_checkpoint(bytes);
  (void)write_(*writer);
  make_folder();
  writer->commit(file);
}

void Checkpoints::save_together(const fs::path& file, std::size_t bytes) {
  ranks_.together([&] {
    if (ranks_.first()) make_folder();
  });
  std::int64_t of_all = std::int64_t(bytes);
  ranks_.link()->add({&of_all, 1});
  const auto writer = begin_checkpoint(*ranks_.link(), file, std::size_t(of_all));
  ranks_.together([&] { (void)write_(*writer); });
  writer->commit(file);
}

void Checkpoints::make_folder() const {
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error) throw CannotWrite(folder_, error.value());
}

}  // namespace breccia
