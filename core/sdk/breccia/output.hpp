// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `output`: writes frames of the running simulation to files.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

class BRECCIA_API Output : public Plugin {
 public:
  static constexpr const char* kind = "output";
  /// True: it writes a specimen that is shared by several ranks where its parts are. Each rank then has one of it, all
  /// are called together, in the same order, and `frame` gets the view of a part; fields have a value for each row of
  /// its lists, of which those of own rows count. What that of the first rank archives comes back on all. False: there
  /// is one, on the first rank, for which all parts are brought together.
  virtual bool sees_parts() const { return false; }
  virtual void begin(const std::filesystem::path& directory, Host& host) = 0;
  /// `fields` are the core's and the post-processors'. A file must appear under its final name only when whole;
  /// a failed write is a UserError that names the file.
  virtual void frame(const SimulationView& view, std::span<const Field> fields) = 0;
  virtual double interval() const = 0;  ///< time between frames [s]; the first and the last state are always written
  virtual void finish() {}
};

}  // namespace breccia
