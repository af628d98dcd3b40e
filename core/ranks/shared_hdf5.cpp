// SPDX-License-Identifier: BSD-3-Clause
#include "ranks/shared_hdf5.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "archive/hdf5_tools.hpp"
#include "breccia/error.hpp"

namespace breccia {
namespace {

class SharedHdf5 final : public SharedFile {
 public:
  SharedHdf5(const std::string& path, std::size_t bytes_ahead, MPI_Comm comm) : path_(path), comm_(comm) {
    if (has_failed) throw UserError("no checkpoint can be made: HDF5 has failed at one before");
    hdf5_is_silent();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), kind(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
    H5Pset_all_coll_metadata_ops(access, true);
    H5Pset_coll_metadata_write(access, true);
    H5Pset_userblock(kind, bytes_ahead);
    file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, kind, access);
    agree(file_ >= 0, "/");
  }
  ~SharedHdf5() override {
    if (file_ >= 0 && !has_failed) H5Fclose(file_);
  }

  void group(const std::string& path) override {  // which may have come with a list in it
    agree(H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0 || make_group(file_, path), path);
  }
  void list(const std::string& path, archived::Element element, std::size_t columns, const ListShare& share,
            const void* rows) override {
    const Handle set(made_list(file_, path, element, share.total, columns), H5Dclose);
    const Hdf5Type type = hdf5_type_of(element);
    const std::size_t row = columns * type.size, at_once = std::max<std::size_t>(1, most_bytes / row);
    int rank = 0, ranks = 1;
    MPI_Comm_rank(comm_, &rank);
    MPI_Comm_size(comm_, &ranks);
    // The largest of all: failed, rows, number of a rank that has some, and the same the other way round.
    long most[4] = {set < 0, long(share.rows), share.rows ? rank : -1, share.rows ? -rank : -ranks};
    MPI_Allreduce(MPI_IN_PLACE, most, 4, MPI_LONG, MPI_MAX, comm_);
    agree(most[0] == 0, path, false);
    const Handle how(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    if (most[2] == -most[3]) {  // of one rank alone, as most of them are: nobody waits for it
      if (share.rows) well_ = well_ && put(set, how, type, columns, share.first, share.rows, rows);
      return;
    }
    H5Pset_dxpl_mpio(how, H5FD_MPIO_COLLECTIVE);
    for (std::size_t done = 0; done < std::size_t(most[1]); done += at_once) {
      const std::size_t now = std::min(at_once, share.rows - std::min(done, share.rows));
      well_ =
          put(set, how, type, columns, share.first + done, now, static_cast<const char*>(rows) + done * row) && well_;
    }
    agree(well_, path);
  }
  void close() override {
    agree(well_, "/");
    const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
    agree(flushed, "/");
    const bool closed = H5Fclose(file_) >= 0;
    file_ = -1;
    agree(closed, "/");
    const int opened = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);  // the system of each has what its ranks wrote
    const bool there = opened >= 0 && fsync(opened) == 0;
    if (opened >= 0) ::close(opened);
    agree(there, "/");
  }

 private:
  static constexpr std::size_t most_bytes = std::size_t(1) << 29;  // of one rank: MPI counts in ints

  static bool put(hid_t set, hid_t how, const Hdf5Type& type, std::size_t columns, std::size_t first, std::size_t rows,
                  const void* data) {
    const hsize_t from[2] = {first, 0}, size[2] = {rows, columns};
    const Handle there(H5Dget_space(set), H5Sclose),
        here(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
    if (rows == 0) {
      H5Sselect_none(there);
      H5Sselect_none(here);
    } else if (H5Sselect_hyperslab(there, H5S_SELECT_SET, from, nullptr, size, nullptr) < 0) {
      return false;
    }
    static const char nothing = 0;
    return H5Dwrite(set, type.memory, here, there, how, rows == 0 ? &nothing : data) >= 0;
  }
  /// What fails on one fails on all; `ask`: they do not know of each other yet.
  void agree(bool well, const std::string& path, bool ask = true) const {
    int all = well;
    if (ask) MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm_);
    if (all) return;
    has_failed = true;
    throw UserError("no checkpoint can be made: " + path + ": HDF5 cannot write it to " + path_);
  }

  std::string path_;
  MPI_Comm comm_;
  hid_t file_ = -1;
  bool well_ = true;                      ///< what was written here without asking the others
  static inline bool has_failed = false;  ///< what it then leaves of a file cannot be closed: not to be gone on with
};

}  // namespace

std::unique_ptr<SharedFile> shared_hdf5(const std::string& path, std::size_t bytes_ahead, MPI_Comm comm) {
  return std::make_unique<SharedHdf5>(path, bytes_ahead, comm);
}

}  // namespace breccia
