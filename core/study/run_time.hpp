// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace breccia {

/// How long a run may take by the clock; what takes longer has failed.
struct RunTime {
  double seconds = 0;  ///< 0: as long as it takes
  std::string text;    ///< as the user wrote it: "5 min"
};

}  // namespace breccia
