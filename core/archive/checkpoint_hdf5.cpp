// SPDX-License-Identifier: BSD-3-Clause
// A library of its own: HDF5 brings some thirty others, which a program that writes no checkpoint need not load.
#include <algorithm>
#include <cstring>

#include "archive/checkpoint_file.hpp"
#include "archive/checkpoint_header.hpp"
#include "archive/checkpoint_names.hpp"
#include "archive/hdf5_tools.hpp"

namespace breccia {
namespace fs = std::filesystem;
using archived::Element;

namespace {

class Writer final : public CheckpointWriter {
 public:
  explicit Writer(std::size_t bytes);  ///< that the file is expected to have
  ~Writer() override;
  void commit(const fs::path& file) override;

 private:
  void write(const std::string& path, Element element, const void* data, std::size_t rows, std::size_t columns,
             std::size_t stride) override;
  std::size_t rows(const std::string&, Element, std::size_t) override { return 0; }
  void read(const std::string&, Element, void*, std::size_t, std::size_t, std::size_t) override {}
  void open(const std::string& group) override;
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override;

  hid_t file_ = -1;
  CheckpointNames names_;
  static inline bool has_failed = false;  ///< what it then leaves of a file cannot be closed: not to be gone on with
};

class Reader final : public CheckpointReader {
 public:
  explicit Reader(fs::path file);
  ~Reader() override;
  const fs::path& file() const override { return path_; }

 private:
  void write(const std::string&, Element, const void*, std::size_t, std::size_t, std::size_t) override {}
  std::size_t rows(const std::string& path, Element element, std::size_t columns) override;
  void read(const std::string& path, Element element, void* data, std::size_t rows, std::size_t columns,
            std::size_t stride) override;
  void open(const std::string&) override {}
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override;

  fs::path path_;
  hid_t file_ = -1;
};

Writer::Writer(std::size_t bytes) {
  if (has_failed) throw UserError("no checkpoint can be made: HDF5 has failed at one before");
  hdf5_is_silent();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const std::size_t grow = std::clamp(bytes / 8, std::size_t(1) << 16, std::size_t(1) << 22);
  // In the oldest format, the library's default: later ones have a checksum over a byte that H5Fget_file_image changes.
  if (H5Pset_fapl_core(access, grow, false) < 0 ||
      (file_ = H5Fcreate(name_of_hdf5_in_memory().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)) < 0)
    throw UserError("no checkpoint can be made: HDF5 refuses a file in memory: is there memory enough?");
}

Writer::~Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

void Writer::refuse(const std::string& path, const std::string& why) const {
  has_failed = true;
  throw UserError("no checkpoint can be made: " + path + ": " + why);
}

void Writer::open(const std::string& group) {
  if (names_.claim(group, false) && !make_group(file_, group)) refuse(group, "the group cannot be made");
}

void Writer::write(const std::string& path, Element element, const void* data, std::size_t rows, std::size_t columns,
                   std::size_t stride) {
  names_.claim(path, true);
  const std::vector<char> packed = packed_rows(data, rows, columns * hdf5_type_of(element).size, stride);
  const Handle set(made_list(file_, path, element, rows, columns), H5Dclose);
  if (set < 0) refuse(path, "HDF5 cannot hold it: is there memory enough?");
  if (rows > 0 && H5Dwrite(set, hdf5_type_of(element).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                           packed.empty() ? data : packed.data()) < 0)
    refuse(path, "HDF5 cannot hold it: is there memory enough?");
}

void Writer::commit(const fs::path& path) {
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) refuse("/", "HDF5 cannot hold it: is there memory enough?");
  const std::vector<char> image = image_of(file_);
  if (image.empty()) refuse("/", "HDF5 gives no file");
  H5Fclose(file_);
  file_ = -1;
  const fs::path arriving = path.string() + ".arriving";
  {
    AtomicFile file(arriving);
    file.write(checkpoint::header_of(checkpoint::digests_of({image.data(), image.size()})));
    file.write({image.data(), image.size()});
    file.commit();
  }
  checkpoint::give_name(arriving, path);
}

Reader::Reader(fs::path file) : path_(std::move(file)) {
  hdf5_is_silent();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_sec2(access);
  H5Pset_file_locking(access, false, true);  // nobody writes to a file that has its name; not all systems have locks
  if ((file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access)) < 0)
    throw UserError("the checkpoint " + path_.string() + " is damaged: HDF5 cannot open it");
}

Reader::~Reader() {
  if (file_ >= 0) H5Fclose(file_);
}

void Reader::refuse(const std::string& path, const std::string& why) const {
  throw UserError("the checkpoint " + path_.string() + " does not fit this program: " + path + ": " + why);
}

std::size_t Reader::rows(const std::string& path, Element element, std::size_t columns) {
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) refuse(path, "is missing");
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  if (H5Tequal(type, hdf5_type_of(element).file) <= 0) refuse(path, "holds numbers of another kind");
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 0 || size[1] != columns)
    refuse(path, "has another shape");
  const auto share = share_of(size[0]);
  if (!share) refuse(path, "has another length");
  return share->rows;
}

void Reader::read(const std::string& path, Element element, void* data, std::size_t rows, std::size_t columns,
                  std::size_t stride) {
  if (rows == 0) return;
  const Hdf5Type type = hdf5_type_of(element);
  const std::size_t row = columns * type.size;
  std::vector<char> packed;
  const bool apart = stride != row && rows > 1;
  if (apart) packed.resize(rows * row);
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle there(H5Dget_space(set), H5Sclose);
  hsize_t total[2] = {0, 1};
  if (set < 0 || H5Sget_simple_extent_dims(there, total, nullptr) < 0) refuse(path, "cannot be read");
  const auto share = share_of(total[0]);
  if (!share || share->rows != rows) refuse(path, "has another length");
  const hsize_t first[2] = {share->first, 0}, size[2] = {rows, columns};
  const Handle here(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
  if (H5Sselect_hyperslab(there, H5S_SELECT_SET, first, nullptr, size, nullptr) < 0 ||
      H5Dread(set, type.memory, here, there, H5P_DEFAULT, apart ? packed.data() : data) < 0)
    refuse(path, "cannot be read");
  if (!apart) return;
  for (std::size_t k = 0; k < rows; ++k)
    std::memcpy(static_cast<char*>(data) + k * stride, packed.data() + k * row, row);
}

}  // namespace
}  // namespace breccia

extern "C" {
__attribute__((visibility("default"))) breccia::CheckpointWriter* breccia_begin_checkpoint(std::size_t bytes) {
  return new breccia::Writer(bytes);
}
__attribute__((visibility("default"))) breccia::CheckpointReader* breccia_read_checkpoint(const char* file) {
  return new breccia::Reader(file);
}
}
