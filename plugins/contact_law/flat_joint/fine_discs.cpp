// SPDX-License-Identifier: BSD-3-Clause
/// Faces of spheres, in many elements: by far the longest to compile.
#include "instances.hpp"

namespace breccia::flat_joint {

template std::unique_ptr<ContactLaw> make_law<Disc<3, 8>>(const Config&);

}  // namespace breccia::flat_joint
