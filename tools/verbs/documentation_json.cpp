#include "tools/verbs/documentation_json.h"

#include "base/text/json.h"
#include "convert/formats.h"
#include "scenegraph/access_word.h"
#include "tools/verbs/message_help.h"
#include "tools/verbs/node_fates.h"

namespace wrlkit {
namespace {

void write_pass_members(JsonOut& json, const PassInfo& p) {
  json.members("name", p.name, "summary", p.summary, "needs", level_word(p.needs), "leaves", level_word(p.leaves));
  json.list("options", p.make()->options(), [&](const auto& o) {
    const auto range = o.range.empty() ? std::nullopt : std::optional(o.range);
    json.object("name", o.name, "type", o.type, "range", range, "default", o.value, "help", o.help);
  });
  json.list("statistics", p.statistics, [&](const auto& s) { json.object("name", s.name, "help", s.help); });
  json.member("doc", p.doc);
}

void write_pass(JsonOut& json, const PassInfo& p) {
  json.object([&] { write_pass_members(json, p); });
}

void write_type(JsonOut& json, const NodeType& t) {
  json.object([&] {
    json.members("name", t.name, "clauses", t.clauses, "doc", t.doc, "fate", node_fate(t), "bases", t.bases);
    json.list("fields", t.fields, [&](const FieldDef& f) {
      json.object("name", f.name_in(Dialect::vrml97), "access", access_word(f.access), "type", info(f.type).name,
                  "default", f.default_text, "limits", limits_text(f), "doc", doc_text(t, f));
    });
  });
}

}  // namespace

std::string passes_json() {
  return json_text([&](JsonOut& json) {
    json.begin_array();
    for (const auto& p : passes()) write_pass(json, p);
    for (const auto* p : added_passes()) write_pass(json, *p);
    json.end_array();
  });
}

std::string pass_json(const PassInfo& p) {
  return json_text([&](JsonOut& json) { write_pass(json, p); });
}

std::string formats_json() {
  return json_text([&](JsonOut& json) {
    json.list(formats(), [&](const auto& f) {
      json.object("name", f.name, "extensions", f.endings, "read", f.reads, "write", f.writes);
    });
  });
}

std::string explained_nodes_json(std::span<const NodeType* const> types) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("kind", "node", "name", types[0]->name);
      json.list("types", types, [&](const NodeType* t) { write_type(json, *t); });
    });
  });
}

std::string explained_json(const BrowserNode& n) {
  return json_of(json_object("kind", "browser-node", "name", n.name, "browser", n.browser, "doc", n.what, "becomes",
                             fate_text(n.fate)));
}

std::string explained_json(const PassInfo& p) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.member("kind", "pass");
      write_pass_members(json, p);
    });
  });
}

std::string explained_json(Diag d) {
  const auto help = message_explanation(d);
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("kind", "message", "name", info(d).name, "severity", to_string(info(d).severity), "example",
                   help.example);
      if (!help.why.empty()) json.members("why", help.why, "what_to_do", help.what_to_do);
    });
  });
}

std::string pages_json() {
  return json_text([&](JsonOut& json) {
    json.list(documentation_pages(), [&](const DocumentationPage& page) { json.value(page.name); });
  });
}

std::string page_json(const DocumentationPage& page) {
  return json_of(json_object("name", page.name, "markdown", page.text()));
}

}  // namespace wrlkit
