// SPDX-License-Identifier: BSD-3-Clause
/// Latin hypercube sampling.
#include <cmath>
#include <numeric>
#include <random>

#include "study/design.hpp"

namespace breccia {

void LatinRange::describe(Schema<LatinRange>& s) {
  s.param("parameter", &LatinRange::parameter)
      .example("contact_law.bond_modulus")
      .doc("path of the parameter, as for `--set`");
  s.param("from", &LatinRange::from).example("10 GPa").doc("least value");
  s.param("to", &LatinRange::to).example("40 GPa").doc("largest value, in the unit of `from`");
  s.param("scale", &LatinRange::scale)
      .choice("linear", LatinScale::linear, "all values are equally likely")
      .choice("log", LatinScale::log, "all orders of magnitude are")
      .fallback("linear")
      .doc("how the values spread");
}

void LatinHypercube::describe(Schema<LatinHypercube>& s) {
  s.param("samples", &LatinHypercube::samples)
      .at_least(1)
      .at_most(double(max_cases))
      .example("20")
      .doc("number of points");
  s.param("seed", &LatinHypercube::seed)
      .at_least(0)
      .fallback(1)
      .doc("of the samples; has nothing to do with the workflow's");
  s.param("ranges", &LatinHypercube::ranges).items(1, 1000).doc("the parameters and their ranges");
}

std::vector<std::vector<double>> latin_hypercube(std::size_t parameters, std::size_t samples, std::uint64_t seed) {
  // The distributions of the standard library differ between implementations; its engines do not.
  std::mt19937_64 random(seed);
  const auto below_one = [&] { return double(random() >> 11) * 0x1p-53; };
  std::vector<std::vector<double>> all(parameters, std::vector<double>(samples));
  for (std::vector<double>& at : all) {
    std::vector<std::size_t> stratum(samples);
    std::iota(stratum.begin(), stratum.end(), std::size_t(0));
    for (std::size_t k = samples; k > 1; --k) std::swap(stratum[k - 1], stratum[std::size_t(below_one() * double(k))]);
    for (std::size_t k = 0; k < samples; ++k) at[k] = (double(stratum[k]) + below_one()) / double(samples);
  }
  return all;
}

}  // namespace breccia
