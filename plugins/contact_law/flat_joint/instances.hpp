// SPDX-License-Identifier: BSD-3-Clause
/// For the sources that make laws.
#pragma once

#include "flat_joint.hpp"

namespace breccia::flat_joint {

template <class Layout>
std::unique_ptr<ContactLaw> make_law(const Config& c) {
  return std::make_unique<ContactLawOf<Law<Layout>>>(c);
}

}  // namespace breccia::flat_joint
