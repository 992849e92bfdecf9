// wrlkit check: what the parser and the node table have to say of worlds; nothing is written.
#include <fmt/format.h>
#include <unistd.h>

#include "base/text/json.h"
#include "convert/hidden_geometry.h"
#include "scenegraph/verify.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"

namespace wrlkit {
namespace {

/// Inlines and prototypes are followed, so that what is missing there is said.
void check_world(Session& s) {
  check_values(s.world().scene, s.diag());
  report_hidden_geometry(s.world().scene, s.diag());
  std::string why;
  if (auto p = Pipeline::parse("lower-vrml1,expand", why)) p->run(s.world().scene, s.context());
}

void print_text(const std::string& path, const Diagnostics& d) {
  fmt::print("{}", messages_text(d, isatty(STDOUT_FILENO) != 0, false));
  fmt::print("{}: {} errors, {} warnings\n", path, d.count(Severity::error), d.count(Severity::warning));
}

std::string json_of(const std::string& path, const Diagnostics& d, bool readable) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("file", path);
  json.member("readable", readable);
  json.member("error", d.count(Severity::error));
  json.member("warning", d.count(Severity::warning));
  json.key("messages");
  json.raw(messages_json(d));
  json.end_object();
  return out;
}

}  // namespace

int run_check(const Flags& flags) {
  std::size_t unreadable = 0, faulty = 0;
  std::string json;
  for (const auto& path : flags.inputs) {
    Flags one = flags;
    one.inputs = {path};
    Session s(one);
    if (!s.good()) return usage;
    bool readable = s.read(path);
    if (readable && !flags.parse_only) check_world(s);
    s.progress().clear();
    unreadable += !readable;
    faulty += s.diag().has_errors();
    if (flags.json || !flags.report.empty()) json += (json.empty() ? "[" : ",\n") + json_of(path, s.diag(), readable);
    if (!flags.json && (!flags.quiet || s.diag().has_errors())) print_text(path, s.diag());
  }
  if (flags.json) fmt::print("{}]\n", json);
  if (!flags.report.empty() && !write_text_file(flags.report, json + "]\n")) return usage;
  return unreadable == flags.inputs.size() ? nothing : faulty ? partly : done;
}

}  // namespace wrlkit
