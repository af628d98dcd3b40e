// SPDX-License-Identifier: BSD-3-Clause
/// The reader of studies: the file itself and its points, not the workflows that it names.
#include "study/study.hpp"

#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  static const Registry registry;
  fuzz::write("study.yaml", fuzz::text(data, size));
  fuzz::is_read([&] { load_study("study.yaml", registry); });
  return 0;
}
