// SPDX-License-Identifier: BSD-3-Clause
/// What stands in a checkpoint that is whole, but of another program: a list of what is written, and one of what is
/// then read back.
#include "archive/checkpoint_file.hpp"
#include "fuzz.hpp"
#include "script.hpp"

namespace breccia {
namespace {

using fuzz::Script;

struct Record {
  double x = 0;
  std::uint32_t n = 0;
};
struct Nested {
  std::uint64_t size = 0;
  std::string text;
  void archive(Archive& archive) {
    archive("size", size);  // called as the length of a list is
    archive("0", text);
  }
};

template <class T>
std::vector<T> some(std::size_t n, const T& value = {}) {
  return std::vector<T>(n, value);
}

/// One value of a type, a name and a length that the script gives: written, or read over what it is.
void one(Archive& archive, Script& script) {
  constexpr const char* names[] = {"a", "b", "a/size", "a/0"};
  const auto op = script.next<std::uint8_t>();
  const std::string name = names[op >> 6];
  const std::size_t n = script.next<std::uint8_t>();
  const auto give = [&](auto value) { archive(name, value); };
  switch (op % 16) {
    case 0:
      return give(script.next<double>());
    case 1:
      return give(script.next<std::uint64_t>());
    case 2:
      return give(script.next<std::int32_t>());
    case 3:
      return give(std::string(n, 't'));
    case 4:
      return give(some<double>(n, 0.5));
    case 5:
      return give(some<Vec3>(n, Vec3::Zero()));
    case 6:
      return give(some<std::string>(n % 4, "text"));
    case 7:
      return give(some<std::vector<int>>(n % 4, {1, 2}));
    case 8:
      return give(n % 2 ? std::optional<double>(1.5) : std::nullopt);
    case 9:
      return give(some<Record>(n));
    case 10:
      return give(Record());
    case 11:
      return give(Nested{script.next<std::uint64_t>(), "text"});
    case 12:
      return give(some<Nested>(n % 4));
    case 13: {
      std::vector<Record> all(n);
      return archive.records(name, all, std::pair("x", &Record::x), std::pair("n", &Record::n));
    }
    case 14: {
      std::vector<double> all(n);
      return archive(name, Strided<double>(all));
    }
    default:
      return give(n % 2 == 1);
  }
}

void write_and_read(Script script) {
  const auto wanted = script.next<std::uint8_t>() % 8;
  bool is_written = true;
  {
    const auto writer = begin_checkpoint();
    for (int k = 0; k <= wanted && !script.ended(); ++k)
      is_written = fuzz::is_read([&] { one(*writer, script); }) && is_written;
    if (is_written) writer->commit("fuzzed.h5");
  }
  if (!is_written) return;
  const auto reader = read_checkpoint("fuzzed.h5");
  for (int k = 0; k < 16 && !script.ended(); ++k) fuzz::is_read([&] { one(*reader, script); });
}

}  // namespace
}  // namespace breccia

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  write_and_read(fuzz::Script(fuzz::text(data, size)));
  return 0;
}
