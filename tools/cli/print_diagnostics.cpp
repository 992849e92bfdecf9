#include "tools/cli/print_diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text/json.h"

namespace wrlkit {
namespace {

std::string_view colour_of(Severity s) {
  switch (s) {
    case Severity::error:
      return "\033[1;31m";
    case Severity::warning:
      return "\033[1;33m";
    case Severity::lost:
      return "\033[1;35m";
    case Severity::note:
    case Severity::ignored:
      return "\033[1;36m";
  }
  return "";
}

std::string place_text(const Place& p) {
  if (p.file.empty()) return "";
  return p.line ? fmt::format("{}:{}:{}: ", p.file, p.line, p.column) : fmt::format("{}: ", p.file);
}

/// Characters of UTF-8: what a terminal shows of some bytes.
std::size_t characters(std::string_view bytes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(bytes, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string message_text(const Message& m, const Sources& sources, bool colours) {
  Place p = sources.locate(m.where);
  if (m.where.length == 0) p.line = 0;  // a message about the file as a whole
  std::string_view on = colours ? colour_of(m.severity) : "", off = colours ? "\033[0m" : "";
  std::string out =
      fmt::format("{}{}{}:{} {} [{}]\n", place_text(p), on, to_string(m.severity), off, m.text(), info(m.id).name);
  if (!p.line || p.line_text.empty()) return out;
  out += fmt::format("{:>6} | {}\n", p.line, p.line_text);
  const std::string_view line = p.line_text;
  const auto in_front = characters(line.substr(0, p.caret)), marked = characters(line.substr(p.caret, p.caret_length));
  out += fmt::format("       | {}{}^{}{}\n", std::string(in_front, ' '), on,
                     std::string(std::max<std::size_t>(marked, 1) - 1, '~'), off);
  return out;
}

std::string messages_text(const Diagnostics& diag, bool colours, bool quiet) {
  std::string out;
  std::map<Diag, std::pair<std::size_t, Severity>> printed;
  std::set<std::string> said;  // a file that is read twice says everything twice
  for (const auto& m : diag.messages()) {
    if (quiet && m.severity != Severity::error) continue;
    if (auto text = message_text(m, diag.sources(), colours); said.insert(text).second) out += text;
    auto& [n, severity] = printed[m.id];
    ++n;
    severity = m.severity;  // -Werror may have changed it
  }
  for (const auto& [id, all] : printed)
    if (diag.count(id) > all.first)
      out +=
          fmt::format("{}: {} more like this [{}]\n", to_string(all.second), diag.count(id) - all.first, info(id).name);
  return out;
}

std::string messages_brief(const Diagnostics& diag, bool colours, bool quiet) {
  std::string out;
  std::set<Diag> said;
  for (const auto& m : diag.messages()) {
    if ((quiet && m.severity != Severity::error) || !said.insert(m.id).second) continue;
    const auto text = message_text(m, diag.sources(), colours);
    out += text.substr(0, text.find('\n'));
    out += diag.count(m.id) > 1 ? fmt::format(", {} in all\n", diag.count(m.id)) : "\n";
  }
  return out;
}

std::string counted(std::size_t n, std::string_view what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::string messages_json(const Diagnostics& diag) {
  std::string out;
  JsonOut json(out);
  std::set<Diag> counted;
  json.list(diag.messages(), [&](const auto& m) {
    const Place p = diag.sources().locate(m.where);
    json.object([&] {
      json.members("severity", to_string(m.severity), "name", info(m.id).name, "text", m.text(), "file", p.file);
      if (p.line && m.where.length) json.members("line", p.line, "column", p.column);
      // How often this message came in all, printed once.
      if (counted.insert(m.id).second) json.member("count", diag.count(m.id));
    });
  });
  return out;
}

}  // namespace wrlkit
