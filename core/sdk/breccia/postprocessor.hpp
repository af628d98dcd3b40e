// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `postprocessor`: measures the running simulation. It sees everything and changes nothing.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

class BRECCIA_API Postprocessor : public Plugin {
 public:
  static constexpr const char* kind = "postprocessor";
  virtual void begin(const SimulationView&, Recorder&, Host&) {}  ///< before the first step: adds columns
  /// Curves that `finish` will ask for, whoever writes them: checked before the first step rather than after the last.
  virtual std::vector<std::string> needed_curves() const { return {}; }
  virtual void start_of_loading(const SimulationView&) {}                 ///< the reference state for strains
  virtual void sample(const SimulationView&, Recorder&) {}                ///< fills them
  virtual void fields(const SimulationView&, std::vector<Field>&) {}      ///< for the frames that outputs write
  virtual void finish(const SimulationView&, const Curves&, Summary&) {}  ///< results of the whole run
};

}  // namespace breccia
