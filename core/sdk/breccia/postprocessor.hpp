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
  /// True: it can measure a specimen that is shared by several ranks where its parts are. Each rank then has one of it,
  /// and all are called together, in the same order, with the view of their part; what they put together they ask of
  /// `view.sum` and `view.max`. What that of the first rank sets and states counts, and what it archives comes back on
  /// all: what changes in them must be the same. A field has a value for each row of the view's lists, of which those
  /// of own rows count. False: there is one, on the first rank, for which all parts are brought together. On one rank
  /// there is no difference.
  virtual bool sees_parts() const { return false; }
  virtual void begin(const SimulationView&, Recorder&, Host&) {}  ///< before the first step: adds columns
  /// Curves that `finish` will ask for, whoever writes them: checked before the first step rather than after the last.
  virtual std::vector<std::string> needed_curves() const { return {}; }
  virtual void start_of_loading(const SimulationView&) {}             ///< the reference state for strains
  virtual void sample(const SimulationView&, Recorder&) {}            ///< fills them
  virtual void fields(const SimulationView&, std::vector<Field>&) {}  ///< for the frames that outputs write
  /// Results of the whole run. The curves are the same on all ranks.
  virtual void finish(const SimulationView&, const Curves&, Summary&) {}
};

}  // namespace breccia
