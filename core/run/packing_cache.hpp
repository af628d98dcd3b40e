// SPDX-License-Identifier: BSD-3-Clause
/// Packings are kept and used again: by the content of everything that they depend on.
#pragma once

#include <filesystem>

#include "breccia/packing.hpp"
#include "engine/rank_link.hpp"
#include "plugin/registry.hpp"

namespace breccia {

/// $BRECCIA_CACHE, or $XDG_CACHE_HOME/breccia, or ~/.cache/breccia; empty when none can be named.
std::filesystem::path default_cache_folder();

/// On several ranks either the first has all particles, or each has some, one behind the other (`in_pieces`).
struct PackingOutcome {
  PackedParticles particles;
  bool from_cache = false, in_pieces = false;
  std::size_t count = 0;  ///< of all particles
  std::string hash;       ///< content hash of the particles (centres and radii)
};

/// AtPath when that packing cannot make what is asked for.
void refuse_what_cannot_be(const Packing& packing, const std::string& type, const PackingRequest& request);

/// The packing that the workflow asks for. The cache key covers the plugin's file, its configuration, its input files,
/// the seed and the dimension. A cache that cannot be read or written is a warning, never a failure. What ranks can
/// make in shares is quickly made and not kept. `link`: of all ranks, which call this together.
PackingOutcome obtain_packing(const Registry& registry, const PluginChoice& choice, const PackingRequest& request,
                              const std::filesystem::path& cache_folder, Host& host, RankLink* link = nullptr);

}  // namespace breccia
