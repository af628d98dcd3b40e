// SPDX-License-Identifier: BSD-3-Clause
// The link between ranks on MPI; copies follow their owners by PETSc's star forest.
#include <mpi.h>
#include <petscsf.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <thread>

#include "breccia/error.hpp"
#include "engine/rank_link.hpp"
#include "ranks/shared_hdf5.hpp"

namespace breccia {
namespace {

/// Records of one size, as MPI and the star forest move them.
class Records {
 public:
  explicit Records(std::size_t bytes) {
    if (bytes % sizeof(PetscScalar) == 0) MPI_Type_contiguous(int(bytes / sizeof(PetscScalar)), MPIU_SCALAR, &type_);
    else MPI_Type_contiguous(int(bytes), MPI_CHAR, &type_);
    MPI_Type_commit(&type_);
  }
  ~Records() { MPI_Type_free(&type_); }
  Records(const Records&) = delete;
  Records& operator=(const Records&) = delete;
  MPI_Datatype type() const { return type_; }

 private:
  MPI_Datatype type_;
};

/// A mistake in these calls is one in the program.
void must(PetscErrorCode error) { BRECCIA_ASSERT(error == 0); }

class MpiLink final : public RankLink {
 public:
  MpiLink() {
    int given;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");  // the program's own stop a run in order
    must(PetscInitializeNoArguments());
    PetscPopSignalHandler();
    MPI_Comm_dup(MPI_COMM_WORLD, &comm_);
    MPI_Comm_dup(MPI_COMM_WORLD, &ends_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &ranks_);
    MPI_Comm here;
    MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &here_);
    MPI_Comm_free(&here);
    if (const char* text = std::getenv("BRECCIA_IMBALANCE")) tolerated_ = std::atof(text);
    must(PetscSFCreate(comm_, &copies_));
  }
  ~MpiLink() override {
    records_.clear();
    PetscSFDestroy(&copies_);
    PetscFinalize();
    MPI_Comm_free(&comm_);
    MPI_Comm_free(&ends_);
    MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  int ranks_on_machine() const override { return here_; }
  double tolerated_imbalance() const override { return tolerated_; }

  void largest(std::span<double> numbers) override {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), int(numbers.size()), MPI_DOUBLE, MPI_MAX, comm_);
  }
  void add(std::span<std::int64_t> numbers) override {
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), int(numbers.size()), MPI_INT64_T, MPI_SUM, comm_);
  }
  std::vector<std::size_t> numbers_of_all(std::size_t own) override {
    std::vector<std::size_t> all(std::size_t(ranks_), 0);
    static_assert(sizeof(std::size_t) == 8);
    MPI_Allgather(&own, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, comm_);
    return all;
  }
  void gather(const void* own, std::span<const std::size_t> counts, std::size_t record_bytes, void* all,
              bool everywhere) override {
    const std::vector<int> count(counts.begin(), counts.end());
    std::vector<int> start(count.size(), 0);
    for (std::size_t r = 1; r < count.size(); ++r) start[r] = start[r - 1] + count[r - 1];
    const MPI_Datatype type = of_size(record_bytes);
    const int mine = count[std::size_t(rank_)];
    if (everywhere) MPI_Allgatherv(own, mine, type, all, count.data(), start.data(), type, comm_);
    else MPI_Gatherv(own, mine, type, all, count.data(), start.data(), type, 0, comm_);
  }
  std::vector<std::vector<std::byte>> exchange(const std::vector<std::vector<std::byte>>& to,
                                               std::size_t bytes) override {
    const std::size_t n = std::size_t(ranks_);
    std::vector<int> give(n), take(n), give_at(n, 0),
        take_at(n, 0);  // in records: there are more bytes than an int has
    for (std::size_t r = 0; r < n; ++r) give[r] = int(to[r].size() / bytes);
    MPI_Alltoall(give.data(), 1, MPI_INT, take.data(), 1, MPI_INT, comm_);
    for (std::size_t r = 1; r < n; ++r) {
      give_at[r] = give_at[r - 1] + give[r - 1];
      take_at[r] = take_at[r - 1] + take[r - 1];
    }
    std::vector<std::byte> given, taken(std::size_t(take_at.back() + take.back()) * bytes);
    for (const auto& part : to) given.insert(given.end(), part.begin(), part.end());
    const MPI_Datatype type = of_size(bytes);
    MPI_Alltoallv(given.data(), give.data(), give_at.data(), type, taken.data(), take.data(), take_at.data(), type,
                  comm_);
    std::vector<std::vector<std::byte>> from(n);
    auto at = taken.cbegin();
    for (std::size_t r = 0; r < n; ++r) {
      const auto end = at + std::ptrdiff_t(std::size_t(take[r]) * bytes);
      from[r].assign(at, end);
      at = end;
    }
    return from;
  }

  void follow(const Copies& copies) override {
    first_own_ = copies.first_own;
    const std::size_t n = copies.at.size();
    std::vector<PetscInt> here(copies.at.begin(), copies.at.end());
    std::vector<PetscSFNode> there(n);
    for (std::size_t k = 0; k < n; ++k) there[k] = {PetscInt(copies.owner[k]), PetscInt(copies.in_owner[k])};
    must(PetscSFReset(copies_));
    must(PetscSFSetGraph(copies_, PetscInt(copies.own), PetscInt(n), here.data(), PETSC_COPY_VALUES, there.data(),
                         PETSC_COPY_VALUES));
    must(PetscSFSetUp(copies_));
  }
  void begin_forward(void* records, std::size_t bytes) override {
    must(PetscSFBcastBegin(copies_, of_size(bytes), own_of(records, bytes), records, MPI_REPLACE));
  }
  void end_forward(void* records, std::size_t bytes) override {
    must(PetscSFBcastEnd(copies_, of_size(bytes), own_of(records, bytes), records, MPI_REPLACE));
  }

  std::unique_ptr<SharedFile> shared_file(const std::string& path, std::size_t bytes_ahead) override {
    return shared_hdf5(path, bytes_ahead, comm_);
  }

  bool all_end() override {
    MPI_Request all;
    MPI_Ibarrier(ends_, &all);
    using Clock = std::chrono::steady_clock;
    for (const auto until = Clock::now() + std::chrono::seconds(3); Clock::now() < until;) {
      int there = 0;
      MPI_Test(&all, &there, MPI_STATUS_IGNORE);
      if (there) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  void abort(int code) override {
    MPI_Abort(comm_, code);
    std::_Exit(code);
  }

 private:
  MPI_Datatype of_size(std::size_t bytes) { return records_.try_emplace(bytes, bytes).first->second.type(); }
  const void* own_of(const void* records, std::size_t bytes) const {
    return static_cast<const std::byte*>(records) + first_own_ * bytes;
  }

  MPI_Comm comm_, ends_;  ///< the second for those that end: nothing else waits there
  PetscSF copies_;
  std::size_t first_own_ = 0;
  int rank_ = 0, ranks_ = 1, here_ = 1;
  double tolerated_ = RankLink::tolerated_imbalance();
  std::map<std::size_t, Records> records_;
};

}  // namespace
}  // namespace breccia

extern "C" __attribute__((visibility("default"))) breccia::RankLink* breccia_join_ranks() {
  return new breccia::MpiLink;
}
