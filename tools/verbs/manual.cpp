// The manual in the language of man (groff_man(7)), from the table of verbs and their options.
#include <fmt/format.h>

#include <cstdio>
#include <set>
#include <string>

#include "tools/cli/cli.h"
#include "tools/cli/verbs.h"
#include "tools/cli/words.h"

namespace wrlkit {
namespace {

/// Text as it is: no escapes, no requests at the beginning of a line, hyphens that can be searched for.
std::string plain(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out += "\\&";
  for (char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    if (c == '\n') out += "\\&";
  }
  return out;
}

std::string option_text(const OptionHelp& o) {
  std::string names = o.letter.empty() ? "" : fmt::format("\\-{}, ", plain(o.letter));
  names += fmt::format("\\-\\-{}", plain(o.name));
  const std::string value = o.type == flag_type ? "" : " " + plain(o.type);
  return fmt::format(".TP\n.B {}{}\n{}\n", names, value, plain(o.help));
}

/// Options that every verb has, under a heading of their own.
std::set<std::string> common_options() {
  std::set<std::string> out;
  for (const auto& o : options_of("formats")) out.insert(o.name);
  return out;
}

std::string verb_text(const cli::Verb& v, const std::set<std::string>& common) {
  std::string out = fmt::format(".SS wrlkit {}\n{}.\n", plain(spoken_verb(v.name)), plain(v.help));
  for (const auto& o : options_of(v.name))
    if (!common.contains(o.name)) out += option_text(o);
  return out + fmt::format(".PP\n.nf\n  {}\n.fi\n", plain(v.example));
}

std::string manual_text() {
  const auto common = common_options();
  std::string out = fmt::format(
      ".TH WRLKIT 1 \"\" \"wrlkit {0}\" \"User commands\"\n"
      ".SH NAME\nwrlkit \\- legacy virtual worlds to glTF, X3D and better VRML\n"
      ".SH SYNOPSIS\n.B wrlkit\n.I VERB\n.RI [ OPTIONS ]\n.I FILES\n.br\n.B wrlkit\n.I IN\n.RI [ OUT ]\n"
      ".SH DESCRIPTION\nReads VRML97, VRML 1.0, Inventor, X3D and glTF, and writes glTF, X3D and VRML97, with levels "
      "of "
      "detail and baked light when that is asked for. What is repaired or lost is reported with its place. With a "
      "file and no verb it prints what is in it; with two it converts.\n"
      ".SH VERBS\n",
      plain(program_version()));
  for (const auto& v : cli::verbs()) out += verb_text(v, common);
  out += ".SH OPTIONS OF EVERY VERB\n";
  for (const auto& o : options_of("formats")) out += option_text(o);
  out +=
      ".TP\n.B \\-Werror=NAME, \\-Wno\\-NAME, \\-Werror\nThe severity of one message (wrlkit explain NAME), or of all "
      "warnings.\n"
      ".SH EXIT STATUS\n.TP\n.B 0\nAll is well.\n.TP\n.B 1\nSomething in the input could not be used.\n.TP\n.B "
      "2\nWrong "
      "usage.\n.TP\n.B 3\nNothing could be made.\n";
  return out;
}

}  // namespace

int run_manual(const Flags&) {
  std::fputs(manual_text().c_str(), stdout);
  return done;
}

}  // namespace wrlkit
