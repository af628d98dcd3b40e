// SPDX-License-Identifier: BSD-3-Clause
/// What the bytes of a checkpoint add up to, found by several ranks together.
#pragma once

#include <optional>
#include <string>

#include "archive/checkpoint_header.hpp"
#include "engine/rank_link.hpp"

namespace breccia::checkpoint {

/// Of the blocks of a file of so many bytes that are this rank's to look at (null: all). None when it cannot be read.
std::optional<std::string> own_digests(const std::filesystem::path& file, std::size_t bytes, RankLink* link);
/// Those of all ranks, one after the other: on the first, or everywhere.
std::string of_all(const std::string& own, RankLink& link, bool everywhere);

}  // namespace breccia::checkpoint
