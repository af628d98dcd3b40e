// SPDX-License-Identifier: BSD-3-Clause
/// Faces of spheres.
#include "instances.hpp"

namespace breccia::flat_joint {

template std::unique_ptr<ContactLaw> make_law<Disc<1, 3>>(const Config&);
template std::unique_ptr<ContactLaw> make_law<Disc<1, 4>>(const Config&);
template std::unique_ptr<ContactLaw> make_law<Disc<2, 4>>(const Config&);

}  // namespace breccia::flat_joint
