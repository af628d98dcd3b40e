// SPDX-License-Identifier: BSD-3-Clause
#include "archive/curves_file.hpp"

#include "archive/hdf5_library.hpp"
#include "breccia/atomic_file.hpp"

namespace breccia {

void write_curves_hdf5(const std::filesystem::path& file, const Curves& curves) {
  hdf5_needs_memory(curves.columns().size() * (curves.rows() + 512) * sizeof(double));
  std::string image;
  hdf5_function<void(const Curves&, std::string&)>("breccia_curves_hdf5")(curves, image);
  write_file(file, image);
}

}  // namespace breccia
