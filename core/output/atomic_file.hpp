// SPDX-License-Identifier: BSD-3-Clause
/// The core writes files as plugins do.
#pragma once

#include "breccia/atomic_file.hpp"
