// SPDX-License-Identifier: BSD-3-Clause
// A library of its own: HDF5 brings some thirty others, which a program that writes no checkpoint need not load.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>
#include <span>

#include "archive/checkpoint_file.hpp"
#include "archive/hdf5_tools.hpp"
#include "breccia/atomic_file.hpp"
#include "hash/sha256.hpp"

namespace breccia {
namespace fs = std::filesystem;
using archived::Element;

namespace {

constexpr std::size_t header_size = 512;  // where HDF5 looks for its beginning next, after the very start
constexpr const char* mark = "breccia checkpoint 1";
struct Type {
  hid_t memory, file;
  std::size_t size;
};
Type type_of(Element e) {
  switch (e) {
    case Element::f64:
      return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 8};
    case Element::i32:
      return {H5T_NATIVE_INT32, H5T_STD_I32LE, 4};
    case Element::i64:
      return {H5T_NATIVE_INT64, H5T_STD_I64LE, 8};
    case Element::u32:
      return {H5T_NATIVE_UINT32, H5T_STD_U32LE, 4};
    case Element::u64:
      return {H5T_NATIVE_UINT64, H5T_STD_U64LE, 8};
    case Element::u8:
    case Element::text:
      break;
  }
  return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1};
}

std::string header_of(const std::string& digest) {
  std::string text = std::string(mark) + "\nsha256 " + digest + "\n";
  text.resize(header_size, '\n');
  return text;
}

std::string digest_of(const char* data, std::size_t size) { return sha256(std::string_view(data, size)); }

void reach_the_disk(const fs::path& place, int flags) {
  const int opened = ::open(place.c_str(), flags | O_CLOEXEC);
  if (opened < 0) return;
  const int failed = fsync(opened) != 0 ? errno : 0;
  close(opened);
  if (failed && failed != EINVAL) throw CannotWrite(place, failed);
}

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

  /// Notes what is to be made: false where that group is there. HDF5 would fail at a name that is there twice, and
  /// cannot say that it was only that.
  bool claim(const std::string& path, bool array);

  hid_t file_ = -1;
  std::set<std::string> arrays_, groups_;
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

bool Writer::claim(const std::string& path, bool array) {
  const auto twice = [&] { return UserError("no checkpoint can be made: " + path + ": is there twice"); };
  if (arrays_.contains(path) || (array && groups_.contains(path))) throw twice();
  if (!array && groups_.contains(path)) return false;
  for (std::size_t at = path.find('/', 1); at != path.npos; at = path.find('/', at + 1)) {
    if (arrays_.contains(path.substr(0, at))) throw twice();
    groups_.insert(path.substr(0, at));
  }
  (array ? arrays_ : groups_).insert(path);
  return true;
}

void Writer::open(const std::string& group) {
  if (!claim(group, false)) return;
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  const Handle made(H5Gcreate2(file_, group.c_str(), link, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (made < 0) refuse(group, "the group cannot be made");
}

void Writer::write(const std::string& path, Element element, const void* data, std::size_t rows, std::size_t columns,
                   std::size_t stride) {
  claim(path, true);
  const Type type = type_of(element);
  const std::size_t row = columns * type.size;
  std::vector<char> packed;
  if (stride != row && rows > 1) {
    packed.resize(rows * row);
    for (std::size_t k = 0; k < rows; ++k)
      std::memcpy(packed.data() + k * row, static_cast<const char*>(data) + k * stride, row);
    data = packed.data();
  }
  const hsize_t size[2] = {rows, columns};
  const int rank = columns == 1 ? 1 : 2;
  const Handle space(H5Screate_simple(rank, size, nullptr), H5Sclose);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (rows > 64) {  // a checksum of its own, which any reader of HDF5 looks at
    const hsize_t chunk[2] = {std::min<hsize_t>(rows, std::max<hsize_t>(1, (1u << 20) / row)), columns};
    H5Pset_chunk(how, rank, chunk);
    H5Pset_fletcher32(how);
  }
  H5Pset_obj_track_times(how, false);  // the same state, the same bytes
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  const Handle set(H5Dcreate2(file_, path.c_str(), type.file, space, link, how, H5P_DEFAULT), H5Dclose);
  if (set < 0) refuse(path, "HDF5 cannot hold it: is there memory enough?");
  if (rows > 0 && H5Dwrite(set, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
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
    file.write(header_of(digest_of(image.data(), image.size())));
    file.write({image.data(), image.size()});
    file.commit();
  }
  try {
    reach_the_disk(arriving, O_RDONLY);
    fs::rename(arriving, path);
    reach_the_disk(path.parent_path(), O_RDONLY | O_DIRECTORY);
  } catch (const fs::filesystem_error& e) {
    fs::remove(arriving);
    throw CannotWrite(path, e.code().value());
  } catch (...) {
    fs::remove(arriving);
    throw;
  }
}

Reader::Reader(fs::path file) : path_(std::move(file)) {
  hdf5_is_silent();
  std::vector<char> image;
  std::ifstream in(path_, std::ios::binary);
  if (!in) throw UserError("cannot read the checkpoint " + path_.string());
  std::error_code unknown;
  const auto size = fs::file_size(path_, unknown);
  image.resize(unknown ? 0 : std::size_t(size));
  if (!in.read(image.data(), std::streamsize(image.size())))
    throw UserError("cannot read the checkpoint " + path_.string());
  const auto damaged = [&](const char* why) {
    return UserError("the checkpoint " + path_.string() + " is damaged: " + why);
  };
  if (image.size() < header_size || std::memcmp(image.data(), "breccia checkpoint ", 19) != 0)
    throw UserError(path_.string() + " is no checkpoint of Breccia");
  const std::string header(image.data(), header_size);
  image.erase(image.begin(), image.begin() + header_size);
  if (!header.starts_with(std::string(mark) + "\n"))
    throw UserError("the checkpoint " + path_.string() + " has the format `" + header.substr(0, header.find('\n')) +
                    "`, this program reads `" + mark + "`");
  if (header != header_of(digest_of(image.data(), image.size())))
    throw damaged("its bytes do not add up to what its beginning says");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access, std::size_t(1) << 22, false) < 0 ||
      H5Pset_file_image(access, image.data(), image.size()) < 0 ||
      (file_ = H5Fopen(name_of_hdf5_in_memory().c_str(), H5F_ACC_RDONLY, access)) < 0)
    throw damaged("HDF5 cannot open it");
  image = {};  // the library has a copy
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
  if (H5Tequal(type, type_of(element).file) <= 0) refuse(path, "holds numbers of another kind");
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 0 || size[1] != columns)
    refuse(path, "has another shape");
  return size[0];
}

void Reader::read(const std::string& path, Element element, void* data, std::size_t rows, std::size_t columns,
                  std::size_t stride) {
  if (rows == 0) return;
  const Type type = type_of(element);
  const std::size_t row = columns * type.size;
  std::vector<char> packed;
  const bool apart = stride != row && rows > 1;
  if (apart) packed.resize(rows * row);
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0 || H5Dread(set, type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, apart ? packed.data() : data) < 0)
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
