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

  void group(const std::string& path) override { agree(make_group(file_, path), path); }
  void list(const std::string& path, archived::Element element, std::size_t columns, const ListShare& share,
            const void* rows) override {
    const Handle set(made_list(file_, path, element, share.total, columns), H5Dclose);
    agree(set >= 0, path);
    const Hdf5Type type = hdf5_type_of(element);
    const std::size_t row = columns * type.size, at_once = std::max<std::size_t>(1, most_bytes / row);
    unsigned long most = share.rows;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UNSIGNED_LONG, MPI_MAX, comm_);
    const Handle how(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    H5Pset_dxpl_mpio(how, H5FD_MPIO_COLLECTIVE);
    for (std::size_t done = 0; done < most; done += at_once) {
      const std::size_t now = std::min(at_once, share.rows - std::min(done, share.rows));
      agree(put(set, how, type, columns, share.first + done, now, static_cast<const char*>(rows) + done * row), path);
    }
  }
  void close() override {
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
  /// What fails on one fails on all.
  void agree(bool well, const std::string& path) const {
    int all = well;
    MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, comm_);
    if (all) return;
    has_failed = true;
    throw UserError("no checkpoint can be made: " + path + ": HDF5 cannot write it to " + path_);
  }

  std::string path_;
  MPI_Comm comm_;
  hid_t file_ = -1;
  static inline bool has_failed = false;  ///< what it then leaves of a file cannot be closed: not to be gone on with
};

}  // namespace

std::unique_ptr<SharedFile> shared_hdf5(const std::string& path, std::size_t bytes_ahead, MPI_Comm comm) {
  return std::make_unique<SharedHdf5>(path, bytes_ahead, comm);
}

}  // namespace breccia
