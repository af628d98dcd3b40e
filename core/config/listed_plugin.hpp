// SPDX-License-Identifier: BSD-3-Clause
/// What a plugin of a list has besides its own parameters: a name that tells it from others of its type.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

/// `name`, the one declaration.
const ParamSpec& name_in_list();

/// The parameters of a plugin as one of a list has them. A plugin that has a `name` of its own keeps it as it is.
ParamSpec as_listed(const ParamSpec& plugin);

/// Whether a plugin with these parameters takes its name from `name_in_list`.
bool takes_name(const ParamSpec& plugin);

}  // namespace breccia
