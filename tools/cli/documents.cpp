#include "tools/cli/documents.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "tools/cli/session.h"

namespace wrlkit {
namespace {

struct State {
  bool has_document = false;
  std::vector<std::string> complaints;
};

State& state() {
  static State of_program;
  return of_program;
}

}  // namespace

void print_document(std::string_view json) {
  state().has_document = true;
  fmt::print("{}\n", json);
  std::fflush(stdout);
}

bool give_document(const Flags& flags, std::string_view json) {
  if (flags.json) print_document(json);
  return flags.report.empty() || write_text_file(flags.report, std::string(json) + '\n');
}

void complain(std::string_view verb, std::string_view why) {
  fmt::print(stderr, "wrlkit {}: {}\n", verb, why);
  state().complaints.emplace_back(why);
}

void print_failure(const Flags& flags, int code) {
  if (!flags.json || state().has_document) return;
  std::string out;
  JsonOut json(out);
  json.object([&] {
    json.members("inputs", std::span<const std::string>(flags.inputs), "output", flags.output, "exit_code", code);
    json.list("messages", state().complaints,
              [&](const std::string& why) { json.object("severity", "error", "name", "cannot-read", "text", why); });
  });
  print_document(out);
}

}  // namespace wrlkit
