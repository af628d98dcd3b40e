// SPDX-License-Identifier: BSD-3-Clause
/// What the host offers to a plugin besides views: log, cancellation, curves and the summary.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "breccia/result_name.hpp"
#include "breccia/roles.hpp"
#include "breccia/schema.hpp"

namespace breccia {

class Host {
 public:
  virtual void info(std::string_view text) = 0;
  virtual void warn(std::string_view text) = 0;
  /// Share done of a long piece of work, 0 to 1.
  virtual void progress(std::string_view what, double done) = 0;
  virtual bool cancelled() const = 0;  ///< true once the user pressed Ctrl-C: stop soon, leave things whole
  virtual int threads() const = 0;

 protected:
  ~Host() = default;
};

/// A host, or a class made of Host, that nobody listens to: for trials and tests, which overload what they want to
/// know.
template <class Kind>
class Silent : public Kind {
 public:
  void info(std::string_view) override {}
  void warn(std::string_view) override {}
  void progress(std::string_view, double) override {}
  bool cancelled() const override { return false; }
  int threads() const override { return 1; }
};
using SilentHost = Silent<Host>;

struct Column {
  std::string name;  ///< unique, lower case with underscores, without the unit
  std::string unit;  ///< SI; "1" for a pure number
  std::string doc;
  std::string role = {};  ///< what it is in the test (`roles.hpp`), if it is one of those
};

/// The rows of curves.csv. A plugin adds its columns in `begin` or `setup` and fills them at each sample.
class Recorder {
 public:
  virtual std::size_t add(Column column) = 0;              ///< a name taken twice is the user's error
  virtual void set(std::size_t column, double value) = 0;  ///< in the row of the current sample
 protected:
  ~Recorder() = default;
};

/// The curves so far.
class Curves {
 public:
  virtual const std::vector<Column>& columns() const = 0;
  /// All values of a column in order of the samples. UserError with a suggestion when there is no such name.
  virtual std::span<const double> column(std::string_view name) const = 0;
  virtual std::size_t rows() const = 0;

 protected:
  ~Curves() = default;
};

/// Numbers that are neither a curve nor a single result: a histogram, say. Written as tables/<name>.csv.
struct Table {
  std::string name;  ///< lower case with underscores; each once in a run
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;  ///< one per column, equally long; NaN is written as an empty cell
};

/// summary.json.
class Summary {
 public:
  virtual void headline(const ResultName& name, Json value) = 0;  ///< at the top level; each once
  virtual void own(const ResultName& name, Json value) = 0;       ///< under the plugin's own name
  virtual void table(Table table) = 0;                            ///< a file of its own beside the summary
 protected:
  ~Summary() = default;
};

/// A field for the particle or bond files of one frame.
struct Field {
  enum class On { particles, bonds };
  On on = On::particles;
  std::string name, unit;
  int components = 1;          ///< 3: a vector, x y z; 6: a symmetric tensor, xx yy zz xy yz xz as VTK has it
  std::vector<double> values;  ///< components per particle (or bond), interleaved
  bool whole = false;          ///< counts and numbers of things: files hold them as integers
};

}  // namespace breccia
