// SPDX-License-Identifier: BSD-3-Clause
/// A run that begins where another one stood: one specimen, several tests.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "archive/checkpoint_file.hpp"
#include "breccia/packing.hpp"
#include "config/places.hpp"
#include "engine/assembly.hpp"
#include "engine/meeting_parts.hpp"
#include "run/resume.hpp"

namespace breccia {

/// The file that the key names: itself, or the newest checkpoint of the folder of results. AtPath if there is none.
std::filesystem::path checkpoint_of(const std::filesystem::path& file_or_folder);

/// What a run brings that begins from another one's checkpoint.
struct Beginner {
  const Workflow& workflow;
  const Places& places;         ///< of its values
  const std::string& resolved;  ///< its text
  const Json& provenance;
  const PackedParticles& packing;  ///< this rank's piece, and what it is made of
  const Materials& materials;
  const Registry& registry;
  MeetingParts& others;  ///< all ranks compare together, each its part
  bool accept_changes = false;
};

/// The checkpoint that a workflow's `from` names, held against the workflow.
class Branch {
 public:
  /// UserError when the checkpoint cannot be used, or with everything that would have to agree and does not.
  Branch(const Beginner& run, Host& host);

  bool goes_on() const { return goes_on_; }  ///< with the test, else the protocol begins one of its own
  /// The test that goes on had begun to load: what was measured is part of it.
  bool measured() const { return goes_on_ && had_begun_; }
  bool needs_adapting() const { return adapt_; }  ///< of time step and pair list, to other settings or parameters
  Archive& archive() { return *reader_; }
  std::string text() const;                                                     ///< from where, and how, in a line
  const std::vector<std::string>& differences() const { return differences_; }  ///< that may be, a line each

 private:
  void compare(const Beginner& run, Host& host);
  void check_law(const Beginner& run, Host& host);

  std::filesystem::path file_;
  std::unique_ptr<CheckpointReader> reader_;
  CheckpointAbout about_;
  std::vector<std::string> differences_;
  bool goes_on_ = false, had_begun_ = false, adapt_ = false;
  double time_ = 0;  // [s]
  std::uint64_t step_ = 0;
};

}  // namespace breccia
