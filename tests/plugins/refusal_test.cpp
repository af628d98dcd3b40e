// SPDX-License-Identifier: BSD-3-Clause
/// What the handshake refuses, before any code of the plugin runs.
#include <sys/stat.h>

#include <cstddef>

#include "breccia/plugin.hpp"
#include "fixture.hpp"
#include "plugin/registry.hpp"

namespace breccia::test {

class Refusal : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv(ran); }

  /// The message for the law of this name, with FILE for where it lies.
  std::string of_law(const std::string& name) {
    const std::string file = (folder / ("breccia_contact_law." + name + ".so")).string();
    std::string text = refusal([&] { Registry({{folder.path(), ""}}).documentation("contact_law", name); });
    for (std::size_t at; (at = text.find(file)) != std::string::npos;) text.replace(at, file.size(), "FILE");
    return text;
  }
  /// ... for a file of these bytes. Its code must not have run.
  std::string of(const std::string& bytes, const std::string& name = "telltale") {
    write(folder / ("breccia_contact_law." + name + ".so"), bytes);
    const std::string text = of_law(name);
    EXPECT_EQ(std::getenv(ran), nullptr) << "its code ran";
    return text;
  }
  /// The telltale plugin with one number of its descriptor overwritten.
  static std::string with_number(std::size_t offset, std::uint32_t value) {
    std::string bytes = built("telltale");
    const std::size_t at = bytes.find(std::string("BRECCIA\0", 8));
    EXPECT_NE(at, std::string::npos);
    bytes.replace(at + offset, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
  }
  /// ... with a text overwritten by one that is no longer.
  static std::string with_text(const std::string& old, std::string text) {
    std::string bytes = built("telltale");
    const std::size_t at = bytes.find('\0' + old + '\0') + 1;
    EXPECT_NE(at, std::string::npos + 1);
    text.resize(old.size());
    return bytes.replace(at, old.size(), text);
  }

  static constexpr const char* ran = "BRECCIA_TEST_PLUGIN_CODE_RAN";
  static inline const std::string rebuild = ": rebuild the plugin against this Breccia's SDK";
  Folder folder;
};

TEST_F(Refusal, TheTelltaleTells) {  // or all the others could not fail
  write(folder / "breccia_contact_law.telltale.so", built("telltale"));
  EXPECT_EQ(of_law("telltale"),
            "contact_law `telltale` gave no factory (plugin FILE): a fault of the plugin, tell its "
            "author");
  EXPECT_STREQ(std::getenv(ran), "yes");
}

TEST_F(Refusal, InspectionReadsTheDescriptorWithoutRunningCode) {
  const PluginInfo info = inspect_plugin(write(folder / "x", built("telltale")));
  EXPECT_EQ(info.key, (PluginKey{"contact_law", "telltale"}));
  EXPECT_EQ(info.version, "2.5");  // referred to through a symbol
  EXPECT_EQ(std::getenv(ran), nullptr);
}

#if BRECCIA_PACKED_RELOCATIONS
TEST_F(Refusal, InspectionReadsPackedRelocations) {
  const PluginInfo info = inspect_plugin(write(folder / "x", built("packed_relocations")));
  EXPECT_EQ(info.key, (PluginKey{"contact_law", "telltale"}));
  EXPECT_EQ(info.version, "2.5");
}
#endif

TEST_F(Refusal, WrongMagic) {
  const std::string text =
      " has a `breccia_plugin` that is not a Breccia descriptor: declare the plugin with "
      "BRECCIA_PLUGIN or BRECCIA_CONTACT_LAW";
  EXPECT_EQ(of(with_number(0, 0x44414221)), "plugin FILE" + text);
  EXPECT_EQ(of(built("small_symbol")), "plugin FILE" + text);
}

TEST_F(Refusal, WrongSdkAbi) {
  EXPECT_EQ(of(with_number(offsetof(BrecciaPluginDescriptor, sdk_abi), 4000)),
            "plugin FILE has SDK ABI 4000, this program needs " + std::to_string(BRECCIA_SDK_ABI) + rebuild);
}

TEST_F(Refusal, WrongDescriptorSize) {
  EXPECT_EQ(of(with_number(offsetof(BrecciaPluginDescriptor, descriptor_size), 32)),
            "plugin FILE has a descriptor of 32 bytes, this program needs " +
                std::to_string(sizeof(BrecciaPluginDescriptor)) + " bytes" + rebuild);
}

TEST_F(Refusal, WrongCompiler) {
  EXPECT_EQ(of(with_text(BRECCIA_COMPILER_ABI, "gxx-abi-7")),
            "plugin FILE has the compiler `gxx-abi-7`, this program needs `" BRECCIA_COMPILER_ABI "`" + rebuild);
}

TEST_F(Refusal, WrongStandardLibrary) {
  EXPECT_EQ(of(with_text(BRECCIA_STDLIB_ABI, "libother-1")),
            "plugin FILE has the standard library `libother-1`, this program needs `" BRECCIA_STDLIB_ABI "`" + rebuild);
}

TEST_F(Refusal, WrongSizesOfSharedTypes) {
  using D = BrecciaPluginDescriptor;
  const auto expected = [&](const std::string& type, std::size_t needed) {
    return "plugin FILE has " + type + " of 7 bytes, this program needs " + std::to_string(needed) + " bytes" + rebuild;
  };
  std::string text = of(with_number(offsetof(D, size_of_json), 7));
  EXPECT_EQ(text, expected("JSON values", sizeof(Json)));
  text = of(with_number(offsetof(D, size_of_string), 7));
  EXPECT_EQ(text, expected("strings", sizeof(std::string)));
  text = of(with_number(offsetof(D, size_of_vec3), 7));
  EXPECT_EQ(text, expected("vectors", sizeof(Vec3)));
  text = of(with_number(offsetof(D, size_of_param_spec), 7));
  EXPECT_EQ(text, expected("parameter specifications", sizeof(ParamSpec)));
}

TEST_F(Refusal, UnknownKind) {
  EXPECT_EQ(of(with_text("contact_law", "magic")),
            "plugin FILE is of the kind `magic`, which this program does not know; it knows: packing, "
            "contact_law, protocol, postprocessor, output, renderer, search");
}

TEST_F(Refusal, NoNameAndNoFactory) {
  EXPECT_EQ(of(with_text("telltale", "")), "plugin FILE has no name in its descriptor");
  EXPECT_EQ(of(built("no_factory")),
            "plugin FILE has no factory in its descriptor: declare the plugin with "
            "BRECCIA_PLUGIN or BRECCIA_CONTACT_LAW");
}

TEST_F(Refusal, AFileNameThatSaysSomethingElse) {
  EXPECT_EQ(of(built("telltale"), "other"),
            "plugin FILE holds contact_law `telltale`, which its file name does not say: name it "
            "breccia_contact_law.telltale.so");
  EXPECT_EQ(of(built("tiny_packing"), "tiny"),
            "plugin FILE holds packing `tiny`, which its file name does not say: name it "
            "breccia_packing.tiny.so");
}

TEST_F(Refusal, ALibraryThatIsNoPlugin) {
  EXPECT_EQ(of(built("other_symbol")),
            "FILE is not a Breccia plugin: it does not export `breccia_plugin`; end its source with BRECCIA_PLUGIN or "
            "BRECCIA_CONTACT_LAW");
}

TEST_F(Refusal, AnUndefinedSymbolIsNamedAsItsAuthorWroteIt) {
  const std::string text = of(built("undefined"), "undefined");
  EXPECT_NE(text.find("plugin FILE cannot be loaded: "), std::string::npos) << text;
  EXPECT_NE(text.find("undefined symbol: elsewhere::nobody_wrote_this(int)"), std::string::npos) << text;
  EXPECT_NE(text.find("; install or link what it needs, or build it again"), std::string::npos) << text;
}

TEST_F(Refusal, NotALibrary) {
  EXPECT_EQ(of("contact_law: hertz\n"), "FILE is not a shared library: it does not begin like one (ELF)");
  EXPECT_EQ(of(""), "FILE is empty; copy or build it again");
  std::string object = built("telltale");
  object[16] = 1;  // e_type = ET_REL
  EXPECT_EQ(of(object), "FILE is not a shared library but an object file or a program");
  std::string foreign = built("telltale");
  foreign[4] = 1;  // ELFCLASS32
  EXPECT_NE(of(foreign).find("FILE was built for another machine; this one is "), std::string::npos);
  foreign = built("telltale");
  foreign[18] = 2;  // EM_SPARC
  EXPECT_NE(of(foreign).find("FILE was built for another machine; this one is "), std::string::npos);
}

TEST_F(Refusal, AFileCutShortAnywhere) {
  const std::string whole = built("telltale");
  const auto size = whole.size();
  for (const std::size_t length : {std::size_t(5), std::size_t(63), std::size_t(64), std::size_t(1000), size / 4,
                                   size / 2, 3 * size / 4, size - 4096, size - 64, size - 1}) {
    const std::string text = of(whole.substr(0, length));
    EXPECT_NE(text.find("FILE is incomplete: it has " + std::to_string(length) + " bytes and its own headers need "),
              std::string::npos)
        << text;
  }
}

TEST_F(Refusal, AFileWithALostTail) {  // as an interrupted copy into a preallocated file leaves it
  std::string bytes = built("telltale");
  std::fill(bytes.begin() + std::ptrdiff_t(bytes.size() / 2), bytes.end(), '\0');
  EXPECT_EQ(of(bytes), "FILE is damaged: its headers make no sense; copy or build it again");
}

TEST_F(Refusal, DamagedHeadersNeverCrash) {
  const std::string whole = built("telltale");
  for (std::size_t at = 0; at < 64 + 56 * 4; ++at)
    for (const char value : {'\x00', '\x7f', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = value;
      try {
        inspect_plugin(write(folder / "damaged.so", bytes));
      } catch (const UserError&) {}
    }
  EXPECT_EQ(std::getenv(ran), nullptr);
}

TEST_F(Refusal, WhatCannotBeRead) {
  const auto path = [&](const std::string& name) { return folder / ("breccia_contact_law." + name + ".so"); };
  fs::create_directory(path("folder"));
  EXPECT_EQ(of_law("folder"), "plugin FILE cannot be read: it is a folder");
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(of_law("pipe"), "plugin FILE cannot be read: it is not an ordinary file");
  fs::create_symlink(folder / "nowhere", path("dangling"));
  EXPECT_EQ(of_law("dangling"), "plugin FILE cannot be read: there is no such file");
  fs::create_symlink(path("loop"), path("loop"));
  EXPECT_EQ(of_law("loop"), "plugin FILE cannot be read: Too many levels of symbolic links");
  // An ordinary file that nobody can read at its beginning, whatever rights he has: the memory at address zero.
  fs::create_symlink("/proc/self/mem", path("unreadable"));
  EXPECT_EQ(of_law("unreadable"), "plugin FILE cannot be read: Input/output error");
}

TEST_F(Refusal, AFullListingTellsAllThatIsWrong) {
  write(folder / "breccia_contact_law.tiny.so", built("tiny_contact_law"));
  const fs::path text = write(folder / "breccia_output.text.so", "text");
  const fs::path kind = write(folder / "breccia_magic.wand.so", built("tiny_packing"));
  const auto problems = Registry({{folder.path(), ""}}).problems();
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].file, kind);
  EXPECT_NE(problems[0].text.find("name it breccia_packing.tiny.so"), std::string::npos);
  EXPECT_EQ(problems[1].file, text);
  EXPECT_NE(problems[1].text.find("is not a shared library"), std::string::npos);
}

}  // namespace breccia::test
