// SPDX-License-Identifier: BSD-3-Clause
#include "ranks/join_ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <filesystem>

#include "breccia/error.hpp"

namespace breccia {
namespace fs = std::filesystem;

namespace {

/// What launchers say of the number of processes that they have started: Open MPI's, and those that speak PMI. Slurm's
/// own number is of the whole allocation, and says nothing of this program.
int ranks_of_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size);
  // srun with PMIx tells the place of a process alone.
  const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  return tasks && (std::getenv("PMIX_RANK") || std::getenv("PMI_RANK")) ? std::atoi(tasks) : 1;
}

}  // namespace

std::unique_ptr<RankLink> join_ranks() {
  const int ranks = ranks_of_launcher();
  if (ranks < 2) return nullptr;
  std::error_code unknown;
  const fs::path program = boost::dll::program_location(unknown).parent_path(),
                 file = (program / "../lib/breccia-core/breccia_ranks_mpi.so").lexically_normal();
  if (!fs::exists(file))
    throw UserError(fmt::format(
        "a launcher has started {} processes for one run, and this program was built without MPI and PETSc: "
        "install them (`tools/packages --mpi`) and build again, or start it by itself",
        ranks));
  void* const opened = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!opened)
    throw UserError(fmt::format("runs on several ranks need {}, which cannot be loaded: {}", file.string(), dlerror()));
  const auto make = reinterpret_cast<RankLink* (*)()>(dlsym(opened, "breccia_join_ranks"));
  BRECCIA_ASSERT(make);
  return std::unique_ptr<RankLink>(make());
}

}  // namespace breccia
