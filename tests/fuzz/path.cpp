// SPDX-License-Identifier: BSD-3-Clause
/// The path of `breccia drive`.
#include <cmath>

#include "drive/drive_path.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  fuzz::write("path.csv", fuzz::text(data, size));
  fuzz::is_read([&] {
    const DrivePath path = read_drive_path("path.csv");
    if (path.points.size() < 2) fuzz::fail("a path without a way");
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const WayPoint &before = path.points[k - 1], &p = path.points[k];
      for (const double x : {p.normal, p.shear, p.rotation, p.twist, p.time})
        if (!std::isfinite(x)) fuzz::fail("a way point that is not finite");
      if (path.timed && !(p.time > before.time)) fuzz::fail("time goes back");
    }
  });
  return 0;
}
