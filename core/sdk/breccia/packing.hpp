// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `packing`: makes spheres (or discs) in a container.
#pragma once

#include <array>

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// One line of the asked/got report; a quantity nobody asked for has no `asked`.
struct AskedGot {
  std::string name, unit;
  std::optional<double> asked;
  double got = 0;
};

struct PackingRequest : Space {
  std::uint64_t seed = 1;
  std::array<bool, 3> periodic{};  ///< along x, y, z: the packing says after which length it repeats itself there
  bool repeats() const { return periodic[0] || periodic[1] || periodic[2]; }

  /// What is to be made: all of it, or one of several shares (`Packing::makes_shares`), whose makers put together by
  /// `share.sum`, `share.max` and `share.all` what is measured of the whole.
  SeenInPart share = {};
  /// Of so many things in a row (cells of a lattice, copies) those that belong to this share.
  OwnRows share_of(std::size_t all) const {
    const std::size_t number = share.part ? std::size_t(share.part->number) : 0,
                      count = share.part ? std::size_t(share.part->count) : 1;
    return {all / count * number + all % count * number / count,
            all / count * (number + 1) + all % count * (number + 1) / count};
  }
};

struct PackedParticles {
  std::vector<Vec3> position;  ///< [m]
  std::vector<double> radius;  ///< [m], as many
  SpecimenShape::Outline outline = SpecimenShape::Outline::cylinder;
  Vec3 axis = Vec3::UnitZ();    ///< of the cylinder, else the long direction
  double container_volume = 0;  ///< asked for [m3]; 0 when nobody did: then the measured shape counts
  Vec3 period = Vec3::Zero();   ///< where `periodic` was asked for: after which lengths it repeats itself [m]
  std::vector<AskedGot> report;
  /// What else a packing knows of its particles, by name: a mineral's number, a grain. One value per particle.
  std::vector<std::pair<std::string, std::vector<double>>> columns;
};

class BRECCIA_API Packing : public Plugin {
 public:
  static constexpr const char* kind = "packing";
  /// Why it cannot make what is asked for, as `validate` can tell without making it ("needs three dimensions"); else
  /// empty. Asked before `generate`.
  virtual std::string why_not(const PackingRequest&) const { return {}; }
  /// Whether it can fill a space that repeats itself; without that nobody asks it to.
  virtual bool can_repeat() const { return false; }
  /// Whether several ranks may make it together, each its share (`PackingRequest::share`), so that none has the whole.
  /// The shares one behind the other are the packing, bit for bit, for any number of them; all else (`axis`, `report`,
  /// ...) is that of the whole in each. Without that one rank makes it and deals it out.
  virtual bool makes_shares() const { return false; }
  /// The same request and configuration must give the same bits for any number of threads.
  virtual PackedParticles generate(const PackingRequest& request, Host& host) = 0;
  /// Files the result depends on besides the configuration: they enter the cache key.
  virtual std::vector<std::filesystem::path> inputs() const { return {}; }
};

}  // namespace breccia
