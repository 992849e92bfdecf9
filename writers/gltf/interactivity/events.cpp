#include "writers/gltf/interactivity/events.h"

#include <algorithm>
#include <functional>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/gltf/interactivity/scripts.h"

namespace wrlkit::gltf {
namespace {

struct Row {
  TypeId type;
  std::uint16_t slot;
  Act act = {};
};

/// Events that happen by themselves.
bool happens(const Scene& scene, NodeId n, std::uint16_t slot) {
  using namespace nodes;
  static constexpr Row rows[] = {{TouchSensor, touch_sensor::touchTime.slot},
                                 {TouchSensor, touch_sensor::isActive.slot},
                                 {TouchSensor, touch_sensor::isOver.slot},
                                 {ProximitySensor, proximity_sensor::isActive.slot},
                                 {ProximitySensor, proximity_sensor::enterTime.slot},
                                 {ProximitySensor, proximity_sensor::exitTime.slot},
                                 {ProximitySensor, proximity_sensor::position_changed.slot},
                                 {ProximitySensor, proximity_sensor::orientation_changed.slot},
                                 {VisibilitySensor, visibility_sensor::isActive.slot},
                                 {VisibilitySensor, visibility_sensor::enterTime.slot},
                                 {VisibilitySensor, visibility_sensor::exitTime.slot},
                                 {TimeSensor, time_sensor::isActive.slot},
                                 {TimeSensor, time_sensor::cycleTime.slot},
                                 {TimeSensor, time_sensor::fraction_changed.slot}};
  return std::ranges::any_of(rows, [&](const Row& r) { return r.slot == slot && scene.is(n, r.type); });
}

std::optional<Act> act_of(const Scene& scene, NodeId n, std::uint16_t slot) {
  using namespace nodes;
  using enum Act;
  static constexpr Row rows[] = {{TimeSensor, time_sensor::startTime.slot, start},
                                 {TimeSensor, time_sensor::stopTime.slot, stop},
                                 {TimeSensor, time_sensor::enabled.slot, run_or_halt},
                                 {TimeSensor, time_sensor::loop.slot, repeat},
                                 {Switch, switch_::whichChoice.slot, choose},
                                 {Transform, transform::translation.slot, move},
                                 {Transform, transform::rotation.slot, move},
                                 {Transform, transform::scale.slot, move},
                                 {DirectionalLight, directional_light::on.slot, shine},
                                 {PointLight, point_light::on.slot, shine},
                                 {SpotLight, spot_light::on.slot, shine},
                                 {Viewpoint, viewpoint::set_bind.slot, bind},
                                 {AudioClip, audio_clip::startTime.slot, sound},
                                 {AudioClip, audio_clip::stopTime.slot, sound},
                                 {AudioClip, audio_clip::loop.slot, sound},
                                 {AudioClip, audio_clip::pitch.slot, sound},
                                 {nodes::Sound, nodes::sound::intensity.slot, Act::sound},
                                 {TouchSensor, touch_sensor::enabled.slot, listen},
                                 {ProximitySensor, proximity_sensor::enabled.slot, listen},
                                 {VisibilitySensor, visibility_sensor::enabled.slot, listen},
                                 {BooleanFilter, boolean_filter::set_boolean.slot, filter},
                                 {BooleanToggle, boolean_toggle::set_boolean.slot, toggle},
                                 {BooleanToggle, boolean_toggle::toggle.slot, set_toggle},
                                 {BooleanTrigger, boolean_trigger::set_triggerTime.slot, trigger_true},
                                 {IntegerTrigger, integer_trigger::set_boolean.slot, trigger_integer},
                                 {TimeTrigger, time_trigger::set_boolean.slot, trigger_time},
                                 {BooleanSequencer, boolean_sequencer::set_fraction.slot, at_fraction},
                                 {BooleanSequencer, boolean_sequencer::next.slot, next},
                                 {BooleanSequencer, boolean_sequencer::previous.slot, previous},
                                 {IntegerSequencer, integer_sequencer::set_fraction.slot, at_fraction},
                                 {IntegerSequencer, integer_sequencer::next.slot, next},
                                 {IntegerSequencer, integer_sequencer::previous.slot, previous}};
  for (const Row& r : rows)
    if (r.slot == slot && scene.is(n, r.type)) return r.act;
  if (is_script_event(scene, n, slot)) return tell_script;
  return std::nullopt;
}

/// Nodes that make other events of those that reach them.
bool passes_on(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::X3DTriggerNode) || scene.is(n, nodes::X3DSequencerNode) ||
         scene.is(n, nodes::BooleanFilter) || scene.is(n, nodes::BooleanToggle);
}

std::optional<std::uint16_t> event_slot(const Scene& scene, NodeId n, std::string_view event) {
  return scene.type(n).find(event, scene.dialect(), true);
}

FieldType field_type(const Scene& scene, NodeId n, std::uint16_t slot) { return scene.type(n).fields[slot].type; }

/// Can that event be the beginning or a part of what the graph says?
bool can_be_sent(const Scene& scene, NodeId n, std::uint16_t slot) {
  return passes_on(scene, n) || happens(scene, n, slot) || is_script_event(scene, n, slot);
}

}  // namespace

Events::Events(const Scene& scene, const Motion& motion, bool on) : scene_(scene), on_(on) {
  if (!on) return;
  add_routes();
  for (const NodeId n : reachable(scene, scene.main))
    if (is_script(scene, n) && scene.get(n, nodes::script::directOutput)) add_direct_output(n);
  find_useful(motion);
  collect();
}

void Events::add_routes() {
  for (const Route& r : scene_.main.routes) {
    const auto out = event_slot(scene_, r.from, r.event_out), in = event_slot(scene_, r.to, r.event_in);
    if (!out || !in || field_type(scene_, r.from, *out) != field_type(scene_, r.to, *in)) continue;
    if (can_be_sent(scene_, r.from, *out)) add(r, *out, *in);
  }
}

void Events::add(const Route& r, Slot out, Slot in) {
  const auto act = act_of(scene_, r.to, in);
  if (act == Act::choose && hierarchy_children(scene_, r.to).empty()) return;
  if (act) possible_.emplace(r.from.value, Possible{out, {&r, r.to, in, *act}});
}

/// To what it holds in its fields, also in those with several nodes: "all[2].translation".
void Events::add_direct_output(NodeId script) {
  constexpr std::size_t most_held = 1000;
  const auto fields = scene_.type(script).fields;
  for (auto slot = static_cast<Slot>(n_common_script_fields()); slot < fields.size(); ++slot) {
    const FieldDef& f = fields[slot];
    if (!f.has_value() || (f.type != FieldType::SFNode && f.type != FieldType::MFNode)) continue;
    const auto held = scene_.value(script, slot).node_span();
    for (std::size_t i = 0; i < std::min(held.size(), most_held); ++i) {
      const std::string index = f.type == FieldType::MFNode ? "[" + std::to_string(i) + "]" : "";
      if (held[i]) add_direct_output(script, slot, held[i], std::string(f.name) + index + ".");
    }
  }
}

void Events::add_direct_output(NodeId script, Slot field, NodeId held, const std::string& name) {
  const auto fields = scene_.type(held).fields;
  for (Slot slot = 0; slot < fields.size(); ++slot) {
    if (is_script(scene_, held) || fields[slot].access == Access::out || !act_of(scene_, held, slot)) continue;
    const auto& text = names_.emplace_back(name + std::string(fields[slot].name));
    direct_.push_back({script, held, text, fields[slot].name});
    add(direct_.back(), field, slot);
  }
}

/// Backwards from what changes: an event that reaches such a node, or happens there, leads somewhere. Rings of ROUTEs
/// do not.
void Events::find_useful(const Motion& motion) {
  std::multimap<std::uint32_t, std::uint32_t> before;
  std::vector<std::uint32_t> pending(motion.clocks().begin(), motion.clocks().end());
  for (const auto& [from, possible] : possible_) {
    const NodeId to = possible.hop.to;
    before.emplace(to.value, from);
    const bool ends = possible.hop.act != Act::tell_script && !scene_.is(to, nodes::TimeSensor);
    if (ends && !passes_on(scene_, to)) pending.push_back(to.value);
  }
  while (!pending.empty()) {
    const auto n = pending.back();
    pending.pop_back();
    if (!useful_.insert(n).second) continue;
    for (auto [at, end] = before.equal_range(n); at != end; ++at) pending.push_back(at->second);
  }
}

/// From every node that something happens to, along the ROUTEs that lead somewhere.
void Events::collect() {
  for (NodeId n : reachable(scene_, scene_.main)) {
    const bool anchor = scene_.is(n, nodes::Anchor) && !scene_.get(n, nodes::anchor::url).empty();
    const bool sensor = !passes_on(scene_, n) && possible_.contains(n.value);
    if (!anchor && !scene_.is(n, nodes::TimeSensor) && !sensor) continue;
    if (!anchor && !useful_.contains(n.value)) continue;
    sources_.push_back(n);
    spread(n);
  }
  std::ranges::sort(sources_, {}, &NodeId::value);
}

/// A ROUTE of the file, not one that stands for what a Script sets.
bool Events::is_of_scene(const Route& r) const {
  const auto& all = scene_.main.routes;
  const std::less<> before;
  return !before(&r, all.data()) && before(&r, all.data() + all.size());
}

/// Everything that follows from what happens to a node.
void Events::spread(NodeId source) {
  std::vector<NodeId> pending{source};
  while (!pending.empty()) {
    const NodeId n = pending.back();
    pending.pop_back();
    for (auto [at, end] = possible_.equal_range(n.value); at != end; ++at) {
      const auto& [slot, hop] = at->second;
      auto& said = is_of_scene(*hop.route) ? said_ : said_directly_;
      if (!useful_.contains(hop.to.value) || !said.insert(hop.route).second) continue;
      hops_[{n.value, slot}].push_back(hop);
      set_.insert({hop.to.value, hop.slot});
      pending.push_back(hop.to);
    }
  }
}

std::span<const Events::Hop> Events::from(NodeId n, Slot s) const {
  const auto at = hops_.find({n.value, s});
  return at == hops_.end() ? std::span<const Hop>() : at->second;
}

bool Events::sets(NodeId n, std::string_view field) const {
  const auto slot = scene_.type(n).find(field, Dialect::x3d);
  return slot && sets(n, *slot);
}

void Events::report(const Scene& scene, const Motion& motion, Diagnostics& diag) const {
  if (!on_) return;
  std::set<std::pair<std::string_view, std::string_view>> told;  // types and events
  for (const Route& r : scene.main.routes) {
    if (says(r) || motion.says(r)) continue;
    const auto slot = event_slot(scene, r.from, r.event_out);
    const bool sent = slot && can_be_sent(scene, r.from, *slot);
    const NodeId n = sent ? r.to : r.from;
    const auto type = scene.type(n).name, event = sent ? r.event_in : r.event_out;
    if (told.emplace(type, event).second) diag.report(Diag::no_gltf_value, scene.where(n), type, event);
  }
}

}  // namespace wrlkit::gltf
