// SPDX-License-Identifier: BSD-3-Clause
/// A packing as a run makes it.
#pragma once

#include "breccia/packing.hpp"

namespace breccia {

/// UserError for what the packing says it cannot do.
inline PackedParticles generate(Packing& packing, const PackingRequest& request, Host& host) {
  if (const std::string why = packing.why_not(request); !why.empty()) throw UserError(why);
  return packing.generate(request, host);
}

}  // namespace breccia
