// SPDX-License-Identifier: BSD-3-Clause
/// The fields of a frame, as those see them who write all of it, or the parts of it.
#pragma once

#include <optional>
#include <vector>

#include "run/listed.hpp"

namespace breccia {

/// Fields are asked for when somebody writes a frame, once. Those of post-processors that see parts are brought
/// together for who writes the whole; those of the others are dealt out to who writes parts. All ranks ask together.
class FrameFields {
 public:
  FrameFields(StepViews& views, std::vector<Listed<Postprocessor>>& postprocessors)
      : views_(views), postprocessors_(postprocessors), given_(postprocessors.size()) {}

  /// With a value for each row of the part's lists, of which those of copies may mean nothing.
  const std::vector<Field>& of_part();
  /// On the first rank, of all that are.
  const std::vector<Field>& of_whole();

 private:
  const std::vector<Field>& given_by(std::size_t postprocessor);
  std::vector<Field> gathered(const std::vector<Field>& of_parts);
  std::vector<Field> dealt(const std::vector<Field>& of_whole);

  StepViews& views_;
  std::vector<Listed<Postprocessor>>& postprocessors_;
  std::vector<std::optional<std::vector<Field>>> given_;
  std::optional<std::vector<Field>> part_, whole_;
};

}  // namespace breccia
