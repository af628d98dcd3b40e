// SPDX-License-Identifier: BSD-3-Clause
/// Completion for fish.
#include "cli/command_model.hpp"

namespace breccia::cli {

namespace {

const char* const fish_helpers =
    R"fish(# Completion of breccia for fish; made from the program's declaration of its command line.

function __breccia_plugins --description 'KIND/NAME, KIND, or a kind for the names of its plugins'
    set -l program (commandline -opc)[1]
    switch $argv[1]
        case KIND/NAME
            $program list 2>/dev/null | string replace -r '^(\S+)\s+' '$1\t'
        case KIND
            $program list 2>/dev/null | string replace -r '/.*' '' | sort -u
        case '*'
            $program list $argv[1] 2>/dev/null | string replace -r '^\S+/(\S+)\s+' '$1\t'
    end
end

function __breccia_files --description 'files with one of these endings, and folders to go on into'
    complete -C "'' "(commandline -ct) | string match -r '^[^\t]*(?:/|\.(?:'(string join '|' $argv)'))(?=\t|$)'
end

complete -c breccia -f
)fish";

/// What is offered, as commands that print it.
std::string offered(const Offer& offer) {
  std::string out;
  if (!offer.words.empty()) out += words_of(offer.words);
  if (!offer.plugins.empty()) out += " (__breccia_plugins " + offer.plugins + ")";
  if (!offer.endings.empty()) out += " (__breccia_files" + words_of(offer.endings) + ")";
  if (offer.folders && offer.endings.empty()) out += " (__fish_complete_directories)";
  return out.empty() ? "" : " -a " + quoted(out.substr(1));
}

std::string option(const std::string& condition, const Argument& a) {
  std::string out = "complete -c breccia -n " + quoted(condition);
  for (const std::string& name : a.names)
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  out += " -d " + quoted(replaced(a.text, "\\", "\\\\"));
  if (!a.value.empty()) out += " -x" + offered(a.offer);
  return out + "\n";
}

}  // namespace

std::string fish_completion(const CommandModel& model) {
  std::string out = fish_helpers;
  for (const Argument& a : model.options) out += option("__fish_use_subcommand", a);
  for (const Verb& verb : model.verbs) {
    out += "\ncomplete -c breccia -n __fish_use_subcommand -a " + verb.name + " -d " + quoted(verb.text) + "\n";
    const std::string condition = "__fish_seen_subcommand_from " + verb.name;
    for (const Argument& a : verb.options) out += option(condition, a);
    for (const Argument& a : verb.positionals)
      if (const std::string words = offered(a.offer); !words.empty())
        out += "complete -c breccia -n " + quoted(condition) + words + " -d " + quoted(a.value) + "\n";
  }
  return out;
}

}  // namespace breccia::cli
