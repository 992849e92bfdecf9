#include "base/diagnostics.h"

#include <algorithm>
#include <charconv>

#include "base/hashing.h"

namespace wrlkit {
namespace {

const std::vector<DiagInfo>& table() {
  static const auto rows = [] {
    std::vector<DiagInfo> v{
#define DIAG(severity, name, text) {Diag::name, #name, Severity::severity, text},
#include "base/diagnostics.def"
#undef DIAG
    };
    for (auto& d : v) std::ranges::replace(d.name, '_', '-');
    return v;
  }();
  return rows;
}

std::uint64_t hash_of(Diag id, Span where, const std::vector<std::string>& args) {
  auto h = mixed(where.begin, static_cast<std::uint64_t>(id));
  for (const auto& a : args) {
    for (char c : a) h = mixed(h, static_cast<unsigned char>(c));
    h = mixed(h, 256);
  }
  return h;
}

}  // namespace

std::span<const DiagInfo> all_diags() { return table(); }

const DiagInfo& info(Diag d) { return table()[static_cast<std::size_t>(d)]; }

bool find_diag(std::string_view name, Diag& out) {
  const auto found = std::ranges::find(table(), name, &DiagInfo::name);
  if (found == table().end()) return false;
  out = found->id;
  return true;
}

std::string_view to_string(Severity s) {
  constexpr std::string_view names[] = {"ignored", "note", "lost", "warning", "error"};
  return names[static_cast<std::size_t>(s)];
}

std::string Message::text() const {
  std::string out;
  std::size_t next = 0;
  bool is_one = false;  // the last number
  std::string_view t = info(id).text;
  for (auto open = t.find('{'); open != t.npos; open = t.find('{')) {
    out += t.substr(0, open);
    const auto close = t.find('}', open), bar = t.substr(0, close).find('|', open);
    if (bar != t.npos) {
      out += is_one ? t.substr(open + 1, bar - open - 1) : t.substr(bar + 1, close - bar - 1);
    } else if (next < args.size()) {
      is_one = args[next] == "1";
      out += args[next++];
    }
    t.remove_prefix(close + 1);
  }
  return out += t;
}

std::string general_text(const DiagInfo& diag) {
  constexpr std::size_t most = 8;
  return Message{diag.id, diag.severity, {}, std::vector<std::string>(most, "{}")}.text();
}

// Arguments are shown to people: long ones are cut, between characters, control characters blanked.
std::string Diagnostics::argument(std::string_view s) {
  constexpr std::size_t longest = 120, longest_character = 4;
  const auto is_inside_character = [&](std::size_t at) { return (static_cast<unsigned char>(s[at]) & 0xc0) == 0x80; };
  auto end = std::min(s.size(), longest);
  if (s.size() > longest)
    while (end > longest - longest_character && is_inside_character(end)) --end;
  std::string out(s.substr(0, end));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  if (s.size() > longest) out += "...";
  return out;
}

std::string Diagnostics::argument(double v) {
  char b[32];
  auto r = std::to_chars(b, b + sizeof b, v, std::chars_format::general, 6);
  return {b, r.ptr};
}

void Diagnostics::warnings_are_errors() {
  for (auto& s : severity_)
    if (s == Severity::warning) s = Severity::error;
}

void Diagnostics::add(Diag id, Span where, std::vector<std::string> args) {
  auto s = severity_[static_cast<std::size_t>(id)];
  if (s == Severity::ignored) return;
  // A pass that runs twice reports the same fault of the same place only once.
  if (where) {
    const auto hash = hash_of(id, where, args);
    if (reported_.contains(hash)) return;
    if (reported_.size() < remembered) reported_.insert(hash);
  }
  ++by_severity_[static_cast<std::size_t>(s)];
  if (++by_name_[static_cast<std::size_t>(id)] <= kept_per_name) messages_.push_back({id, s, where, std::move(args)});
}

}  // namespace wrlkit
