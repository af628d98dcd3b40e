// SPDX-License-Identifier: BSD-3-Clause
#include "report/report.hpp"

#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "plugin/drawing.hpp"

namespace breccia::cli {

int report(const ReportArguments& a) {
  Console console(1);
  const Registry registry;
  const report::ReportRequest request{a.folder,  a.output,  a.overwrite,
                                      a.authors, a.licence, usual_renderer({}, registry, console)};
  for (const auto& file : report::write_report(request, registry, console)) console.info("made " + file.string());
  return ok;
}

}  // namespace breccia::cli
