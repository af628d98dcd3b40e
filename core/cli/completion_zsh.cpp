// SPDX-License-Identifier: BSD-3-Clause
/// Completion for zsh, through its function _arguments.
#include "cli/command_model.hpp"

namespace breccia::cli {

namespace {

const char* const zsh_helpers = R"zsh(#compdef breccia
# Completion of breccia for zsh; made from the program's declaration of its command line.

_breccia_files() { _files -g "${(j: :)@/#/*.}" } # ending...
_breccia_folders() { _files -/ }
_breccia_words() { compadd -- "$@" }
_breccia_plugins() { # KIND/NAME, KIND, or a kind for the names of its plugins
  local -a lines
  case $1 in
    KIND/NAME) lines=(${${(f)"$(${~program} list 2>/dev/null)"}%% *}) ;;
    KIND) lines=(${(u)${(f)"$(${~program} list 2>/dev/null)"}%%/*}) ;;
    *) lines=(${${${(f)"$(${~program} list $1 2>/dev/null)"}%% *}##*/}) ;;
  esac
  compadd -- $lines
}

_breccia() {
  local curcontext="$curcontext" state program=$words[1]
  local -a line verbs
)zsh";

/// Text within a specification: brackets and colons have a meaning there.
std::string text(const std::string& t) {
  return replaced(replaced(replaced(replaced(t, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string action(const Offer& offer) {
  const std::string calls = shell_calls(offer);
  return calls.empty() ? " " : "{" + calls + "}";
}

std::string message(const Argument& a) { return text(replaced(a.value, "|", " or ")); }

/// One specification for each of an option's names; one of them excludes the others, and itself unless repeated.
std::string options(const std::vector<Argument>& all) {
  std::string out;
  for (const Argument& a : all)
    for (const std::string& name : a.names) {
      const std::string first = a.repeated ? "*" : a.names.size() > 1 ? "(" + words_of(a.names).substr(1) + ")" : "";
      const std::string ending = a.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
      const std::string value = a.value.empty() ? "" : ":" + message(a) + ":" + action(a.offer);
      out += " \\\n        " + quoted(first + name + ending + "[" + text(a.text) + "]" + value);
    }
  return out;
}

std::string positionals(const std::vector<Argument>& all) {
  std::string out;
  for (std::size_t k = 0; k < all.size(); ++k)
    out += " \\\n        " + quoted((all[k].repeated ? "*" : std::to_string(k + 1)) + (all[k].required ? ":" : "::") +
                                    message(all[k]) + ":" + action(all[k].offer));
  return replaced(out, "*::", "*:");
}

}  // namespace

std::string zsh_completion(const CommandModel& model) {
  std::string out = zsh_helpers;
  out += "  verbs=(";
  for (const Verb& verb : model.verbs) out += "\n    " + quoted(verb.name + ":" + replaced(verb.text, ":", "\\:"));
  out += ")\n  _arguments -C" + options(model.options) + " \\\n        '1:verb:->verb' '*::argument:->argument'\n";
  out += "  case $state in\n    verb) _describe verb verbs ;;\n    argument)\n      case $words[1] in\n";
  for (const Verb& verb : model.verbs)
    out += "      " + verb.name + ")\n        _arguments" + options(verb.options) + positionals(verb.positionals) +
           "\n        ;;\n";
  out += "      esac\n      ;;\n  esac\n}\n\n_breccia \"$@\"\n";
  return out;
}

}  // namespace breccia::cli
