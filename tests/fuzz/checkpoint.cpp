// SPDX-License-Identifier: BSD-3-Clause
/// Damaged checkpoints. The first byte says what the others are: a file, or changes to a sound file, of which every one
/// must be noticed.
#include "archive/checkpoint_file.hpp"
#include "breccia/text_file.hpp"
#include "fuzz.hpp"
#include "script.hpp"

namespace breccia {
namespace {

constexpr const char* file = "fuzzed.h5";
using fuzz::Script;

const std::string& sound_file() {
  static const std::string bytes = [] {
    const auto writer = begin_checkpoint();
    std::vector<double> column(100, 0.5);
    std::string text = "a workflow";
    (*writer)("column", column);
    (*writer)("text", text);
    writer->commit("sound.h5");
    return read_bytes("sound.h5");
  }();
  return bytes;
}

void damage(Script script) {
  std::string bytes = sound_file();
  if (const auto cut = script.next<std::uint16_t>(); cut < bytes.size()) bytes.resize(cut);
  while (!script.ended() && !bytes.empty()) {
    const auto at = script.next<std::uint16_t>();
    bytes[at % bytes.size()] = char(bytes[at % bytes.size()] ^ script.next<char>());
  }
  fuzz::write(file, bytes);
  const bool is_sound = fuzz::is_read([] { read_checkpoint(file); });
  if (is_sound != (bytes == sound_file())) fuzz::fail("a damaged checkpoint was taken, or a sound one refused");
}

}  // namespace
}  // namespace breccia

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace breccia;
  fuzz::Script script(fuzz::text(data, size));
  if (script.next<std::uint8_t>() % 2 == 0) {
    fuzz::write(file, script.rest());
    fuzz::is_read([] { read_checkpoint(file); });
  } else {
    damage(script);
  }
  return 0;
}
