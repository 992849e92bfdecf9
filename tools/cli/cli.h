#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/flags.h"
#include "tools/cli/recipe.h"

namespace wrlkit {

/// Reads the arguments of a command line, runs the verb and returns the exit code.
int run_command_line(int argc, char** argv);
/// The same as a whole program: exceptions and failed output are reported. Throws NeedsPython alone.
int run_program(int argc, char** argv);

inline constexpr std::string_view flag_type = "true or false";
struct OptionHelp {
  std::string name;  // the long one, without "--"
  std::string type;  // "FILE", "{m,cm,mm}", "UINT in [0 - 17]", flag_type
  std::string help;
  std::string letter;  // the short name, without "-"; empty when it has none
};
/// The options of a verb, in the order of its help.
std::vector<OptionHelp> options_of(std::string_view verb);
/// Whether that option of a verb may be given so; else why not.
bool check_option(std::string_view verb, std::string_view option, const std::vector<std::string>& values,
                  std::string& why);

/// The flags of a convert that does what a recipe says. The recipe has been read, so it says what convert understands.
Flags conversion_flags(const Recipe& recipe);

std::string_view program_version();

}  // namespace wrlkit
