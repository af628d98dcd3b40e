// SPDX-License-Identifier: BSD-3-Clause
#include "scaffold/scaffold.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>

#include "breccia/atomic_file.hpp"
#include "breccia/text_file.hpp"
#include "config/text.hpp"
#include "plugin/search_path.hpp"
#include "results/temporary_folder.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// What a plugin's source cannot use: words of C++, and what its class has within it.
const std::set<std::string>& taken_words() {
  static const std::set<std::string> words = {
      "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
      "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
      "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
      "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
      "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
      "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
      "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
      "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
      "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
      "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
      "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
      "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
      "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
      "xor_eq",      "config",    "state",      "range",     "running"};
  return words;
}

/// Nearest to what was written that may be a name; empty when nothing is left of it.
std::string name_like(const std::string& written) {
  std::string name;
  for (const char c : written) {
    const char low = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    if (is_lower(low) || (is_digit(low) && !name.empty())) {
      // "MyLaw": the word begins at its capital.
      if (low != c && !name.empty() && name.back() != '_') name += '_';
      name += low;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

/// The values of the placeholders, put in by one pass: a name may look like a placeholder.
class Placeholders {
 public:
  explicit Placeholders(const NewProject& p) {
    const std::string version = BRECCIA_VERSION;
    values_ = {{{"new_plugin_name", p.name},
                {"NewPluginName", class_name(p.name)},
                {"new_plugin_kind", p.kind},
                {"new_breccia_series", version.substr(0, version.rfind('.'))}}};
  }
  std::string in(const std::string& text) const {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      const auto here = std::find_if(values_.begin(), values_.end(),
                                     [&](const auto& v) { return text.compare(at, v.first.size(), v.first) == 0; });
      if (here == values_.end()) {
        out += text[at++];
      } else {
        out += here->second;
        at += here->first.size();
      }
    }
    return out;
  }

 private:
  std::array<std::pair<std::string, std::string>, 4> values_;
};

std::string without_licence(const std::string& text) {
  const std::size_t end = text.find('\n');
  return text.substr(0, end).find("SPDX-License-Identifier:") == text.npos ? text : text.substr(end + 1);
}

/// Names and texts of the project's files.
std::map<fs::path, std::string> texts_of(const NewProject& project, const fs::path& templates) {
  const Placeholders placeholders(project);
  std::map<fs::path, std::string> texts;
  for (const fs::path& folder : {templates / project.kind, templates / "common"})
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().lexically_relative(folder).string();
      texts[placeholders.in(name)] += placeholders.in(without_licence(read_text_file(entry.path())));
    }
  return texts;
}

[[noreturn]] void cannot_make(const fs::path& folder, int reason) {
  throw UserError("cannot make the folder " + folder.string() + ": " + std::strerror(reason) + "; nothing was changed");
}

/// A folder in which the project grows, gone at the end.
TemporaryFolder temporary(const fs::path& within, const fs::path& project) {
  try {
    return TemporaryFolder(within, ".breccia-new");
  } catch (const CannotWrite& e) { cannot_make(project, e.reason()); }
}

/// Into a folder that is there already, and stays the one it is: someone may stand in it.
void move_into(const fs::path& from, const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(from)) names.push_back(entry.path().filename());
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::error_code error, ignored;
    fs::rename(from / names[k], folder / names[k], error);
    if (!error) continue;
    while (k-- > 0) fs::remove_all(folder / names[k], ignored);
    throw CannotWrite(folder, error.value());
  }
}

/// Whether it is there, and empty. UserError for what cannot take a project.
bool is_there(const fs::path& folder) {
  if (fs::exists(fs::symlink_status(folder))) {
    if (!fs::is_directory(folder))
      throw UserError(folder.string() + " is there already and no folder; choose another place with --dir");
    if (!fs::is_empty(folder))
      throw UserError("the folder " + folder.string() +
                      " is not empty; nothing was changed. Choose another place with --dir");
    return true;
  }
  if (!fs::is_directory(folder.parent_path()))
    throw UserError("there is no folder " + folder.parent_path().string() + " to put the project into: make it first");
  return false;
}

}  // namespace

fs::path template_folder() {
  const fs::path folder = (program_folder() / "../share/breccia/templates").lexically_normal();
  if (!fs::is_directory(folder / "common"))
    throw UserError("the templates of `breccia new` are not installed: there is no folder " + folder.string());
  return folder;
}

std::string why_not_a_plugin_name(const std::string& name) {
  const auto fits = [](char c) { return is_lower(c) || is_digit(c) || c == '_'; };
  if (name.size() > 64) return "it is longer than 64 characters";
  if (taken_words().contains(name)) return "it has a meaning in C++ or in the SDK; `" + name + "_1`, say, has none";
  if (!name.empty() && is_lower(name.front()) && name.back() != '_' && name.find("__") == name.npos &&
      std::all_of(name.begin(), name.end(), fits))
    return {};
  const std::string near = name_like(name);
  return "a name is lower-case letters, digits and single underscores between them, and begins with a letter" +
         (near.empty() ? std::string() : "; did you mean `" + near + "`?");
}

std::string class_name(const std::string& plugin_name) {
  std::string name;
  bool begins = true;
  for (const char c : plugin_name) {
    if (c != '_') name += begins && is_lower(c) ? char(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return name;
}

std::vector<fs::path> make_project(const NewProject& project, const fs::path& templates) {
  if (const std::string why = why_not_a_plugin_name(project.name); !why.empty())
    throw UserError("`" + project.name + "` cannot be the name of a plugin: " + why);
  fs::path folder = fs::absolute(project.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const bool there = is_there(folder);
  std::vector<fs::path> files;
  const TemporaryFolder own = temporary(there ? folder : folder.parent_path(), folder);
  // A temporary folder is for its owner alone; the project has the usual permissions.
  const fs::path whole = own.path() / "project";
  fs::create_directory(whole);
  for (const auto& [name, text] : texts_of(project, templates)) {
    fs::create_directories((whole / name).parent_path());
    write_file(whole / name, text);
    files.push_back(name);
  }
  std::error_code error;
  if (there) move_into(whole, folder);
  else fs::rename(whole, folder, error);
  if (error) cannot_make(folder, error.value());
  return files;
}

}  // namespace breccia
