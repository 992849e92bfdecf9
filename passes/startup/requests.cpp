// What Scripts ask for while they run.
#include <algorithm>

#include "passes/expand_protos/expand_protos.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "passes/startup/limits.h"
#include "passes/startup/script_run.h"
#include "passes/startup/script_text.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

std::string_view header_of(const Scene& scene) {
  return scene.dialect() == Dialect::x3d ? "#X3D V3.3 utf8\nPROFILE Full\n" : "#VRML V2.0 utf8\n";
}

}  // namespace

std::string ScriptRun::answer(std::string_view request) {
  JsonDocument doc;
  doc.parse(request);
  const Json asked = doc.root();
  const auto what = asked["op"].text();
  std::string text;
  JsonOut out(text);
  out.begin_object();
  if (what == "get")
    get(asked, out);
  else if (what == "set")
    set_field(asked, out);
  else if (what == "create")
    create(asked, out);
  else if (what == "route" || what == "unroute")
    route(asked, out, what == "route");
  else if (what == "describe")
    describe(asked, out);
  else if (what == "named")
    find_named(asked, out);
  else if (what == "root")
    add_root(asked);
  else
    ctx_.diag.report(Diag::script_refused, scene_.where(running_), asked["text"].text());
  out.end_object();
  return text;
}

NodeId ScriptRun::node_in(Json request, std::string_view key) const {
  const auto id = request[key].is_number() ? request[key].whole() : std::nullopt;
  return id && *id < scene_.node_count() ? NodeId{static_cast<std::uint32_t>(*id)} : NodeId{};
}

/// Nodes of the world need directOutput (ISO/IEC 14772-1, 6.40); those that Scripts have made are theirs.
bool ScriptRun::may_change(NodeId n) const {
  return n.value >= first_made_ || scene_.get(running_, nodes::script::directOutput);
}

void ScriptRun::get(Json asked, JsonOut& out) {
  const NodeId n = node_in(asked, "node");
  const auto slot = slot_of(n, asked["field"].text());
  if (!slot) return;
  const FieldDef& f = scene_.type(n).fields[*slot];
  if (!f.has_value() || !is_script_type(f.type)) return;
  out.member("type", info(f.type).name);
  out.key("value");
  write_value(out, scene_.value(n, *slot));
}

void ScriptRun::set_field(Json asked, JsonOut& out) {
  const NodeId n = node_in(asked, "node");
  const auto name = asked["field"].text();
  const auto slot = slot_of(n, name);
  if (!slot) return out.member("error", "there is no field '" + std::string(name) + "'");
  if (!may_change(n)) return out.member("error", "directOutput is FALSE: it may not set " + std::string(name));
  const FieldDef& f = scene_.type(n).fields[*slot];
  const auto value = read_value(scene_, f.type, *slot, asked["value"]);
  if (!value) return out.member("error", std::string(name) + " takes an " + std::string(info(f.type).name));
  if (f.access == Access::out) return out.member("error", std::string(name) + " is an eventOut");
  if (!is_script(scene_, n))
    deliver({running_, *slot, *value}, n, *slot, name);
  else if (f.access != Access::init && *slot >= n_common_script_fields())
    queue_.push_back({running_, *slot, *value, n, scene_.keep(name)});
}

void ScriptRun::create(Json asked, JsonOut& out) {
  std::string text(asked["text"].text());
  made_text_ += text.size();
  if (made_text_ > script_made_text || ++made_texts_ > script_made_texts)
    return out.member("error", "createVrmlFromString is given too much");
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || (text[first] != '#' && text[first] != '<')) text.insert(0, header_of(scene_));
  const ParseLimits limits{.depth = script_depth, .nodes = script_made_nodes - made_nodes_};
  PassContext alone(ctx_.diag, ctx_.stats);  // no further files
  if (!ctx_.resources) return out.member("error", "createVrmlFromString needs PassContext::resources");
  const auto world = ctx_.resources->parse(text, "createVrmlFromString", limits, ctx_.diag);
  if (!world) return out.member("error", "the text of createVrmlFromString is not a valid world");
  lower_vrml1(*world, {}, alone);
  expand_protos(*world, {.limit = static_cast<int>(script_made_nodes)}, alone);
  made_nodes_ += world->node_count();
  if (made_nodes_ >= script_made_nodes) return out.member("error", "createVrmlFromString makes too many nodes");
  const auto n_before = static_cast<std::uint32_t>(scene_.node_count());
  const Scope made = scene_.import(*world);
  for (auto n = n_before; n < scene_.node_count(); ++n) scene_.set_where(NodeId{n}, scene_.where(running_));
  for (const Route& r : made.routes) {
    scene_.main.routes.push_back(r);
    add_route(r);
  }
  out.key("nodes");
  out.begin_array();
  for (const NodeId n : made.roots) out.value(n.value);
  out.end_array();
}

void ScriptRun::route(Json asked, JsonOut& out, bool add) {
  const Route r{node_in(asked, "node"), node_in(asked, "to"), scene_.keep(asked["out"].text()),
                scene_.keep(asked["field"].text())};
  const auto from = slot_of(r.from, r.event_out), to = slot_of(r.to, r.event_in);
  if (!from || !to) return out.member("error", "a ROUTE needs an eventOut and an eventIn");
  if (scene_.type(r.from).fields[*from].type != scene_.type(r.to).fields[*to].type)
    return out.member("error", "the types of a ROUTE differ");
  const auto same = [&](const Route& o) {
    return o.from == r.from && o.to == r.to && slot_of(o.from, o.event_out) == from && slot_of(o.to, o.event_in) == to;
  };
  auto& all = scene_.main.routes;
  auto& indexed = routes_[{r.from.value, *from}];
  if (!add) {
    std::erase_if(all, same);
    std::erase_if(indexed, same);
  } else if (std::ranges::none_of(indexed, same)) {
    if (++n_routes_ > script_events) return out.member("error", "too many ROUTEs are added");
    all.push_back(r);
    add_route(r);
  }
  changed_graph_ = true;
}

void ScriptRun::describe(Json asked, JsonOut& out) const {
  const NodeId n = node_in(asked, "node");
  out.member("type", n ? scene_.type(n).name : std::string_view());
  out.member("name", n ? scene_.name(n) : std::string_view());
}

void ScriptRun::find_named(Json asked, JsonOut& out) const {
  const auto name = asked["text"].text();
  for (const NodeId n : reachable(scene_, scene_.main))
    if (!name.empty() && scene_.name(n) == name) return out.member("node", n.value);
}

void ScriptRun::add_root(Json asked) {
  const NodeId n = node_in(asked, "node");
  if (!n || n.value < first_made_ || std::ranges::find(scene_.main.roots, n) != scene_.main.roots.end()) return;
  scene_.main.roots.push_back(n);
  changed_graph_ = true;
}

}  // namespace wrlkit
