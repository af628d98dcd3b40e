// SPDX-License-Identifier: BSD-3-Clause
/// One registry, the same verbs for every kind.
#include "plugin/registry.hpp"

#include "breccia/contact_law.hpp"
#include "breccia/output.hpp"
#include "breccia/packing.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/renderer.hpp"
#include "fixture.hpp"
#include "hash/sha256.hpp"

namespace breccia::test {

class RegistryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const std::string& kind : plugin_kinds())
      write(folder / plugin_file_name({kind, "tiny"}), built("tiny_" + kind));
  }
  Folder folder;
  PluginChoice tiny(double size) { return {"tiny", {{"size", size}}}; }
};

TEST_F(RegistryTest, FindsEveryKindByFileName) {
  const Registry registry({{folder.path(), ""}});
  EXPECT_EQ(registry.kinds(),
            (std::vector<std::string>{"packing", "contact_law", "protocol", "postprocessor", "output", "renderer", "search"}));
  for (const std::string& kind : registry.kinds()) EXPECT_EQ(registry.names(kind), std::vector<std::string>{"tiny"});
  EXPECT_TRUE(registry.warnings().empty());
  EXPECT_TRUE(registry.problems().empty());
}

TEST_F(RegistryTest, NamesAreKnownWithoutOpeningAFile) {
  write(folder / "breccia_contact_law.rubbish.so", "not a library");
  const Registry registry({{folder.path(), ""}});
  EXPECT_EQ(registry.names("contact_law"), (std::vector<std::string>{"rubbish", "tiny"}));
}

TEST_F(RegistryTest, MakesAWorkingPluginOfEachKind) {
  const Registry registry({{folder.path(), ""}});
  SilentHost host;
  EXPECT_EQ(registry.create<Packing>(tiny(3))->generate({}, host).radius, std::vector<double>{3});
  double stored = 0;
  registry.create<ContactLaw>(tiny(4))->energy({}, nullptr, &stored);
  EXPECT_EQ(stored, 4);
  EXPECT_EQ(registry.create<Protocol>(tiny(4))->share_done(), 0.25);
  EXPECT_EQ(registry.create<Output>(tiny(5))->interval(), 5);
  EXPECT_EQ(registry.create<Renderer>(tiny(6))->render({"a", "b"}, host).at(0), fs::path("b/tiny.png"));
  std::vector<Field> fields;
  registry.create<Postprocessor>(tiny(7))->fields({}, fields);
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0].values, std::vector<double>{7});
}

TEST_F(RegistryTest, APluginOutlivesItsRegistry) {
  std::unique_ptr<ContactLaw> law;
  {
    const Registry registry({{folder.path(), ""}});
    law = registry.create<ContactLaw>(tiny(8));
  }
  double stored = 0;
  law->energy({}, nullptr, &stored);
  EXPECT_EQ(stored, 8);
}

TEST_F(RegistryTest, TellsWhatThePluginDocuments) {
  const Registry registry({{folder.path(), ""}});
  const Documentation& doc = registry.documentation("protocol", "tiny");
  EXPECT_EQ(doc.summary, "tiny tiny");
  ASSERT_EQ(doc.root.members.size(), 1u);
  EXPECT_EQ(doc.root.members[0].unit, "m");
  EXPECT_TRUE(registry.check("protocol", "tiny", {{"size", 1.5}}).empty());
  const Issues issues = registry.check("protocol", "tiny", {{"size", 0.5}});
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].path, "size");
  EXPECT_EQ(issues[0].text, "is too small");
}

TEST_F(RegistryTest, TellsWhereAPluginComesFrom) {
  const Registry registry({{folder.path(), ""}});
  const PluginInfo& info = registry.info("output", "tiny");
  const fs::path file = folder / "breccia_output.tiny.so";
  EXPECT_EQ(info.file, file);
  EXPECT_EQ(info.key, (PluginKey{"output", "tiny"}));
  EXPECT_EQ(info.version, "unversioned");
  const std::string bytes = built("tiny_output");
  EXPECT_EQ(info.sha256(), sha256(std::as_bytes(std::span(bytes))));
}

TEST_F(RegistryTest, AnUnknownNameGetsASuggestionTheKnownOnesAndThePlaces) {
  write(folder / "breccia_contact_law.elastic_brittle.so", "never opened");
  const Registry registry({{folder.path(), ""}, {"/nowhere/breccia", ""}});
  EXPECT_EQ(refusal([&] { registry.documentation("contact_law", "elastic_britle"); }),
            "no contact_law named `elastic_britle`; did you mean `elastic_brittle`? known: elastic_brittle, tiny; "
            "searched: " +
                folder.path().string() + ", /nowhere/breccia");
  EXPECT_EQ(refusal([&] { registry.info("packing", "quite_something_else"); }),
            "no packing named `quite_something_else`; known: tiny; searched: " + folder.path().string() +
                ", /nowhere/breccia");
  EXPECT_EQ(refusal([] {
              Registry(std::vector<PluginFolder>{}).create<Output>({"vtk", {}});
            }),
            "no output named `vtk`; known: none; searched: no folder");
}

TEST_F(RegistryTest, AnUnknownKindGetsASuggestion) {
  const Registry registry({{folder.path(), ""}});
  EXPECT_EQ(refusal([&] { registry.names("contact_laws"); }),
            "no kind of plugin called `contact_laws`; did you mean `contact_law`? known: packing, contact_law, "
            "protocol, postprocessor, output, renderer");
  EXPECT_EQ(refusal([&] { registry.documentation("zzz", "tiny"); }),
            "no kind of plugin called `zzz`; known: packing, contact_law, protocol, postprocessor, output, renderer");
}

}  // namespace breccia::test
