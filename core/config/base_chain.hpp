// SPDX-License-Identifier: BSD-3-Clause
/// A workflow and the files that it builds on: `base: specimen.yaml` at the top of a file names the file whose values
/// it takes over, relative to itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/yaml_tree.hpp"

namespace breccia {

/// How many files may build on each other, the workflow not counted.
constexpr std::size_t max_bases = 16;

struct InputFile {
  std::string name;              ///< as messages show it
  std::filesystem::path folder;  ///< absolute; relative paths written in the file start here
  YamlPtr tree;                  ///< without its key `base`; nullptr when it cannot be read
  Place base;                    ///< of the key `base`
  bool on_top = false;           ///< not part of the chain, but of values on top of it
};

/// Parsed, but neither merged nor checked against a schema: that needs the plugins, which the files may name.
struct BaseChain {
  std::vector<InputFile> files;  ///< the workflow, its base, that file's base, and so on; their index is Place::source
  std::vector<Finding> findings;
  bool whole = false;  ///< no file is missing, empty or broken
};

/// One value of the merged workflow, given apart from its files.
struct PlacedValue {
  std::string path;  ///< "contact_law.friction", "postprocessors.0.every"
  Place place;       ///< of the path
  YamlPtr value;
};

/// Values that another file, such as a study, puts on top of a workflow, in its order.
struct ValuesOnTop {
  InputFile file;
  std::vector<PlacedValue> values;  ///< whatever source their places name: it is `file`
  std::string variant;              ///< of the workflow, laid over it before the values; empty: none
  YamlPtr changes;                  ///< of that variant when the workflow itself does not have it
};

/// Never throws for what is in the files: it becomes findings.
BaseChain follow_bases(const std::string& yaml_text, const std::string& file_name);

/// A file that builds on no other; `what` it is, for messages: "study".
BaseChain single_file(const std::string& yaml_text, const std::string& file_name, const std::string& what);

/// The content of a file. UserError when there is none, when it cannot be read, or when it is a folder.
std::string read_text(const std::filesystem::path& file);

}  // namespace breccia
