// SPDX-License-Identifier: BSD-3-Clause
/// The manual page breccia(1), in the macros of man(7).
#include <fmt/format.h>

#include "cli/command_model.hpp"
#include "cli/verbs.hpp"

namespace breccia::cli {

namespace {

/// Text as it stands; what it has in backticks becomes bold.
std::string roff(const std::string& text) {
  std::string out;
  bool bold = false;
  for (const char c : text) switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      case '`':
        out += (bold = !bold) ? "\\fB" : "\\fR";
        break;
      default:
        out += c;
    }
  return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string shown(const Argument& a) {
  std::string out;
  for (const std::string& name : a.names) out += (out.empty() ? "" : ", ") + bold(name);
  if (a.value.empty()) return out;
  return (out.empty() ? "" : out + " ") + italic(a.value) + (a.repeated ? " ..." : "");
}

std::string entry(const Argument& a) {
  std::string others, more;
  for (const std::string& name : a.not_with) others += (others.empty() ? "" : ", ") + bold(name);
  if (!a.names.empty() && a.required) more += " It must be given.";
  if (!a.range.empty()) more += " Range: " + roff(a.range) + ".";
  if (!a.fallback.empty()) more += " Default: " + roff(a.fallback) + ".";
  if (!others.empty()) more += " Not together with " + others + ".";
  return ".TP\n" + shown(a) + "\n" + roff(a.text) + (more.empty() ? "" : "." + more) + "\n";
}

std::string synopsis(const Verb& verb) {
  std::string out = ".B breccia " + verb.name + "\n";
  for (const Argument& a : verb.options)
    if (a.required) out += shown(a) + "\n";
  out += "[" + italic("OPTION") + "]...\n";
  for (const Argument& a : verb.positionals) out += a.required ? shown(a) + "\n" : "[" + shown(a) + "]\n";
  return out;
}

/// Lines of a verb's last words; an example keeps a line of its own.
std::string footer(const std::string& text) {
  if (text.empty()) return {};
  std::string out = ".PP\n";
  for (const std::string& line : CLI::detail::split(text, '\n'))
    out += (line.starts_with("Example:") || line.starts_with("Exit code:") ? ".PP\n" : "") + roff(line) + "\n";
  return out;
}

}  // namespace

std::string manual_page(const CommandModel& model) {
  std::string out = fmt::format(
      ".\\\" Made from the program's declaration of its command line.\n"
      ".TH BRECCIA 1 \"\" \"Breccia {}\" \"User Commands\"\n"
      ".SH NAME\nbreccia \\- bonded\\-particle mechanics of rock and concrete\n.SH SYNOPSIS\n",
      roff(BRECCIA_VERSION));
  const char* between = "";
  for (const Verb& verb : model.verbs) {
    out += between + synopsis(verb);
    between = ".br\n";
  }
  out +=
      ".SH DESCRIPTION\n"
      "Breccia packs spheres or discs, bonds them, loads the specimen to failure and measures stress and strain from\n"
      "the particles. One YAML file, the workflow, says what is done; packings, contact laws, tests, measurements,\n"
      "files and pictures are plugins.\n"
      ".B breccia describe workflow\nlists the keys of a workflow,\n.B breccia list\nthe plugins.\n"
      ".SH OPTIONS\nWithout a verb:\n";
  for (const Argument& a : model.options) out += entry(a);
  out += ".SH VERBS\n";
  for (const Verb& verb : model.verbs) {
    out += ".SS breccia " + roff(verb.name) + "\n" + roff(verb.text) + ".\n";
    for (const Argument& a : verb.positionals) out += entry(a);
    for (const Argument& a : verb.options) out += entry(a);
    out += footer(verb.footer);
  }
  out += fmt::format(
      ".SH EXIT STATUS\n"
      ".TP\n.B {}\nall is well\n"
      ".TP\n.B {}\nsomething failed that is no mistake of the input\n"
      ".TP\n.B {}\nthe input is not in order: what, where and what to write instead has been said\n"
      ".TP\n.B {}\nstopped on request\n",
      ok, failure, bad_input, interrupted);
  out +=
      ".SH ENVIRONMENT\n"
      ".TP\n.B BRECCIA_PLUGIN_PATH\nfolders of plugins, with colons between them; they come before Breccia\\(aqs own\n"
      ".TP\n.B BRECCIA_CACHE\nfolder of packings that were made before; default: \\fB$XDG_CACHE_HOME/breccia\\fR or\n"
      "\\fB\\(ti/.cache/breccia\\fR\n"
      ".SH FILES\nBelow the prefix of the installation, \\fB/usr\\fR for a package:\n"
      ".TP\n.B share/breccia/workflows\nworkflows of published tests, and examples\n"
      ".TP\n.B share/doc/breccia\nthe documentation; \\fBdocs/writing_a_law.md\\fR goes from an empty folder to a law "
      "of "
      "one\\(aqs own\n"
      ".TP\n.B lib/breccia\nthe plugins\n"
      ".TP\n.B lib/cmake/Breccia\nwhat \\fBfind_package(Breccia)\\fR finds\n";
  return out;
}

}  // namespace breccia::cli
