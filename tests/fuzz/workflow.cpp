// SPDX-License-Identifier: BSD-3-Clause
/// The reader of workflows: all that happens before a run begins, with the shipped plugins and, of the files in
/// `base/`, those that the text builds on.
#include "fuzz.hpp"
#include "run/load_workflow.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  static const Registry registry;
  fuzz::is_read([&] {
    const BaseChain chain = follow_bases(std::string(fuzz::text(data, size)), "workflow.yaml");
    if (!is_study(chain)) load_workflow(chain, ValuesOnTop{}, registry);
  });
  return 0;
}
