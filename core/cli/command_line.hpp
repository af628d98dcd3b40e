// SPDX-License-Identifier: BSD-3-Clause
/// The one declaration of the command line: parsing, `--help`, the manual page and the shells' completions come from
/// it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace breccia::cli {

/// Declares all verbs and options and calls `use` while the variables that they fill live. Returns what `use` returns;
/// a verb that is parsed in it leaves its exit code in `code`.
int with_command_line(const std::function<int(CLI::App& app, const int& code)>& use);

}  // namespace breccia::cli
