// SPDX-License-Identifier: BSD-3-Clause
/// History of a pair. Members that discs need not have are left out there: a step reads all of it.
#pragma once

#include "breccia/contact_law.hpp"
#include "layout.hpp"

namespace breccia::flat_joint {

/// All zero: a point contact at rest, which is what a pair is that has never been bonded.
struct Joint {
  double bonded_elements;  ///< in binary: element k adds 2^k
  double bonded_share;     ///< of the area
  double gap;              ///< at the start [m]
  double faces;            ///< 1 while there are any
};

template <int dimension>
struct Motion;
/// Along the line of the interface, and about the third axis.
template <>
struct Motion<2> : Joint {
  double shear_1, bending_2;
};
/// By axes of the interface, of which the first is kept and the second is n x that.
template <>
struct Motion<3> : Joint {
  double axis_x, axis_y, axis_z, shear_1, shear_2, bending_1, bending_2, twist;
};

template <class Layout>
struct History : Motion<Layout::dimension>, Slid<Layout::dimension, Layout::count - 1> {};

/// Where `flat_joint.cpp` finds them, whatever the layout.
enum Column : std::size_t { bonded_elements_column, bonded_share_column, gap_column };

template <class Layout, std::size_t... k>
constexpr auto history_columns(std::index_sequence<k...>) {
  using S = History<Layout>;
  using C = StateColumn<S>;
  if constexpr (Layout::dimension == 2)
    return std::array{C{&S::bonded_elements, "bonded_elements", "1"},
                      C{&S::bonded_share, "bonded_share", "1"},
                      C{&S::gap, "gap", "m"},
                      C{&S::faces, "faces", "1"},
                      C{&S::shear_1, "shear_1", "m"},
                      C{&S::bending_2, "bending_2", "rad"},
                      C{&Slid<2, int(k)>::slid_1, SlidName<int(k), '1'>::text, "m"}...};
  else
    return std::array{C{&S::bonded_elements, "bonded_elements", "1"},
                      C{&S::bonded_share, "bonded_share", "1"},
                      C{&S::gap, "gap", "m"},
                      C{&S::faces, "faces", "1"},
                      C{&S::axis_x, "axis_x", "1"},
                      C{&S::axis_y, "axis_y", "1"},
                      C{&S::axis_z, "axis_z", "1"},
                      C{&S::shear_1, "shear_1", "m"},
                      C{&S::shear_2, "shear_2", "m"},
                      C{&S::bending_1, "bending_1", "rad"},
                      C{&S::bending_2, "bending_2", "rad"},
                      C{&S::twist, "twist", "rad"},
                      C{&Slid<3, int(k)>::slid_1, SlidName<int(k), '1'>::text, "m"}...,
                      C{&Slid<3, int(k)>::slid_2, SlidName<int(k), '2'>::text, "m"}...};
}

}  // namespace breccia::flat_joint
