// SPDX-License-Identifier: BSD-3-Clause
/// Whether a contact law is what it says: tried on single pairs, in all directions, against itself.
#pragma once

#include "check/findings.hpp"
#include "plugin/registry.hpp"

namespace breccia {

/// The law of that configuration (checked, SI) through all trials, in their order. Deterministic, but for the last one,
/// which takes its time. PluginFault where the law itself throws; Cancelled when `user` wants it to end.
CheckFindings check_law(const Registry& registry, const PluginChoice& law, const Host& user);

}  // namespace breccia
