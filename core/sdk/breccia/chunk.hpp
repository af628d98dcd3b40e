// SPDX-License-Identifier: BSD-3-Clause
/// What passes between the engine and a contact law's kernel: up to 64 pairs at a time, as structures of arrays, so
/// that the law runs over them as one vector loop. No particle, no list of pairs and no sum of the engine is in it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace breccia {

/// Pairs as the engine gathered them. Entries from `size` on have no meaning. n points from i to j. The arrays come
/// first: each begins at a cache line, which a vector load would else straddle.
struct alignas(64) PairChunk {
  static constexpr std::size_t capacity = 64;
  static constexpr std::size_t n = capacity;
  double dx[n], dy[n], dz[n];                             ///< branch vector, from i to j [m]
  double vx[n], vy[n], vz[n];                             ///< velocity of j less that of i [m/s]
  double wix[n], wiy[n], wiz[n], wjx[n], wjy[n], wjz[n];  ///< spins [rad/s]
  double ri[n], rj[n];                                    ///< radii [m]
  double rest[n];                                         ///< distance without force [m]
  double mi[n], mj[n];                                    ///< only for a law that `needs_mass` [kg]
  double intact[n];                                       ///< 1 while the bond holds, else 0
  double may_break[n];                                    ///< 0 also for bonds that are protected
  std::uint32_t kind[n];                                  ///< which two materials; where there are several
  const double* breakable = intact;                       ///< `intact` where no bond is protected
  std::size_t size = 0;
  double time_step = 0;  // [s]
  bool mixed = false;    ///< pairs of several kinds; else all are of the first one's
  PairChunk() { kind[0] = 0; }
  PairChunk(const PairChunk&) = delete;
  PairChunk& operator=(const PairChunk&) = delete;
};

/// What the laws of a list answer together. Forces and moments on i, their opposites on j.
struct alignas(64) PairAnswer {
  static constexpr std::size_t n = PairChunk::capacity;
  double fx[n], fy[n], fz[n];                   // [N]
  double tx[n], ty[n], tz[n];                   ///< n x shear force: the torque on either per lever arm [N]
  double mx[n], my[n], mz[n];                   ///< where a law has moments [N m]
  double normal[n];                             ///< force so far, tension positive [N]
  double half_gap[n];                           ///< (distance - r_i - r_j)/2 [m]
  double breaks[n];                             ///< 0, or the BondState it breaks into
  double friction[n], contact[n], fracture[n];  ///< of the law that was called last [J]
};

}  // namespace breccia
