// SPDX-License-Identifier: BSD-3-Clause
/// Which colour a value has: range, map and colour bar.
#pragma once

#include <optional>

#include "overlay.hpp"
#include "results.hpp"

namespace breccia::pictures {

/// What the user wants of the colours.
struct ColourWish {
  ColourMap map = ColourMap::automatic;
  std::optional<double> low, high;  ///< of the colour bar, in the SI unit of the field
};

struct Scale {
  ColourMap map = ColourMap::viridis;
  double low = 0, high = 1;
};

/// The range of what is seen, symmetric about zero where there is something on either side of it.
Scale scale_of(const Values& v, const ColourWish& wish);

ColourBar bar_of(const Values& v, const std::string& name, const Scale& scale);

/// One colour each for values that only name something, and the legend of those that are there.
void colour_by_name(Overlay& overlay, const std::vector<std::string>& names, const std::vector<double>& value,
                    ColourTable& colours);

}  // namespace breccia::pictures
