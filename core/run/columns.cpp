// SPDX-License-Identifier: BSD-3-Clause
#include "run/columns.hpp"

#include <algorithm>

#include "config/places.hpp"
#include "engine/simulation.hpp"
#include "plugin/guarded.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {
namespace {

/// Where all add their curves: on the first of several ranks, or on all.
void check_needed(std::vector<Listed<Postprocessor>>& postprocessors, const CurveTable& curves) {
  if (!std::all_of(postprocessors.begin(), postprocessors.end(), [](const auto& p) { return p.works(); })) return;
  for (std::size_t k = 0; k < postprocessors.size(); ++k) {
    auto& p = postprocessors[k];
    for (const std::string& name :
         p.call("naming the curves it needs", [](Postprocessor& q) { return q.needed_curves(); }))
      try {
        (void)NamedCurves(curves, p.prefix()).column(name);
      } catch (const UserError& e) {
        throw AtPath("postprocessors[" + std::to_string(k) + "]", "postprocessor " + p.label() + ": " + e.what());
      }
  }
}

std::size_t set_up(StepViews& views, LoadControl& control, Protocol& protocol, const PluginId& protocol_id,
                   std::vector<Listed<Postprocessor>>& postprocessors, CurveTable& curves, Host& host) {
  const std::size_t time = curves.add({"time", "s", "since the first step"});
  try {
    const SimulationView view = protocol.sees_parts() ? views.part() : views.everywhere();
    views.others().together(
        [&] { calling(protocol_id, "setting up the test", [&] { protocol.setup(view, control, curves, host); }); });
  } catch (const PluginFault& e) { throw AtPath("protocol", e.what()); }
  for (auto& p : postprocessors) {
    NamedRecorder recorder(curves, p.prefix());
    try {
      p.show(views, "adding its curves",
             [&](Postprocessor& q, const SimulationView& view) { q.begin(view, recorder, host); });
    } catch (const PluginFault& e) {
      throw AtPath("postprocessors[" + std::to_string(&p - postprocessors.data()) + "]", e.what());
    }
  }
  return time;
}

/// A block of spheres, or a sheet of discs, that touch.
PackedParticles stand_in(const PackingRequest& request, SpecimenShape::Outline outline) {
  constexpr double r = 1e-3;
  const bool flat = request.dimension == 2;
  PackedParticles p;
  for (int k = 0; k < (flat ? 1 : 12); ++k)
    for (int j = 0; j < (flat ? 12 : 6); ++j)
      for (int i = 0; i < 6; ++i) {
        p.position.emplace_back(r * (2 * i - 5), flat ? r * (2 * j + 1) : r * (2 * j - 5), flat ? 0 : r * (2 * k + 1));
        p.radius.push_back(r);
      }
  p.outline = outline;
  p.axis = flat ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 size = 2 * r * (flat ? Vec3(6, 12, 0) : Vec3(6, 6, 12));
  for (int k = 0; k < 3; ++k) p.period[k] = request.periodic[std::size_t(k)] ? size[k] : 0;
  return p;
}

/// The laws of the workflow between a few particles.
class FewParticles {
 public:
  FewParticles(const Workflow& w, const Registry& registry, const PackingRequest& request,
               SpecimenShape::Outline outline)
      : laws_(registry, with_means(w.contact_law)),
        simulation_(assemble(stand_in(request, outline), {2650.0}, request.dimension, w.thickness),
                    laws_.interactions(), {}) {
    laws_.within([&] { simulation_.bond({GapMeasure::relative, 1e-6, std::nullopt}, SpecimenToTell{0.3, 6}); });
  }

  Simulation& simulation() { return simulation_; }

 private:
  ContactLaws laws_;
  Simulation simulation_;
};

}  // namespace

std::size_t add_columns(StepViews& views, LoadControl& control, Protocol& protocol, const PluginId& protocol_id,
                        std::vector<Listed<Postprocessor>>& postprocessors, CurveTable& curves, Host& host) {
  const std::size_t time = set_up(views, control, protocol, protocol_id, postprocessors, curves, host);
  check_needed(postprocessors, curves);
  return time;
}

void check_curves(const Workflow& w, const Registry& registry) {
  for (const auto outline : {SpecimenShape::Outline::cylinder, SpecimenShape::Outline::box}) {
    CurveTable curves;
    std::vector<Listed<Postprocessor>> postprocessors;
    SilentHost host;
    try {
      FewParticles few(w, registry, w.packing_request(), outline);
      MeetingParts nobody(nullptr);
      StepViews views(few.simulation(), nobody);
      const auto protocol = registry.create<Protocol>(w.protocol);
      for (const PluginChoice& c : w.postprocessors) postprocessors.emplace_back(c, registry);
      set_up(views, few.simulation(), *protocol, {Protocol::kind, w.protocol.type}, postprocessors, curves, host);
    } catch (const std::exception&) {
      continue;  // it may be the few particles: the run will say
    }
    return check_needed(postprocessors, curves);
  }
}

void check_dimension(const Workflow& w, const Registry& registry) {
  const auto try_with = [&](int dimension) {
    PackingRequest request = w.packing_request();
    request.dimension = dimension;
    request.periodic = {};
    FewParticles(w, registry, request, SpecimenShape::Outline::box);
  };
  try {
    try_with(int(w.dimension));
  } catch (const UserError&) {
    try {
      try_with(w.dimension == 2 ? 3 : 2);
    } catch (const UserError&) {
      return;  // it may be the few particles: the run will say
    }
    throw;
  }
}

}  // namespace breccia
