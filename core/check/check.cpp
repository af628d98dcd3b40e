// SPDX-License-Identifier: BSD-3-Clause
#include "check/check.hpp"

#include "breccia/contact_law.hpp"
#include "breccia/output.hpp"
#include "breccia/packing.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/renderer.hpp"
#include "breccia/search.hpp"
#include "check/example.hpp"
#include "check/law_check.hpp"

namespace breccia {

CheckFindings check_plugin(const Registry& registry, const std::string& kind, const std::string& name,
                           const std::vector<std::string>& parameters, const Host& user) {
  if (kind == ContactLaw::kind) return check_law(registry, example_plugin(registry, kind, name, parameters), user);
  if (kind == Packing::kind) return check_packing(registry, name, parameters, user);
  if (kind == Protocol::kind) return check_protocol(registry, name, parameters, user);
  if (kind == Postprocessor::kind) return check_postprocessor(registry, name, parameters, user);
  if (kind == Output::kind) return check_output(registry, name, parameters, user);
  if (kind == Search::kind) return check_search(registry, name, parameters, user);
  BRECCIA_ASSERT(kind == Renderer::kind);
  return check_renderer(registry, name, parameters, user);
}

}  // namespace breccia
