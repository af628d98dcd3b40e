// SPDX-License-Identifier: BSD-3-Clause
#include "study/input_hash.hpp"

#include "breccia/text_file.hpp"
#include "breccia/utf8.hpp"
#include "config/each_value.hpp"
#include "hash/sha256.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// What was read from a file is what counts, not where it lies.
Json content_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return valid_utf8(file.string());
  return sha256(read_bytes(file));
}

}  // namespace

std::string input_hash(Json config, const Registry& registry) {
  for (const char* key : {"name", "description", "reference", "provenance"}) config.erase(key);
  if (config.contains("plugins") && config["plugins"].empty()) config.erase("plugins");
  each_value(config, workflow_schema(), registry, [](const ParamSpec& spec, const std::string&, Json& value) {
    if (spec.type == ParamType::path) value = content_of(value.get<std::string>());
  });
  return sha256(json_text(config));
}

}  // namespace breccia
