// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "breccia/utf8.hpp"
#include "cli/verbs.hpp"
#include "config/base_chain.hpp"
#include "run/sweep_cases.hpp"
#include "run/workflow.hpp"

namespace breccia::cli {

int validate(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& overrides) {
  int code = ok;
  for (const auto& file : files) {
    try {
      if (is_study(follow_bases(read_text(file), file.string()))) {
        const std::size_t cases = plan(Sweep(file)).cases.size();
        fmt::print("{}: ok, a study of {} cases\n", printable(file.string()), cases);
        continue;
      }
      std::vector<std::string> variants = workflow_variants(file);
      variants.insert(variants.begin(), "");
      for (const std::string& variant : variants) {
        Registry registry;  // one each: plugins named by one workflow must not help another
        load_workflow(file, overrides, registry, variant);
      }
      fmt::print("{}: ok\n", printable(file.string()));
    } catch (const UserError& e) {
      fmt::print(stderr, "{}\n", printable(e.what()));
      code = bad_input;
    }
  }
  return code;
}

}  // namespace breccia::cli
