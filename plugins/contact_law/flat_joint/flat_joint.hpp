// SPDX-License-Identifier: BSD-3-Clause
/// The law by its layout, each made in a source of its own.
#pragma once

#include "law.hpp"

namespace breccia::flat_joint {

template <class Layout>
std::unique_ptr<ContactLaw> make_law(const Config&);

extern template std::unique_ptr<ContactLaw> make_law<Line<2>>(const Config&);
extern template std::unique_ptr<ContactLaw> make_law<Line<4>>(const Config&);
extern template std::unique_ptr<ContactLaw> make_law<Line<8>>(const Config&);
extern template std::unique_ptr<ContactLaw> make_law<Disc<1, 3>>(const Config&);
extern template std::unique_ptr<ContactLaw> make_law<Disc<1, 4>>(const Config&);
extern template std::unique_ptr<ContactLaw> make_law<Disc<2, 4>>(const Config&);

}  // namespace breccia::flat_joint
