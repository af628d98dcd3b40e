// SPDX-License-Identifier: BSD-3-Clause
/// Who adds which curves to a run, and whether its laws fit its particles; known before the packing is made.
#pragma once

#include "breccia/protocol.hpp"
#include "results/curve_table.hpp"
#include "run/listed.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

/// Of a run: sets up the test and lets the post-processors add their curves. UserError when one needs a curve that
/// there is not. Returns the column of the time.
std::size_t add_columns(StepViews& views, LoadControl& control, Protocol& protocol, const PluginId& protocol_id,
                        std::vector<Listed<Postprocessor>>& postprocessors, CurveTable& curves, Host& host);

/// Tries the same with a few particles in place of the specimen, which may be long in the making: UserError when a
/// post-processor needs a curve that no plugin adds. What cannot be tried with so few is left to the run.
void check_curves(const Workflow& workflow, const Registry& registry);

/// UserError, in the law's own words, when a contact law cannot do with spheres that it could do with discs, or the
/// other way round.
void check_dimension(const Workflow& workflow, const Registry& registry);

}  // namespace breccia
