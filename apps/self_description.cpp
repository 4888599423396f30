// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/self_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <regex>
#include <vector>

namespace lightstripe {
namespace {

/// The commands that --help lists, in its order.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// "-o" and "--output" of one option, as they are typed.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string option_words(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options())
    for (const auto& name : spellings(*option)) words.push_back(name);
  return fmt::format("{}", fmt::join(words, " "));
}

/// `--kind) words='rail wheel' ;;` for each option whose values are known.
std::string value_cases(const CLI::App& app) {
  std::string cases;
  for (const CLI::Option* option : app.get_options()) {
    std::string values = option->get_type_name();
    if (!option->nonpositional() || values.find('|') == std::string::npos) continue;
    std::replace(values.begin(), values.end(), '|', ' ');
    std::vector<std::string> heads;
    for (const std::string& name : spellings(*option))
      heads.push_back("'" + app.get_name() + " " + name + "'");
    cases += fmt::format("      {}) words='{}' ;;\n", fmt::join(heads, "|"), values);
  }
  return cases;
}

/// Text as roff takes it: no escape, no hyphen for a minus, no request at the start of a line.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
      out += c;
    }
  }
  return out;
}

/// The names that may be given, or just VALUE.
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.find('|') == std::string::npos ? "VALUE" : type;
}

std::string options_page(const CLI::App& app) {
  std::string page;
  for (const CLI::Option* option : app.get_options()) {
    const bool takes_value = option->get_items_expected_max() > 0;
    std::string name = option->nonpositional() ? fmt::format("{}", fmt::join(spellings(*option), ", "))
                                               : option->get_name(true);
    if (option->nonpositional() && takes_value) name += " " + value_name(*option);
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(name), roff(option->get_description()));
  }
  return page;
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\ndone\n"
    ".TP\n1\nthe input or the world is wrong; one line on standard error says what and what to do\n"
    ".TP\n2\nwrong usage\n"
    ".TP\n3\ndone, but the result cannot be used; standard error says why\n";

}  // namespace

void name_types(const CLI::App& app) {
  const std::map<std::string, std::string> types{
      {"INT", "INTEGER"}, {"UINT", "INTEGER"}, {"FLOAT", "NUMBER"}};
  const std::map<std::string, std::string> bounds{{"POSITIVE", "above 0"}, {"NONNEGATIVE", "0 or more"}};
  for (const CLI::App* command : commands_of(app))
    for (CLI::Option* option : const_cast<CLI::App*>(command)->get_options()) {
      const std::string type = option->get_type_name();
      const std::size_t colon = type.find(':');
      const auto known = types.find(type.substr(0, colon));
      if (known == types.end()) continue;
      option->type_name(known->second);
      if (colon == std::string::npos) continue;
      std::string bound = type.substr(colon + 1);
      if (const std::size_t open = bound.find('['); open != std::string::npos)  // "INT in [1 - 1024]"
        bound =
            std::regex_replace(bound.substr(open + 1, bound.size() - open - 2), std::regex(" - "), " to ");
      const auto named = bounds.find(bound);
      option->get_validator(0)->description(named == bounds.end() ? bound : named->second);
    }
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> commands;
  std::string cases, values;
  for (const CLI::App* command : commands_of(app)) {
    commands.push_back(command->get_name());
    values += value_cases(*command);
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), option_words(*command));
  }
  return fmt::format(
      R"(# bash completion of {0}; made by `{0} generate bash-completion`
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} command= word words
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in {1}) command=$word; break ;; esac
  done
  case $command in
    '') words='{2} {3}' ;;
{4}  esac
  if [[ -n $command && $current != -* ]]; then
    local known=1
    case "$command $previous" in
{5}      *) known= ;;
    esac
    if [[ -n $known ]]; then
      mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
      return
    fi
  fi
  if [[ -z $command || $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -o filenames -F _{0} {0}
)",
      app.get_name(), fmt::join(commands, "|"), fmt::join(commands, " "), option_words(app), cases, values);
}

std::string man_page(const CLI::App& app, const std::string& version) {
  std::string page = fmt::format(
      ".TH LIGHTSTRIPE 1 \"\" \"{0} {1}\" \"User Commands\"\n.SH NAME\n{0} \\- {2}\n"
      ".SH SYNOPSIS\n.B {0}\n\\fICOMMAND\\fR [\\fIOPTION\\fR]... [\\fIFILE\\fR]...\n.SH OPTIONS\n{3}",
      roff(app.get_name()), roff(version),
      roff(app.get_description().substr(app.get_description().find(": ") + 2)), options_page(app));
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app))
    page += fmt::format(".SS {}\n{}\n{}", roff(command->get_name()), roff(command->get_description()),
                        options_page(*command));
  return page + kExitStatus;
}

}  // namespace lightstripe
