// SPDX-License-Identifier: BSD-3-Clause
/// What goes wrong inside a plugin comes out as a UserError that names it.
#include "breccia/contact_law.hpp"
#include "breccia/packing.hpp"
#include "breccia/renderer.hpp"
#include "fixture.hpp"
#include "plugin/registry.hpp"

namespace breccia::test {

class Misbehaviour : public ::testing::Test {
 protected:
  void SetUp() override { file = write(folder / "breccia_contact_law.misbehaving.so", built("misbehaving")).string(); }

  std::string of(const std::string& how) {
    const Environment ask("BRECCIA_TEST_MISBEHAVE", how);
    const Registry registry({{folder.path(), ""}});
    return refusal([&] {
      registry.documentation("contact_law", "misbehaving");
      registry.check("contact_law", "misbehaving", Json::object());
      registry.create<ContactLaw>({"misbehaving", Json::object()});
    });
  }
  Folder folder;
  std::string file;
};

TEST_F(Misbehaviour, Throwing) {
  const std::string who = "contact_law `misbehaving` failed while ", plugin = " (plugin " + file + ")";
  EXPECT_EQ(of("throw in factory"), who + "describing itself: no factory today" + plugin);
  EXPECT_EQ(of("throw in documentation"), who + "describing itself: no words" + plugin);
  EXPECT_EQ(of("throw in check"), who + "checking its parameters: no rule" + plugin);
  EXPECT_EQ(of("throw in create"), who + "being set up: no memory left for it" + plugin);
  EXPECT_EQ(of("throw a number"), who + "being set up: it threw something that is not an exception" + plugin);
}

TEST_F(Misbehaviour, GivingNothingOrTheWrongThing) {
  const std::string author = "tell its author";
  EXPECT_EQ(of("give no factory"),
            "contact_law `misbehaving` gave no factory (plugin " + file + "): a fault of the plugin, " + author);
  EXPECT_EQ(of("make nothing"), "contact_law `misbehaving` made nothing when it was set up (plugin " + file +
                                    "): a fault of the plugin, " + author);
  EXPECT_EQ(of("make another kind"), "contact_law `misbehaving` does not behave as a contact_law (plugin " + file +
                                         "): its last line names the wrong kind, " + author);
}

TEST_F(Misbehaviour, AFailureOnceIsNotAFailureForEver) {
  const Registry registry({{folder.path(), ""}});
  {
    const Environment ask("BRECCIA_TEST_MISBEHAVE", "throw in factory");
    refusal([&] { registry.documentation("contact_law", "misbehaving"); });
  }
  EXPECT_EQ(registry.documentation("contact_law", "misbehaving").summary, "");
}

TEST_F(Misbehaviour, AConstructorsOwnUserErrorStaysReadable) {
  write(folder / "breccia_packing.tiny.so", built("tiny_packing"));
  const Registry registry({{folder.path(), ""}});
  EXPECT_EQ(refusal([&] {
              registry.create<Packing>({"tiny", {{"size", 101}}});
            }),
            "packing `tiny`: size 100 m is the most");
  EXPECT_EQ(refusal([&] {
              registry.create<Packing>({"tiny", {{"size", 13}}});
            }),
            "packing `tiny`: not on this machine");
  write(folder / "breccia_renderer.tiny.so", built("tiny_renderer"));  // of pictures alone one can do without
  EXPECT_THROW(Registry({{folder.path(), ""}}).create<Renderer>({"tiny", {{"size", 13}}}), Unavailable);
}

}  // namespace breccia::test
