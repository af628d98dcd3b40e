// SPDX-License-Identifier: BSD-3-Clause
#include <sys/auxv.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "breccia/utf8.hpp"
#include "cli/command_line.hpp"
#include "cli/verbs.hpp"
#include "config/suggest.hpp"
#include "plugin/out_of_memory.hpp"

namespace {

using namespace breccia;

/// "; did you mean `x`?", or what there is.
std::string hint(const std::string& written, const std::vector<std::string>& known) {
  const std::string near = closest(written, known);
  return near.empty() ? "; there are " + list_of(known, 40) : "; did you mean `" + near + "`?";
}

/// Why the first word is no verb; empty when it is one, or an option.
std::string unknown_verb(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  const std::string word = argv[1];
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_name() == word) return {};
    if (!verb->get_group().empty()) verbs.push_back(verb->get_name());
  }
  return "breccia: unknown verb `" + word + "`" + hint(word, verbs) + " (`breccia --help`)";
}

/// Names the first option that the verb does not have; empty when there is none: the mistake is another one.
std::string unknown_option(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> known;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    if (verb->get_name() == argv[1])
      for (const CLI::Option* option : verb->get_options())
        if (!option->get_group().empty())
          for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int k = 2; k < argc; ++k) {
    const std::string word = std::string(argv[k]).substr(0, std::string(argv[k]).find('='));
    if (word == "--") return {};
    if (word == "--expect" || word == "--parent") continue;  // of studies, for their own processes
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    return "breccia " + std::string(argv[1]) + ": unknown option `" + word + "`" + hint(word, known) + " (`breccia " +
           argv[1] + " --help`)";
  }
  return {};
}

/// What else is wrong with a command, in one line.
std::string mistake(const CLI::App* app, const CLI::Error& e) {
  std::string command = "breccia", text = e.what();
  for (const CLI::App* verb : app->get_subcommands()) command += " " + verb->get_name();
  if (const std::size_t twice = text.find("At Most 1 required"); twice != text.npos)
    text = text.substr(0, twice) + "may be given only once";
  return command + ": " + text + " (`" + command + " --help`)\n";
}

int dispatch(int argc, char** argv) {
  return cli::with_command_line([&](CLI::App& app, const int& code) {
    app.failure_message(mistake);
    if (const std::string text = unknown_verb(app, argc, argv); !text.empty()) throw UserError(text);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() != 0)
        if (const std::string text = unknown_option(app, argc, argv); !text.empty()) throw UserError(text);
      return app.exit(e) == 0 ? cli::ok : cli::bad_input;
    }
    return code;
  });
}

}  // namespace

/// What libraries read from the environment when they are loaded, which is before `main`: the program starts itself
/// again with it. What is set already is left alone.
/// Threads that wait for each other sleep at once instead of spinning: beside other work a run is then never many times
/// slower, and on an idle machine it costs nothing that can be seen. Large arrays lie in huge pages where the system
/// gives them to who asks: particles are reached by index, and each small page costs a translation. Both are measured
/// in docs/performance.md.
void set_environment_of_libraries(char** argv) {
  if (getauxval(AT_SECURE)) return;  // the system takes such variables away: it would go round for ever
  bool again = false;
  const auto set = [&](const char* name, const char* value) {
    if (!std::getenv(name) && setenv(name, value, 0) == 0) again = true;
  };
  if (!std::getenv("GOMP_SPINCOUNT")) set("OMP_WAIT_POLICY", "passive");
  set("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
  if (again) execv("/proc/self/exe", argv);  // comes back only when it fails
}

int main(int argc, char** argv) {
  end_plainly_without_memory();
  set_environment_of_libraries(argv);
  prctl(PR_SET_NAME, "breccia");  // what `top` shows: it would be the last part of /proc/self/exe
  try {
    const int code = dispatch(argc, argv);
    // A reader that has seen enough (`| head`) is no error; a full disk is.
    if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || errno == EPIPE) return code;
    std::fprintf(stderr, "cannot write the output: %s\n", std::strerror(errno));
    return cli::bad_input;
  } catch (const Cancelled&) {
    std::fprintf(stderr, "breccia: stopped on request\n");
    return cli::interrupted;
  } catch (const UserError& e) {
    std::fprintf(stderr, "%s\n", printable(e.what()).c_str());
    return cli::bad_input;
  } catch (const std::filesystem::filesystem_error& e) {  // of a name that the user gave: too long, not to be entered
    const std::string file = printable(e.path1().string()), why = e.code().message();
    std::fprintf(stderr, "cannot use %s: %s\n", file.c_str(), why.c_str());
    return cli::bad_input;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "breccia: %s\n", out_of_memory().c_str());
    return cli::failure;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "breccia: %s\n", printable(e.what()).c_str());
    return cli::failure;
  }
}
