// SPDX-License-Identifier: BSD-3-Clause
/// Writes the JSON Schema of the workflow that tests/errors is about.
#include <cstdio>

#include "config/json_schema.hpp"
#include "fake_workflow.hpp"

int main() {
  using namespace breccia;
  std::puts(json_schema(fake::root(), fake::Plugins()).dump().c_str());
}
