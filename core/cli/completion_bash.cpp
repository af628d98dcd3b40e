// SPDX-License-Identifier: BSD-3-Clause
/// Completion for bash. It needs nothing but bash, and the program itself for the names of plugins.
#include "cli/command_model.hpp"

namespace breccia::cli {

namespace {

const char* const bash_helpers =
    R"bash(# Completion of breccia for bash; made from the program's declaration of its command line.

_breccia_words() { mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$*" -- "$cur"); }
_breccia_folders() {
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$cur")
  compopt -o filenames 2>/dev/null
}
_breccia_files() { # ending...
  local ending file
  for ending; do
    while IFS= read -r file; do
      [[ -d $file ]] || COMPREPLY+=("$file")
    done < <(compgen -f -X "!*.$ending" -- "$cur")
  done
  _breccia_folders
}
_breccia_plugins() { # KIND/NAME, KIND, or a kind for the names of its plugins
  local names
  case $1 in
    KIND/NAME) names=$("$program" list 2>/dev/null | cut -d ' ' -f 1) ;;
    KIND) names=$("$program" list 2>/dev/null | cut -d / -f 1 | sort -u) ;;
    *) names=$("$program" list "$1" 2>/dev/null | cut -d ' ' -f 1 | cut -d / -f 2) ;;
  esac
  _breccia_words $names
}

_breccia() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
  local program=${COMP_WORDS[0]/#\~/$HOME} takes= options= k place=0
  COMPREPLY=()
  # bash makes three words of --output=FOLDER
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $before == '=' ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)bash";

std::vector<std::string> names(const std::vector<Argument>& options, bool with_value) {
  std::vector<std::string> all;
  for (const Argument& a : options)
    for (const std::string& name : a.names)
      if (!with_value || !a.value.empty()) all.push_back(name);
  return all;
}

}  // namespace

std::string bash_completion(const CommandModel& model) {
  std::string out = bash_helpers, verbs;
  for (const Verb& verb : model.verbs) verbs += " " + verb.name;
  out += "  if ((COMP_CWORD == 1)); then\n    _breccia_words" + verbs + words_of(names(model.options, false)) +
         "\n    return\n  fi\n  case $verb in\n";
  for (const Verb& verb : model.verbs)
    out += "    " + verb.name + ")\n      options='" + words_of(names(verb.options, false)) + "'\n      takes='" +
           words_of(names(verb.options, true)) + " '\n      ;;\n";
  out += "  esac\n  case \"$verb $before\" in\n";
  for (const Verb& verb : model.verbs)
    for (const Argument& a : verb.options)
      if (const std::string offered = shell_calls(a.offer); !offered.empty()) {
        std::string patterns;
        for (const std::string& name : a.names)
          patterns += (patterns.empty() ? "'" : " | '") + verb.name + " " + name + "'";
        out += "    " + patterns + ") " + offered + "; return ;;\n";
      }
  out += R"(  esac
  if [[ $takes == *" $before "* ]]; then return; fi
  if [[ $cur == -* ]]; then
    _breccia_words $options
    return
  fi
  for ((k = 2; k < COMP_CWORD; ++k)); do # how many positional arguments stand before
    if [[ $takes == *" ${COMP_WORDS[k]} "* ]]; then
      [[ ${COMP_WORDS[k + 1]} == '=' ]] && ((k += 2)) || ((k += 1))
    elif [[ ${COMP_WORDS[k]} != -* ]]; then
      ((place += 1))
    fi
  done
  case "$verb $place" in
)";
  for (const Verb& verb : model.verbs)
    for (std::size_t k = 0; k < verb.positionals.size(); ++k)
      if (const std::string offered = shell_calls(verb.positionals[k].offer); !offered.empty())
        out += "    '" + verb.name + " '" + (verb.positionals[k].repeated ? "*" : std::to_string(k)) + ") " + offered +
               " ;;\n";
  out += "  esac\n}\ncomplete -F _breccia breccia\n";
  return out;
}

}  // namespace breccia::cli
