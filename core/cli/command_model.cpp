// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>

#include "cli/verbs.hpp"

namespace breccia::cli {

namespace {

/// What is offered for a value, by the word that stands for it: the name of a positional, the type's name of an option.
const std::map<std::string, Offer>& vocabulary() {
  static const std::map<std::string, Offer> known{
      {"FILE", {{}, {"yaml", "yml"}, false, ""}},   // a workflow
      {"STUDY", {{}, {"yaml", "yml"}, false, ""}},  //
      {"CALIBRATION", {{}, {"yaml", "yml"}, false, ""}},
      {"TARGET", {{}, {"yaml", "yml"}, false, "contact_law"}},
      {"SOURCE", {{}, {"pvd", "vtp"}, true, ""}},
      {"DIR", {{}, {}, true, ""}},
      {"FOLDER", {{}, {}, true, ""}},
      {"CHECKPOINT", {{}, {"h5"}, true, ""}},
      {"LIBRARY", {{}, {"so"}, true, ""}},
      {"CSV", {{}, {"csv"}, false, ""}},
      {"HTML", {{}, {"html"}, false, ""}},
      {"KIND", {{}, {}, false, "KIND"}},
      {"PLUGIN", {{}, {}, false, "KIND/NAME"}},
      {"TOPIC", {{"workflow", "sweep", "calibration"}, {}, false, "KIND/NAME"}},
      {"RENDERER", {{}, {}, false, "renderer"}},
  };
  return known;
}

std::vector<std::string> choices(const std::string& type) {
  const std::size_t from = type.find('{'), to = type.find('}');  // "TEXT:{a,b}"
  return to == std::string::npos ? std::vector<std::string>{}
                                 : CLI::detail::split(type.substr(from + 1, to - from - 1), ',');
}

Argument argument(const CLI::Option& o) {
  Argument a;
  a.text = o.get_description();
  a.required = o.get_required();
  a.fallback = o.get_default_str();
  for (const std::string& name : o.get_snames()) a.names.push_back("-" + name);
  for (const std::string& name : o.get_lnames()) a.names.push_back("--" + name);
  for (const CLI::Option* other : o.get_excludes()) a.not_with.push_back(other->get_name());
  std::sort(a.not_with.begin(), a.not_with.end());  // CLI11 has them in the order of their addresses
  if (o.get_expected_max() == 0) return a;          // a flag
  a.repeated =
      o.get_positional() ? o.get_expected_max() > 1 : o.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;

  const std::string type = o.get_type_name(), plain = type.substr(0, type.find(':'));
  const std::size_t bounds = type.find('[');  // "INT:INT in [1 - 9]"
  if (bounds != std::string::npos) a.range = type.substr(bounds + 1, type.find(']') - bounds - 1);
  a.offer.words = choices(type);
  if (o.get_positional()) {
    a.value = o.get_name(true);
  } else if (!a.offer.words.empty()) {
    a.value = CLI::detail::join(a.offer.words, "|");
  } else {
    a.value = plain == "TEXT" ? "VALUE" : plain == "INT" || plain == "UINT" || plain == "FLOAT" ? "NUMBER" : plain;
  }
  for (const std::string& word : {plain, a.value})
    if (const auto found = vocabulary().find(word); found != vocabulary().end()) a.offer = found->second;
  return a;
}

void arguments(const CLI::App& app, std::vector<Argument>& options, std::vector<Argument>& positionals) {
  for (const CLI::Option* o : app.get_options())
    if (!o->get_group().empty()) (o->get_positional() ? positionals : options).push_back(argument(*o));
}

}  // namespace

CommandModel command_model(const CLI::App& app) {
  CommandModel model{app.get_description(), {}, {}};
  std::vector<Argument> none;
  arguments(app, model.options, none);
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App* v) { return !v->get_group().empty(); })) {
    Verb v{verb->get_name(), verb->get_description(), verb->get_footer(), {}, {}};
    arguments(*verb, v.options, v.positionals);
    model.verbs.push_back(std::move(v));
  }
  return model;
}

std::string words_of(const std::vector<std::string>& values) {
  std::string all;
  for (const std::string& v : values) all += " " + v;
  return all;
}

std::string shell_calls(const Offer& offer) {
  std::string out;
  if (!offer.words.empty()) out += "; _breccia_words" + words_of(offer.words);
  if (!offer.plugins.empty()) out += "; _breccia_plugins " + offer.plugins;
  if (!offer.endings.empty()) out += "; _breccia_files" + words_of(offer.endings);
  else if (offer.folders) out += "; _breccia_folders";
  return out.empty() ? out : out.substr(2);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }

std::string shell_word(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || (c && std::strchr("_./+-=:,@%", c)); };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  return quoted(text);
}

int command_texts(const CLI::App& app, const std::string& form) {
  const CommandModel model = command_model(app);
  fmt::print("{}", form == "man"    ? manual_page(model)
                   : form == "bash" ? bash_completion(model)
                   : form == "zsh"  ? zsh_completion(model)
                                    : fish_completion(model));
  return ok;
}

}  // namespace breccia::cli
