#include "tools/verbs/documentation.h"

#include <fmt/format.h>

#include <algorithm>

#include "convert/formats.h"
#include "convert/profiles.h"
#include "scenegraph/access_word.h"
#include "scenegraph/range_text.h"
#include "tools/cli/recipe.h"
#include "tools/verbs/message_help.h"
#include "tools/verbs/node_fates.h"

namespace wrlkit {

std::string_view level_word(Level l) {
  return l == Level::authored ? "authored" : l == Level::expanded ? "expanded" : "mesh";
}

namespace {

std::string kinds_text(const FieldDef& f) {
  std::string out;
  for (auto k : f.kinds) out += (out.empty() ? "" : ", ") + std::string(k);
  return out;
}

}  // namespace

/// Range, unit, kinds: what limits a value; and whether it is a field of wrlkit's own.
std::string limits_text(const FieldDef& f) {
  std::string out = f.range.bounded() ? range_text(f.range) : "";
  for (const auto& part : {std::string(f.unit), kinds_text(f), std::string(f.is_own() ? "(wrlkit's own)" : "")})
    if (!part.empty()) out += (out.empty() ? "" : " ") + part;
  return out;
}

/// What the field says, and in which dialect it is otherwise.
std::string doc_text(const NodeType& t, const FieldDef& f) {
  constexpr auto vrml97 = static_cast<DialectSet>(Dialect::vrml97);
  std::string out(f.doc);
  if ((t.dialects & vrml97) && !(f.dialects & vrml97)) out = "X3D: " + out;
  if (f.since) out += fmt::format(" (X3D {}.{})", f.since / 10, f.since % 10);
  if (!f.vrml97_name.empty()) out += fmt::format("; in X3D {}", f.name);
  if (f.x3d_from) out += fmt::format("; another default in X3D {}.{}", f.x3d_from / 10, f.x3d_from % 10);
  return out;
}

std::string_view fate_text(BrowserNode::Fate fate) {
  if (fate == BrowserNode::Fate::drawn) return "drawn";
  return fate == BrowserNode::Fate::below ? "its children are drawn" : "kept";
}

std::string browser_node_text(const BrowserNode& n) {
  return fmt::format("{}  ({})\n  {}: {}\n", n.name, n.browser, n.what, fate_text(n.fate));
}

std::string type_text(const NodeType& t) {
  std::string out = fmt::format("{}  ({})\n  {}\n", t.name, t.clauses, t.doc);
  std::string bases;
  for (auto b : t.bases) bases += (bases.empty() ? "" : ", ") + std::string(b);
  out += fmt::format("  is a {}\n", bases);
  if (const auto fate = node_fate(t); !fate.empty()) out += fmt::format("  what becomes of it: {}\n", fate);
  out += '\n';
  std::size_t longest = 17;
  for (auto& f : t.fields) longest = std::max(longest, f.name_in(Dialect::vrml97).size());
  for (auto& f : t.fields) {
    auto name = f.name_in(Dialect::vrml97);
    out += fmt::format("  {:<13}{:<11}{:<{}} {:<14} {:<16} {}\n", access_word(f.access), info(f.type).name, name,
                       longest, f.default_text, limits_text(f), doc_text(t, f));
  }
  return out;
}

std::string pass_text(const PassInfo& p) {
  std::string out = fmt::format("{}: {}\n  needs level {}, leaves level {}\n", p.name, p.summary, level_word(p.needs),
                                level_word(p.leaves));
  for (auto& o : p.make()->options())
    out += fmt::format("  {:<18} {:<28} {:<14} {}\n", o.name, o.type_and_range(), o.value, o.help);
  if (!p.statistics.empty()) out += "  counts, for --stats:\n";
  for (const auto& s : p.statistics) out += fmt::format("  {:<33} {}\n", s.name, s.help);
  if (!p.doc.empty()) out += fmt::format("\n{}\n", p.doc);
  return out;
}

std::string diagnostic_text(Diag d) {
  const auto& name = info(d).name;
  const auto makes = info(d).severity == Severity::error ? "" : fmt::format(", -Werror={} makes it an error", name);
  return message_help(d) + fmt::format("  -Wno-{} drops it{}.\n", name, makes);
}

std::string formats_text() {
  std::string out = fmt::format("{:<10}{:<40}{:<32}{}\n", "format", "extensions", "read", "write");
  for (auto& f : formats()) out += fmt::format("{:<10}{:<40}{:<32}{}\n", f.name, f.endings, f.reads, f.writes);
  return out;
}

namespace {

std::string nodes_page() {
  std::string out = "# Node types\n\nGenerated from `scenegraph/nodes/*.nodes` by `script/docs`; do not edit.\n";
  for (auto& t : builtin_nodes()) {
    out += fmt::format(
        "\n## {}\n\n{} ({})\n\n| access | type | name | default | range, unit, kinds | |\n|---|---|---|---|---|---|\n",
        t.name, t.doc, t.clauses);
    for (auto& f : t.fields)
      out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", access_word(f.access), info(f.type).name,
                         f.name_in(Dialect::vrml97), f.default_text, limits_text(f), doc_text(t, f));
  }
  out += "\n## What becomes of the nodes of X3D\n\n\"Kept\" is: in VRML and X3D output, and in extras of glTF.\n\n";
  out += node_fates_table();
  out +=
      "\n## Nodes of browsers\n\nNo standard has these. They are kept as they are, with any field, and what stands "
      "below them is drawn.\n\n| node | browser | what it is | what becomes of it |\n|---|---|---|---|\n";
  for (const BrowserNode& n : browser_nodes())
    out += fmt::format("| {} | {} | {} | {} |\n", n.name, n.browser, n.what, fate_text(n.fate));
  return out;
}

std::string passes_page() {
  std::string out =
      "# Passes\n\nGenerated from the registry by `script/docs`; do not edit. `wrlkit passes NAME` shows the same.\n";
  for (auto& p : passes()) {
    out += fmt::format("\n## {}\n\n{}. Needs level *{}*, leaves level *{}*.\n", p.name, p.summary, level_word(p.needs),
                       level_word(p.leaves));
    if (!p.doc.empty()) out += fmt::format("\n{}\n", p.doc);
    auto options = p.make()->options();
    if (!options.empty()) out += "\n| option | type | default | |\n|---|---|---|---|\n";
    for (auto& o : options) out += fmt::format("| {} | {} | {} | {} |\n", o.name, o.type_and_range(), o.value, o.help);
    if (!p.statistics.empty()) out += "\n| counts | |\n|---|---|\n";
    for (const auto& s : p.statistics) out += fmt::format("| {} | {} |\n", s.name, s.help);
  }
  out += "\n## Pipelines with a name\n\n| name | passes | |\n|---|---|---|\n";
  for (auto& n : named_pipelines()) out += fmt::format("| {} | `{}` | {} |\n", n.name, n.text, n.summary);
  return out;
}

std::string diagnostics_page() {
  std::string out =
      "# Messages\n\nGenerated from `base/diagnostics.def` by `script/docs`; do not edit.\n\n| name | severity | text "
      "|\n|---|---|---|\n";
  for (const auto& d : all_diags())
    out += fmt::format("| {} | {} | {} |\n", d.name, to_string(d.severity), general_text(d));
  return out;
}

}  // namespace

std::span<const DocumentationPage> documentation_pages() {
  static constexpr DocumentationPage pages[] = {{"nodes", nodes_page},
                                                {"passes", passes_page},
                                                {"diagnostics", diagnostics_page},
                                                {"recipes", recipes_page},
                                                {"profiles", profiles_page}};
  return pages;
}

}  // namespace wrlkit
