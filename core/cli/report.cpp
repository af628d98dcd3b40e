// SPDX-License-Identifier: BSD-3-Clause
#include "report/report.hpp"

#include <algorithm>

#include "cli/console.hpp"
#include "cli/renderer_settings.hpp"
#include "cli/verbs.hpp"

namespace breccia::cli {

int report(const ReportArguments& a) {
  Console console(1);
  const Registry registry;
  report::ReportRequest request{a.folder, a.output, a.overwrite, a.authors, a.licence, {}};
  const std::vector<std::string> renderers = registry.names("renderer");
  if (std::find(renderers.begin(), renderers.end(), "pictures") != renderers.end())
    request.renderer = renderer_settings("pictures", {}, registry);
  for (const auto& file : report::write_report(request, registry, console)) console.info("made " + file.string());
  return ok;
}

}  // namespace breccia::cli
