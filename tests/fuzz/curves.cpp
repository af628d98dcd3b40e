// SPDX-License-Identifier: BSD-3-Clause
/// curves.csv as charts read it, with curves.json beside it: the bytes behind the first zero byte, if there is one.
#include <filesystem>

#include "curves_file.hpp"
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  const std::string_view bytes = fuzz::text(data, size);
  const std::size_t end = std::min(bytes.find('\0'), size);
  fuzz::write("curves.csv", bytes.substr(0, end));
  if (end < size) fuzz::write("curves.json", bytes.substr(end + 1));
  else std::filesystem::remove("curves.json");
  fuzz::is_read([&] {
    const pictures::CurvesFile file("curves.csv");
    for (const pictures::Curve& curve : file.all()) {
      if (curve.value.size() != file.all()[0].value.size()) fuzz::fail("curves of unequal length");
      if (!file.find(curve.name)) fuzz::fail("a curve that is not found by its name");
    }
    file.at("axial_stress");
  });
  return 0;
}
