// SPDX-License-Identifier: BSD-3-Clause
/// The command line as plain data, read off its declaration: what the manual page and the completions are made of.
#pragma once

#include <CLI/CLI.hpp>

namespace breccia::cli {

/// What a shell can offer for a value.
struct Offer {
  std::vector<std::string> words, endings;  ///< fixed words; endings of files, without the dot
  bool folders = false;
  std::string plugins;  ///< a kind: names of its plugins; "KIND": the kinds; "KIND/NAME": all plugins
};

struct Argument {
  std::vector<std::string> names;  ///< "-o", "--output"; a positional has none
  std::string value;               ///< what stands for the value: FOLDER, NUMBER; empty: a flag
  std::string text, range, fallback;
  std::vector<std::string> not_with;
  bool required = false, repeated = false;
  Offer offer;
};

struct Verb {
  std::string name, text, footer;
  std::vector<Argument> options, positionals;
};

struct CommandModel {
  std::string text;
  std::vector<Argument> options;  ///< of the program without a verb
  std::vector<Verb> verbs;
};

CommandModel command_model(const CLI::App& app);  ///< without what is hidden

int command_texts(const CLI::App& app, const std::string& form);  ///< prints one of these: "man", "bash", "zsh", "fish"

std::string manual_page(const CommandModel& model);  ///< roff, macros of man(7)
std::string bash_completion(const CommandModel& model);
std::string zsh_completion(const CommandModel& model);
std::string fish_completion(const CommandModel& model);

/// Calls of the functions that the scripts for bash and zsh both have; empty when nothing can be offered.
std::string shell_calls(const Offer& offer);
std::string words_of(const std::vector<std::string>& values);  ///< each behind a space
std::string replaced(std::string text, const std::string& what, const std::string& with);
/// In single quotes, as all three shells read them.
std::string quoted(const std::string& text);
/// The same, left as it is where no shell sees anything in it.
std::string shell_word(const std::string& text);

}  // namespace breccia::cli
