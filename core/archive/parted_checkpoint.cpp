// SPDX-License-Identifier: BSD-3-Clause
// The checkpoint of a specimen in parts. Lists are written by all ranks as they come; what is the same on all, or known
// to the first alone, it keeps until the end, when the others are told what there is.
#include <sys/statvfs.h>

#include <exception>
#include <sstream>

#include "archive/checkpoint_digest.hpp"
#include "archive/checkpoint_file.hpp"
#include "archive/checkpoint_names.hpp"

namespace breccia {
namespace fs = std::filesystem;
using archived::Element;

namespace {

/// So many bytes can be written under this name, and then are not there: HDF5 does not survive a disk that is full.
void expect_room(const fs::path& file, std::size_t bytes) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (opened < 0) throw CannotWrite(file, errno);
  int failed = 0;
  if (fallocate(opened, 0, 0, off_t(bytes)) != 0) failed = errno;
  if (failed == EOPNOTSUPP || failed == ENOSYS) {
    struct statvfs there;
    const bool known = fstatvfs(opened, &there) == 0;
    failed = known && std::size_t(there.f_bavail) * there.f_frsize < bytes ? ENOSPC : 0;
  }
  close(opened);
  unlink(file.c_str());
  if (failed) throw CannotWrite(file, failed);
}

class PartedWriter final : public CheckpointWriter, public SharedLists {
 public:
  PartedWriter(RankLink& link, const fs::path& file, std::size_t bytes)
      : link_(link), arriving_(file.string() + ".arriving") {
    first_does([&] { expect_room(arriving_, bytes); });
    try {
      file_ = link.shared_file(arriving_.string(), checkpoint::header_size);
    } catch (...) {
      remove();
      throw;
    }
  }
  ~PartedWriter() override {
    file_.reset();
    remove();
  }
  void commit(const fs::path& file) override;

 private:
  struct Kept {
    std::string path;
    Element element;
    std::size_t rows, columns;  ///< no columns: a group
    std::vector<char> bytes;
  };

  void write(const std::string& path, Element element, const void* data, std::size_t rows, std::size_t columns,
             std::size_t stride) override;
  std::size_t rows(const std::string&, Element, std::size_t) override { return 0; }
  void read(const std::string&, Element, void*, std::size_t, std::size_t, std::size_t) override {}
  void open(const std::string& group) override {
    if (link_.first() && names_.claim(group, false)) kept_.push_back({group, Element::u8, 0, 0, {}});
  }
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override {
    throw UserError("no checkpoint can be made: " + path + ": " + why);
  }

  static std::size_t size_of(Element e) {
    return e == Element::u8 || e == Element::text ? 1 : e == Element::i32 || e == Element::u32 ? 4 : 8;
  }
  /// Where it has not got its name.
  void remove() const {
    if (link_.first()) unlink(arriving_.c_str());
  }
  void write_kept();
  std::string shapes_of_kept() const;
  /// What only the first does; where it fails, none of them goes on.
  template <class F>
  void first_does(F&& f) const {
    std::exception_ptr failed;
    try {
      if (link_.first()) f();
    } catch (const UserError&) { failed = std::current_exception(); }
    const bool any = link_.any(failed != nullptr);
    if (failed) std::rethrow_exception(failed);
    if (any) throw UserError("the first rank cannot write the checkpoint");
  }

  RankLink& link_;
  fs::path arriving_;
  std::unique_ptr<SharedFile> file_;
  CheckpointNames names_;
  std::vector<Kept> kept_;
};

void PartedWriter::write(const std::string& path, Element element, const void* data, std::size_t rows,
                         std::size_t columns, std::size_t stride) {
  const std::size_t row = columns * size_of(element);
  if (share()) {
    const std::vector<char> packed = packed_rows(data, rows, row, stride);
    first_does([&] { names_.claim(path, true); });
    return file_->list(path, element, columns, *share(), packed.empty() ? data : packed.data());
  }
  if (!link_.first()) return;
  names_.claim(path, true);
  kept_.push_back({path, element, rows, columns, packed_rows(data, rows, row, stride)});
  auto& bytes = kept_.back().bytes;
  if (bytes.empty() && rows > 0)
    bytes.assign(static_cast<const char*>(data), static_cast<const char*>(data) + rows * row);
}

std::string PartedWriter::shapes_of_kept() const {
  std::ostringstream text;
  for (const Kept& k : kept_) text << int(k.element) << ' ' << k.rows << ' ' << k.columns << ' ' << k.path << '\0';
  return text.str();
}

void PartedWriter::write_kept() {
  const std::string mine = shapes_of_kept();
  const auto sizes = link_.numbers_of_all(link_.first() ? mine.size() : 0);
  std::string all(sizes.front(), '\0');
  link_.gather(mine.data(), sizes, 1, all.data(), true);
  std::istringstream text(all);
  std::size_t at = 0;
  for (std::string line; std::getline(text, line, '\0'); ++at) {
    std::istringstream words(line);
    int element = 0;
    ListShare share;
    std::size_t columns = 0;
    words >> element >> share.total >> columns;
    words.ignore();
    std::string path;
    std::getline(words, path, '\0');
    share.rows = link_.first() ? share.total : 0;
    if (columns == 0) file_->group(path);
    else file_->list(path, Element(element), columns, share, link_.first() ? kept_[at].bytes.data() : nullptr);
  }
}

void PartedWriter::commit(const fs::path& file) {
  write_kept();
  file_->close();
  file_.reset();
  std::error_code unknown;
  const auto bytes = fs::file_size(arriving_, unknown);
  const auto own = unknown ? std::nullopt : checkpoint::own_digests(arriving_, std::size_t(bytes), &link_);
  if (link_.any(!own)) throw UserError("cannot read what was written to " + arriving_.string());
  const std::string digests = checkpoint::of_all(*own, link_, false);
  first_does([&] {
    const std::string header = checkpoint::header_of(digests);
    const int opened = ::open(arriving_.c_str(), O_WRONLY | O_CLOEXEC);
    if (opened < 0) throw CannotWrite(arriving_, errno);
    const bool written = pwrite(opened, header.data(), header.size(), 0) == ssize_t(header.size());
    const int failed = errno;
    close(opened);
    if (!written) throw CannotWrite(arriving_, failed);
    checkpoint::give_name(arriving_, file);
  });
}

}  // namespace

std::unique_ptr<CheckpointWriter> begin_checkpoint(RankLink& link, const fs::path& file, std::size_t bytes) {
  return std::make_unique<PartedWriter>(link, file, bytes);
}

}  // namespace breccia
