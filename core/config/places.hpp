// SPDX-License-Identifier: BSD-3-Clause
/// Where the values of a workflow were written, for what is found wrong with them after it was read.
#pragma once

#include <string>
#include <vector>

#include "config/base_chain.hpp"
#include "config/problem.hpp"

namespace breccia {

/// Something that a value of the workflow is to blame for; the text says what, by its path or by the plugin's name.
class AtPath : public UserError {
 public:
  AtPath(std::string path, const std::string& text) : UserError(text), path_(std::move(path)) {}
  const std::string& path() const { return path_; }  ///< "contact_law.tensile_strength", "postprocessors[2]"

 private:
  std::string path_;
};

class Places {
 public:
  Places() = default;  ///< knows none
  Places(YamlPtr tree, std::vector<InputFile> files) : tree_(std::move(tree)), files_(std::move(files)) {}

  /// With file, line and column of the value, or of what holds it when nobody wrote it: "w.yaml:7:3: " and the text.
  std::string with_place(const std::string& path, const std::string& text) const;

  /// What `f` returns; an AtPath that it throws comes out as a UserError with its place.
  template <class F>
  decltype(auto) placing(F&& f) const {
    try {
      return f();
    } catch (const AtPath& e) { throw UserError(with_place(e.path(), e.what())); }
  }

 private:
  YamlPtr tree_;
  std::vector<InputFile> files_;
};

}  // namespace breccia
