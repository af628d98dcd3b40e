// SPDX-License-Identifier: BSD-3-Clause
// What the core and plugins read texts and write files with.
#include "breccia/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "breccia/atomic_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "breccia-files-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string content(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// What is read from a file with these bytes, or the message without the folder.
  std::string read(const std::string& bytes) const {
    std::ofstream(folder_ / "t", std::ios::binary) << bytes;
    return told([&] { return read_text_file(folder_ / "t"); });
  }
  template <class F>
  std::string told(F&& f) const {
    try {
      return f();
    } catch (const UserError& e) {
      std::string text = e.what();
      const std::string own = folder_.string() + "/";
      if (const auto at = text.find(own); at != text.npos) text.erase(at, own.size());
      return text;
    }
  }
  fs::path folder_;
};

TEST_F(Files, TextsAreReadWhateverSystemMadeThem) {
  EXPECT_EQ(read("a\nb\n"), "a\nb\n");
  EXPECT_EQ(read("\xEF\xBB\xBF"s + "a\r\nb\r\n"), "a\nb\n");
  EXPECT_EQ(read("a\rb\r\r"), "a\nb\n\n");
  EXPECT_EQ(read("gr\xC3\xBCn"), "gr\xC3\xBCn");
  EXPECT_EQ(read(""), "");
}

TEST_F(Files, WhatIsNoTextIsRefusedWithItsPlace) {
  EXPECT_EQ(read("\xFF\xFE"s + "a\0"s), "t:1:1: the file is UTF-16; save it as UTF-8");
  EXPECT_EQ(read("\xFE\xFF"s + "\0a"s), "t:1:1: the file is UTF-16; save it as UTF-8");
  EXPECT_EQ(read("a\0b\0"s), "t:1:1: the file is UTF-16; save it as UTF-8");
  EXPECT_EQ(read("\0a\0b"s), "t:1:1: the file is UTF-16; save it as UTF-8");
  EXPECT_EQ(read("\xFF\xFE\0\0a\0\0\0"s), "t:1:1: the file is UTF-32; save it as UTF-8");
  EXPECT_EQ(read("\0\0\xFE\xFF\0\0\0a"s), "t:1:1: the file is UTF-32; save it as UTF-8");
  EXPECT_EQ(read("a\0\0\0"s), "t:1:1: the file is UTF-32; save it as UTF-8");
  EXPECT_EQ(read("ab\r\n\xC3\xBC\0"s), "t:2:2: a zero byte: the file is not a text in UTF-8");
  EXPECT_EQ(read("ab\r\xFC"), "t:2:1: the text is not UTF-8 here; save the file as UTF-8");
  EXPECT_EQ(read("ab\x1B[31m"), "t:1:3: a control character, which no text has; delete it");
}

TEST_F(Files, WhatCannotBeReadSaysWhy) {
  EXPECT_EQ(told([&] { return read_text_file(folder_ / "none"); }), "cannot read none: no such file");
  fs::create_directory(folder_ / "sub");
  EXPECT_EQ(told([&] { return read_text_file(folder_ / "sub"); }), "cannot read sub: it is a folder");
  EXPECT_EQ(read("abcdef"), "abcdef");
  EXPECT_EQ(read_bytes(folder_ / "t", 2), "ab");
}

TEST_F(Files, EndingsInUpperAndLowerCase) {
  EXPECT_TRUE(has_ending("a.CSV", ".csv"));
  EXPECT_TRUE(has_ending("/b.c/a.Csv", ".csv"));
  EXPECT_FALSE(has_ending("a.csv.gz", ".csv"));
  EXPECT_FALSE(has_ending("csv", ".csv"));
}

TEST_F(Files, NamesThatAreNoTextCanBeShown) {
  EXPECT_EQ(printable("gr\xC3\xBCn\n\t"), "gr\xC3\xBCn\n\t");
  EXPECT_EQ(printable("a\xFF\x1B[31m\r"), "a\\xFF\\x1B[31m\\x0D");
  EXPECT_EQ(valid_utf8("a\xFF\xC3\xBC"), "a\xEF\xBF\xBD\xC3\xBC");
  EXPECT_EQ(json_text({{"name", "a\xFF"}}), "{\"name\":\"a\xEF\xBF\xBD\"}");
}

TEST_F(Files, AWholeFileOrNone) {
  write_file(folder_ / "f", "one");
  EXPECT_EQ(content("f"), "one");
  {
    AtomicFile file(folder_ / "f");
    file.write(std::string(200000, 'x'));
    EXPECT_EQ(content("f"), "one");
  }
  EXPECT_FALSE(fs::exists(folder_ / "f.partial"));
  {
    AtomicFile file(folder_ / "f", true);
    file.write("rows");
  }
  EXPECT_EQ(content("f.partial"), "rows");
  EXPECT_EQ(content("f"), "one");
  EXPECT_EQ(told([&] { return write_file(folder_ / "no/f", ""), ""; }), "cannot write no/f: No such file or directory");
}

/// The device that is always full, and a limit that is reached half-way.
TEST_F(Files, AFullDiskIsToldWithTheReason) {
  write_file(folder_ / "f", "one");
  fs::create_symlink("/dev/full", folder_ / "f.partial");
  EXPECT_EQ(told([&] { return write_file(folder_ / "f", "two"), ""; }), "cannot write f: No space left on device");
  EXPECT_EQ(content("f"), "one");
  EXPECT_FALSE(fs::is_symlink(folder_ / "f.partial"));

  struct rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit low = before;
  low.rlim_cur = 100000;
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
  const std::string text = told([&] { return write_file(folder_ / "f", std::string(150000, 'x')), ""; });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(text, "cannot write f: File too large");
  EXPECT_EQ(content("f"), "one");
  EXPECT_FALSE(fs::exists(folder_ / "f.partial"));
}

}  // namespace
}  // namespace breccia
