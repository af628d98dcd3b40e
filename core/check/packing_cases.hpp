// SPDX-License-Identifier: BSD-3-Clause
/// What a packing is asked for when it is checked: every form that it may be told to fill, small enough to be quick.
#pragma once

#include <optional>

#include "breccia/packing_tools/container.hpp"
#include "plugin/registry.hpp"

namespace breccia {

struct PackingCase {
  std::string form, name;  ///< "3D, box, periodic"; the same with the values that were chosen
  PackingRequest request;
  PluginChoice choice;
  std::optional<Container> container;  ///< that was asked for; none: the packing has no such parameter
};

/// One way to ask for the same, for each value of the parameters that are choices without a default (a lattice): some
/// of them suit this form.
using PackingWays = std::vector<PackingCase>;

/// The forms. Files of particles that it may be told to read are made in `folder`. `refused` gets to know what could
/// not be asked for, and why.
std::vector<PackingWays> packing_cases(const Registry& registry, const std::string& name,
                                       const std::vector<std::string>& parameters, const std::filesystem::path& folder,
                                       std::vector<std::pair<std::string, std::string>>& refused);

/// The same with `factor` times as long a container; none where there is none.
std::optional<PackingCase> enlarged(const PackingCase& of, double factor);

/// What the configuration says of the radii, where it does so as Breccia's packings do.
struct AskedRadii {
  double least = 0, most = 0;             // [m]
  std::optional<double> mean, deviation;  // [m]
};
std::optional<AskedRadii> asked_radii(const Json& config);

}  // namespace breccia
