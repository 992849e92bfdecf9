#include "passes/startup/script_run.h"

#include <algorithm>

#include "passes/startup/limits.h"
#include "passes/startup/script_text.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

std::string_view name_or_type(const Scene& scene, NodeId n) {
  const auto name = scene.name(n);
  return name.empty() ? scene.type(n).name : name;
}

}  // namespace

ScriptRun::ScriptRun(Scene& scene, PassContext& ctx)
    : scene_(scene),
      ctx_(ctx),
      host_([this](std::string_view request) { return answer(request); }),
      first_made_(scene.node_count()) {
  for (const Route& r : scene.main.routes) add_route(r);
}

std::optional<std::uint16_t> ScriptRun::slot_of(NodeId n, std::string_view event) const {
  return n ? scene_.type(n).find(event, scene_.dialect(), true) : std::nullopt;
}

void ScriptRun::add_route(const Route& r) {
  const auto slot = slot_of(r.from, r.event_out);
  if (!slot) return;
  routes_[{r.from.value, *slot}].push_back(r);
  const bool later =
      scene_.is(r.from, nodes::X3DSensorNode | nodes::X3DInterpolatorNode) &&
      scene_.type(r.from).fields[*slot].access == Access::out;  // what senses is silent while Scripts start
  if (!later && is_script(scene_, r.to)) entered_.insert(r.to.value);
}

std::string ScriptRun::interface_of(NodeId script) const {
  std::string text;
  JsonOut out(text);
  out.begin_object();
  out.key("fields");
  out.begin_array();
  const auto fields = scene_.type(script).fields;
  for (std::size_t i = n_common_script_fields(); i < fields.size(); ++i) {
    const FieldDef& f = fields[i];
    if (f.access == Access::in || !is_script_type(f.type)) continue;
    out.begin_object();
    out.member("name", f.name);
    out.member("type", info(f.type).name);
    out.member("out", f.access == Access::out || f.access == Access::inout);
    out.member("inout", f.access == Access::inout);
    if (f.has_value()) {
      out.key("value");
      write_value(out, scene_.value(script, static_cast<std::uint16_t>(i)));
    }
    out.end_object();
  }
  out.end_array();
  out.end_object();
  return text;
}

/// Once for each Script; true when its functions can be called.
bool ScriptRun::load(NodeId script) {
  if (const auto known = loaded_.find(script.value); known != loaded_.end()) return known->second;
  bool& runs = loaded_[script.value];
  const auto text = script_text(scene_, script, ctx_.resources, ctx_.diag);
  if (!text) return false;
  std::string fault;
  if (!host_.run(FrameKind::load, script.value, interface_of(script), *text, fault)) return false;
  runs = fault.empty();
  if (!runs) ctx_.diag.report(Diag::script_fault, scene_.where(script), name_or_type(scene_, script), "it", fault);
  return runs;
}

bool ScriptRun::initialize(NodeId script) {
  sent_.clear();
  touched_.clear();
  running_ = script;
  const bool going = call(script, "initialize", nullptr, {}) && cascade();
  // What no event can reach any more is not kept in memory.
  if (going && !entered_.contains(script.value)) {
    host_.drop(script.value);
    loaded_.erase(script.value);
  }
  return going;
}

bool ScriptRun::call(NodeId script, std::string_view function, const Value* value, std::string_view field) {
  const NodeId before = std::exchange(running_, script);
  if (load(script)) {
    std::string text, result;
    JsonOut out(text);
    out.begin_object();
    out.member("name", function);
    if (value) {
      out.member("field", field);
      out.member("type", info(value->type).name);
      out.key("value");
      write_value(out, *value);
    }
    out.end_object();
    if (host_.run(FrameKind::call, script.value, text, {}, result)) take_result(script, function, result);
    touched_.insert(script.value);
  }
  if (host_.fault().empty()) running_ = before;
  return host_.fault().empty();
}

void ScriptRun::take_result(NodeId script, std::string_view function, std::string_view result) {
  JsonDocument doc;
  doc.parse(result);
  const Json root = doc.root();
  const auto where = scene_.where(script);
  if (const auto fault = root["error"].text(); !fault.empty())
    ctx_.diag.report(Diag::script_fault, where, name_or_type(scene_, script), std::string(function) + "()", fault);
  for (const Json event : root["events"]) {
    const auto name = event["name"].text();
    const auto slot = slot_of(script, name);
    const auto& fields = scene_.type(script).fields;
    if (!slot) continue;
    if (const auto value = read_value(scene_, fields[*slot].type, *slot, event["value"]))
      queue_.push_back({script, *slot, *value});
    else
      ctx_.diag.report(Diag::script_fault, where, name_or_type(scene_, script), std::string(function) + "()",
                       std::string(name) + " is not a valid " + std::string(info(fields[*slot].type).name));
  }
}

/// Events in the order in which they were sent, until there are none. An eventOut sends once in an instant, so that
/// loops of ROUTEs end (ISO/IEC 14772-1, 4.10.3).
bool ScriptRun::cascade() {
  for (int round = 0; round < 2; ++round) {
    for (; !queue_.empty(); queue_.pop_front())
      if (const Event event = queue_.front(); !send(event)) return false;
    if (round) break;
    for (const auto script : std::exchange(touched_, {}))
      if (!call(NodeId{script}, "eventsProcessed", nullptr, {})) return false;
  }
  return true;
}

bool ScriptRun::send(const Event& event) {
  if (event.to) return deliver(event, event.to, event.slot, event.event_in);
  const End end{event.from.value, event.slot};
  const auto found = routes_.find(end);
  if (!sent_.insert(end).second || found == routes_.end()) return true;
  const auto targets = found->second;  // a Script may add and delete some meanwhile
  for (const Route& r : targets) {
    const auto slot = slot_of(r.to, r.event_in);
    if (++n_events_ > script_events) return host_.end("more than " + std::to_string(script_events) + " events");
    if (slot && !deliver(event, r.to, *slot, r.event_in)) return false;
  }
  return true;
}

bool ScriptRun::deliver(const Event& event, NodeId to, std::uint16_t slot, std::string_view event_in) {
  const FieldDef& f = scene_.type(to).fields[slot];
  if (f.type != event.value.type) return true;  // ROUTEs of other types were reported when the file was read
  if (is_script(scene_, to) && slot >= n_common_script_fields()) {
    if (!call(to, event_in, &event.value, f.name)) return false;
    if (f.access == Access::inout) queue_.push_back({to, slot, event.value});
    return true;
  }
  if (f.access == Access::in) return deliver_input(event, to, f, event_in);
  if (!f.has_value()) return true;
  Value v = event.value;
  v.slot = slot;
  if (set(to, v)) queue_.push_back({to, slot, v});
  return true;
}

/// An eventIn without a value of its own: children that come and go, `set_coordIndex` of a field `coordIndex`.
bool ScriptRun::deliver_input(const Event& event, NodeId to, const FieldDef& f, std::string_view event_in) {
  if (f.type == FieldType::MFNode && (f.name == "addChildren" || f.name == "removeChildren")) {
    add_or_remove_children(to, event.value, f.name == "addChildren");
    return true;
  }
  if (f.name.starts_with("set_"))
    if (const auto slot = slot_of(to, f.name.substr(4)); slot && scene_.type(to).fields[*slot].type == f.type) {
      Value v = event.value;
      v.slot = *slot;
      set(to, v);
      return true;
    }
  ctx_.diag.report(Diag::event_not_followed, scene_.where(to), name_or_type(scene_, to), event_in);
  return true;
}

void ScriptRun::add_or_remove_children(NodeId group, const Value& children, bool add) {
  const auto slot = scene_.type(group).find("children", Dialect::x3d);
  if (!slot) return;
  const auto now = scene_.value(group, *slot).node_span();
  std::vector<NodeId> all(now.begin(), now.end());
  const auto span = children.node_span();
  const std::set<NodeId> given(span.begin(), span.end());
  if (!add) std::erase_if(all, [&](NodeId n) { return given.contains(n); });
  const std::set<NodeId> held(all.begin(), all.end());
  for (const NodeId n : span)
    if (add && !held.contains(n)) all.push_back(n);
  set(group, scene_.make(FieldType::MFNode, *slot, all));
}

/// False when the field cannot hold that value.
bool ScriptRun::set(NodeId n, Value v) {
  const FieldDef& f = scene_.type(n).fields[v.slot];
  const bool builtin = scene_.type(n).kind == NodeKind::builtin;
  bool fits = true;
  for (const NodeId child : v.node_span()) fits &= !builtin || f.kinds.empty() || f.accepts(scene_.type(child));
  if (f.range.bounded() && info(f.type).element == Element::number)
    for (const double number : v.number_span()) fits &= f.range.contains(number);
  if (!fits) {
    ctx_.diag.report(Diag::script_value, scene_.where(n), name_or_type(scene_, n), f.name);
    return false;
  }
  if (n.value < first_made_ && changed_.insert({n.value, v.slot}).second)
    changes_.push_back({n, v.slot, value_text(scene_.value(n, v.slot))});
  scene_.set(n, v);
  return true;
}

}  // namespace wrlkit
