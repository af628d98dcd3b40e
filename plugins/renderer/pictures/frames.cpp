// SPDX-License-Identifier: BSD-3-Clause
#include "frames.hpp"

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace fs = std::filesystem;

vtkSmartPointer<vtkPolyData> Frames::read(const std::vector<fs::path>& files, std::size_t at, Kept& kept) {
  if (kept.file != files[at]) kept = {files[at], read_frame(files[at])};
  return kept.frame;
}

/// What is not the matter of a picture may be missing or damaged.
vtkSmartPointer<vtkPolyData> Frames::try_to_read(const std::vector<fs::path>& files, std::size_t at, Kept& kept) {
  if (at >= files.size()) return nullptr;
  try {
    return read(files, at, kept);
  } catch (const UserError&) { return nullptr; }
}

SceneFrame Frames::at(std::optional<long> index, bool cracks, bool with_bonds) {
  const auto& files = cracks ? results_.bond_frames : results_.particle_frames;
  if (files.empty()) throw UserError(std::string("there are no frames of ") + (cracks ? "bonds" : "particles"));
  if (index && std::size_t(*index) >= files.size())
    throw UserError("there is no frame " + std::to_string(*index) + ": the last is " +
                    std::to_string(files.size() - 1));
  const std::size_t at = index ? std::size_t(*index) : files.size() - 1;
  SceneFrame f;
  f.setup = setup();
  f.particles = cracks ? try_to_read(results_.particle_frames, at, particles_) : read(files, at, particles_);
  if (cracks) f.bonds = read(files, at, bonds_);
  else if (with_bonds) f.bonds = try_to_read(results_.bond_frames, at, bonds_);
  f.walls = try_to_read(results_.wall_frames, at, walls_);
  if (!f.particles && !f.walls) return f;
  // Where platens and loads are at this time.
  TestSetup now = setup_of(f.particles, f.bonds, f.walls);
  if (now.platens.size() == f.setup.platens.size()) f.setup.platens = std::move(now.platens);
  if (f.particles) {
    f.setup.loads = std::move(now.loads);
    if (!f.setup.held.empty()) f.setup.held = held_of(f.particles);
  }
  return f;
}

const TestSetup& Frames::setup() {
  if (setup_) return *setup_;
  const auto last = [](const std::vector<fs::path>& files) { return files.size() - 1; };  // of none: beyond the end
  const auto particles = try_to_read(results_.particle_frames, last(results_.particle_frames), particles_);
  const auto bonds = particles ? nullptr : try_to_read(results_.bond_frames, last(results_.bond_frames), bonds_);
  const auto walls = try_to_read(results_.wall_frames, last(results_.wall_frames), walls_);
  setup_ = setup_of(particles, bonds, walls);
  if (!particles || !was_released(particles)) return *setup_;
  // What was loaded how before it was let go is seen in one of the frames before.
  constexpr std::size_t most = 20;
  const std::size_t count = results_.particle_frames.size(), step = 1 + count / most;
  for (std::size_t back = step; back < count; back += step) {
    const auto before = try_to_read(results_.particle_frames, count - 1 - back, particles_);
    TestSetup loaded = before ? setup_of(before, nullptr, walls) : TestSetup{};
    if (loaded.loads.empty()) continue;
    setup_ = std::move(loaded);
    break;
  }
  return *setup_;
}

}  // namespace breccia::pictures
