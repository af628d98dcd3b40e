// SPDX-License-Identifier: BSD-3-Clause
/// Numbers in the JSON Schema, with their units and bounds.
#pragma once

#include <string>
#include <utility>

#include "breccia/schema.hpp"

namespace breccia {

/// What a schema refers to by its name, each written once.
class SchemaDefinitions {
 public:
  /// `make` is called when the name is asked for the first time.
  template <class Make>
  Json ref(const std::string& name, Make&& make) {
    if (!all_.contains(name)) {
      all_[name] = true;  // for what refers to itself
      Json made = make();
      all_[name] = std::move(made);
    }
    return {{"$ref", "#/definitions/" + name}};
  }
  const Json& all() const { return all_; }

 private:
  Json all_ = Json::object();
};

/// A quantity as it is written: a text with a unit of its dimension, or a number where it is a pure one. Of bounds it
/// says what does not depend on the unit: the sign, all bounds of a plain number, and that a share is no more than 100
/// %.
Json quantity_schema(const ParamSpec& spec, SchemaDefinitions& definitions);

Json integer_schema(const ParamSpec& spec, SchemaDefinitions& definitions);

}  // namespace breccia
