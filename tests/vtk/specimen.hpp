// SPDX-License-Identifier: BSD-3-Clause
/// A made-up specimen after failure, for files and pictures: relaxed random spheres in a cylinder (or discs in a
/// rectangle), a shear band with broken bonds, and walls. Not mechanics: only shapes and numbers that look like them.
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "breccia/cell_grid.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia::test {

class Specimen {
 public:
  /// `count` particles, radii 0.3 to 1.2 mm in 3D; the container has the proportions 1:2 and fits the count.
  Specimen(std::size_t count, int dimension, unsigned seed = 1) : dimension_(dimension) {
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
    double solid = 0;
    for (std::size_t p = 0; p < count; ++p) {
      // Many small, few large ones.
      const double r = 0.3e-3 + 0.9e-3 * std::pow(uniform(), 2.5);
      radius_.push_back(r);
      solid += dimension == 3 ? 4.0 / 3 * 3.14159265 * r * r * r : 3.14159265 * r * r;
    }
    half_width_ = dimension == 3 ? std::cbrt(solid / 0.66 / (4 * 3.14159265)) : std::sqrt(solid / 0.84 / 8);
    for (std::size_t p = 0; p < count; ++p) {
      Vec3 x;
      do x = Vec3(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
      while (dimension == 3 && std::hypot(x.x(), x.y()) > 1);
      position_.push_back(dimension == 3 ? Vec3(half_width_ * x.x(), half_width_ * x.y(), 2 * half_width_ * (x.z() + 1))
                                         : Vec3(half_width_ * x.x(), 2 * half_width_ * (x.y() + 1), 0));
    }
    for (int round = 0; round < 80; ++round) relax();
    fill();
  }

  SimulationView view(double time) const {
    SimulationView v;
    v.dimension = dimension_;
    v.time = time;
    v.particles = {position_, velocity_, spin_, initial_, force_, spin_, {}, {}, radius_, mass_, {}, id_, {}};
    v.pairs = {pair_i_, pair_j_, pair_length_, pair_state_, pair_bond_, pair_force_, {}, {}};
    v.bonds = {bond_i_, bond_j_, bond_length_, bond_state_, bond_pair_, crack_of_, cracks_};
    v.walls = walls_;
    v.specimen = shape_;
    return v;
  }
  const std::vector<Field>& fields() const { return fields_; }
  std::vector<Vec3>& position() { return position_; }

 private:
  int up() const { return dimension_ == 3 ? 2 : 1; }

  void relax() {
    std::vector<Vec3> push(position_.size(), Vec3::Zero());
    CellGrid(position_, 2.4e-3).for_each_pair([&](Index i, Index j) {
      const Vec3 d = position_[j] - position_[i];
      const double overlap = radius_[i] + radius_[j] - d.norm();
      if (overlap <= 0) return;
      push[i] -= 0.3 * overlap * d.normalized();
      push[j] += 0.3 * overlap * d.normalized();
    });
    for (std::size_t p = 0; p < position_.size(); ++p) {
      Vec3& x = position_[p];
      x += push[p];
      x[up()] = std::clamp(x[up()], radius_[p], 4 * half_width_ - radius_[p]);
      const double wide = half_width_ - radius_[p];
      if (dimension_ == 2) x.x() = std::clamp(x.x(), -wide, wide);
      else if (const double r = std::hypot(x.x(), x.y()); r > wide) {
        x.x() *= wide / r;
        x.y() *= wide / r;
      }
    }
  }

  void fill() {
    const std::size_t n = position_.size();
    initial_ = position_;
    const Vec3 across = Vec3(0.8, dimension_ == 3 ? 0.3 : 0, 0).normalized(),
               slope = (across + 1.4 * Vec3::Unit(up())).normalized();
    const Vec3 centre = 2 * half_width_ * Vec3::Unit(up()), plane = (1.4 * across - Vec3::Unit(up())).normalized();
    std::vector<double> distance;
    for (std::size_t p = 0; p < n; ++p) {
      const double d = (position_[p] - centre).dot(plane);
      distance.push_back(d);
      const Vec3 slip = -1.5e-4 * std::tanh(d / 2e-3) * slope;
      position_[p] += slip - 2e-3 * (position_[p][up()] - 2 * half_width_) * Vec3::Unit(up());
      velocity_.push_back(100 * slip);
      spin_.push_back(Vec3(0.1, -0.2, d));
      force_.push_back(Vec3(1, 2, 3) * double(p % 7));
      mass_.push_back(2500 * 4.19 * std::pow(radius_[p], 3));
      id_.push_back(Index(n - 1 - p));
    }
    std::vector<double> bonds(n, 0), broken(n, 0);
    CellGrid(initial_, 2.5e-3).for_each_pair([&](Index i, Index j) {
      const Vec3 d = initial_[j] - initial_[i];
      if (d.norm() > 1.1 * (radius_[i] + radius_[j])) return;
      const double off = 0.5 * (distance[i] + distance[j]);
      // A hash of the pair, for scatter that does not depend on the order.
      const double chance = double((i * 2654435761u ^ j * 40503u) % 1000u) / 1000;
      const bool breaks = chance < 0.9 * std::exp(-std::pow(off / 1.6e-3, 2)) + 0.004;
      const std::size_t k = bond_i_.size();
      bond_i_.push_back(i);
      bond_j_.push_back(j);
      bond_length_.push_back(d.norm());
      const bool shear = chance * 7 - std::floor(chance * 7) < 0.25;
      bond_state_.push_back(!breaks ? BondState::intact : shear ? BondState::broken_shear : BondState::broken_tension);
      crack_of_.push_back(breaks ? Index(cracks_.size()) : BondsView::no_crack);
      if (breaks)
        cracks_.push_back({1e-3 + 6e-4 * chance + 0.02 * std::abs(off),
                           initial_[i] + d * radius_[i] / (radius_[i] + radius_[j]), d.normalized(),
                           1e-6 * double(1 + cracks_.size())});
      const bool parted = breaks && k % 3 == 0;
      bond_pair_.push_back(parted ? BondsView::no_pair : Index(pair_i_.size()));
      ++bonds[i];
      ++bonds[j];
      if (breaks) {
        ++broken[i];
        ++broken[j];
      }
      if (parted) return;
      pair_i_.push_back(i);
      pair_j_.push_back(j);
      pair_length_.push_back(d.norm());
      pair_state_.push_back(bond_state_.back());
      pair_bond_.push_back(Index(k));
      const Vec3 f = (breaks ? -2.0 : 5.0) * d.normalized() + 3.0 * d.cross(Vec3(0.3, 0.5, 0.7)).normalized();
      pair_force_.push_back({f.x(), f.y(), f.z(), 0});
    });
    fields_ = {{Field::On::particles, "damage", "1", 1, {}}, {Field::On::bonds, "length_change", "m", 1, {}}};
    for (std::size_t p = 0; p < n; ++p) fields_[0].values.push_back(bonds[p] > 0 ? broken[p] / bonds[p] : 0);
    for (std::size_t k = 0; k < bond_i_.size(); ++k)
      fields_[1].values.push_back((position_[bond_j_[k]] - position_[bond_i_[k]]).norm() - bond_length_[k]);
    shape_.outline = dimension_ == 3 ? SpecimenShape::Outline::cylinder : SpecimenShape::Outline::box;
    shape_.axis = Vec3::Unit(up());
    shape_.height = 4 * half_width_;
    shape_.extent = dimension_ == 3 ? Vec3(2 * half_width_, 2 * half_width_, 4 * half_width_)
                                    : Vec3(2 * half_width_, 4 * half_width_, 1);
    walls_ = {{"bottom", Vec3::Zero(), Vec3::Unit(up()), Vec3::Zero(), Vec3::Zero(), 7 * Vec3::Unit(up()), 7, 0, 3},
              {"top", 4 * half_width_ * Vec3::Unit(up()), -Vec3::Unit(up()), Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, -7),
               7, 0, 4}};
  }

  int dimension_;
  double half_width_ = 0;
  std::vector<Vec3> position_, velocity_, spin_, initial_, force_;
  std::vector<double> radius_, mass_;
  std::vector<Index> id_;
  std::vector<Index> pair_i_, pair_j_, pair_bond_, bond_i_, bond_j_, bond_pair_;
  std::vector<double> pair_length_, bond_length_;
  std::vector<BondState> pair_state_, bond_state_;
  std::vector<PairForce> pair_force_;
  std::vector<Index> crack_of_;
  std::vector<Crack> cracks_;
  std::vector<WallView> walls_;
  std::vector<Field> fields_;
  SpecimenShape shape_;
};

/// A plausible curves.csv of a brittle test.
inline std::string made_up_curves() {
  std::string text = "time_s,axial_strain,lateral_strain,volumetric_strain,axial_stress_Pa,global_damage\n";
  for (int k = 0; k <= 200; ++k) {
    const double e = 8e-3 * k / 200, peak = 5.6e-3;
    const double stress =
        20e9 * e *
        (e < peak ? 1 - 0.06 * std::pow(e / peak, 6) : 0.92 * std::exp(-std::pow((e - peak) / 7e-4, 2)) + 0.02);
    const double damage =
        0.03 * std::pow(std::min(e / peak, 1.0), 4) + (e > peak ? 0.22 * (1 - std::exp(-(e - peak) / 8e-4)) : 0);
    const double lateral = 0.2 * e + 3e-3 * std::pow(e / 8e-3, 8);
    char line[160];
    std::snprintf(line, sizeof line, "%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", 0.4 * e, e, lateral, e - 2 * lateral, stress,
                  damage);
    text += line;
  }
  return text;
}

}  // namespace breccia::test
