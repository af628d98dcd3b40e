// SPDX-License-Identifier: BSD-3-Clause
#include "archive/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "archive/checkpoint_digest.hpp"
#include "archive/hdf5_library.hpp"

namespace breccia {
namespace fs = std::filesystem;

std::unique_ptr<CheckpointWriter> begin_checkpoint(std::size_t bytes) {
  hdf5_needs_memory(bytes);
  return std::unique_ptr<CheckpointWriter>(
      hdf5_function<CheckpointWriter*(std::size_t)>("breccia_begin_checkpoint")(bytes));
}

namespace {

/// Why a file is not to be read; empty when it may be. Of several ranks each looks at its share of the bytes, and all
/// of them tell each other what they have found.
std::string doubt_about(const fs::path& file, RankLink* link) {
  using namespace checkpoint;
  const std::string name = "the checkpoint " + file.string();
  std::string header(header_size, '\0'), digests, doubt;
  std::ifstream in(file, std::ios::binary);
  std::error_code unknown;
  const auto bytes = fs::file_size(file, unknown);
  if (!in || unknown) doubt = "cannot read " + name;
  else if (!in.read(header.data(), header_size) || !header.starts_with(any_mark))
    doubt = file.string() + " is no checkpoint of Breccia";
  else if (!header.starts_with(std::string(mark) + "\n"))
    doubt = name + " has the format `" + header.substr(0, header.find('\n')) + "`, this program reads `" + mark + "`";
  else if (const auto own = own_digests(file, std::size_t(bytes), link)) digests = *own;
  else doubt = "cannot read " + name;
  if (link) {
    if (link->any(!doubt.empty())) return doubt.empty() ? "another rank cannot read " + name : doubt;
    digests = of_all(digests, *link, true);
  }
  if (doubt.empty() && header != header_of(digests))
    doubt = name + " is damaged: its bytes do not add up to what its beginning says";
  return doubt;
}

}  // namespace

std::unique_ptr<CheckpointReader> read_checkpoint(const fs::path& file, RankLink* link) {
  const std::string doubt = doubt_about(file, link);
  if (any_rank(link, !doubt.empty())) throw UserError(doubt);
  hdf5_needs_memory(0);
  return std::unique_ptr<CheckpointReader>(
      hdf5_function<CheckpointReader*(const char*)>("breccia_read_checkpoint")(file.c_str()));
}

std::string checkpoint_name(std::uint64_t step) { return fmt::format("step_{:012}.h5", step); }

std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".h5")) found.push_back(at->path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

}  // namespace breccia
