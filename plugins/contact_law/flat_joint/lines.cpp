// SPDX-License-Identifier: BSD-3-Clause
/// Faces of discs.
#include "instances.hpp"

namespace breccia::flat_joint {

template std::unique_ptr<ContactLaw> make_law<Line<2>>(const Config&);
template std::unique_ptr<ContactLaw> make_law<Line<4>>(const Config&);
template std::unique_ptr<ContactLaw> make_law<Line<8>>(const Config&);

}  // namespace breccia::flat_joint
