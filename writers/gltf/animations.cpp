#include "writers/gltf/animations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/nodes.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

constexpr std::string_view paths[] = {"translation", "rotation", "scale"};

/// The field that holds a property of a node.
std::optional<std::uint16_t> slot_of(const Scene& scene, NodeId n, Path p) {
  using namespace nodes;
  if (scene.is(n, Transform))
    return p == Path::translation ? transform::translation.slot
           : p == Path::rotation  ? transform::rotation.slot
                                  : transform::scale.slot;
  if (scene.is(n, Viewpoint) && p != Path::scale)
    return p == Path::translation ? viewpoint::position.slot : viewpoint::orientation.slot;
  if (scene.is(n, PointLight) && p == Path::translation) return point_light::location.slot;
  if (scene.is(n, SpotLight) && p == Path::translation) return spot_light::location.slot;
  return std::nullopt;
}

Sample sample_of(const std::vector<double>& v) { return {v[0], v[1], v[2], v[3]}; }

double inner_product(const std::vector<double>& a, const std::vector<double>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// Rotations follow one another without a change of sign; between distant ones stands one more.
template <class Frame>
std::vector<Frame> continuous(const std::vector<Frame>& in) {
  constexpr double distant = 0.1;  // cosine of half the angle
  std::vector<Frame> out;
  for (Frame f : in) {
    if (!out.empty()) {
      const Frame last = out.back();
      if (inner_product(last.value, f.value) < 0)
        for (double& v : f.value) v = -v;
      if (inner_product(last.value, f.value) < distant && f.at > last.at) {
        const Sample middle = mix(sample_of(last.value), sample_of(f.value), 0.5, true);
        out.push_back({(last.at + f.at) / 2, {middle.begin(), middle.end()}});
      }
    }
    out.push_back(std::move(f));
  }
  return out;
}

View view_of(std::size_t width) {
  return width == 2 ? View::moving2 : width == 3 ? View::moving3 : width == 4 ? View::moving4 : View::moving1;
}

}  // namespace

std::string_view name_of(Path p) { return paths[static_cast<std::size_t>(p)]; }

Animations::Animations(const Scene& scene, Motion::Reach reach, bool interactive, Diagnostics& diag)
    : scene_(scene), diag_(diag), motion_(scene, reach, diag), events_(scene, motion_, interactive) {
  events_.report(scene, motion_, diag);
  motion_.add_expressed(events_.said());
  for (const Route& r : scene.main.routes)
    if (scene.is(r.to, nodes::TimeSensor)) triggers_[r.to.value].push_back(&r);
}

bool Animations::moves(NodeId n, Path p) const {
  auto slot = n ? slot_of(scene_, n, p) : std::nullopt;
  return slot && (motion_.moves(n, *slot) || events_.sets(n, *slot));
}

void Animations::add_target(NodeId source, Path p, std::uint32_t node) {
  if (moves(source, p)) moved_[{source.value, p}].push_back(node);
}

std::span<const std::uint32_t> Animations::targets(NodeId source, Path p) const {
  const auto at = moved_.find({source.value, p});
  return at == moved_.end() ? std::span<const std::uint32_t>() : at->second;
}

std::optional<std::uint32_t> Animations::index_of(NodeId clock) const {
  const auto at = std::ranges::find(written_, clock, &Written::clock);
  if (at == written_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - written_.begin());
}

double Animations::cycle_of(NodeId clock) const {
  const double cycle = scene_.get(clock, nodes::time_sensor::cycleInterval);
  return cycle > 0 && fits_float(cycle) ? cycle : 1;
}

void Animations::renumber(std::span<const std::uint32_t> became) {
  for (auto& [key, nodes] : moved_)
    for (auto& n : nodes) n = became[n];
}

/// Nodes of glTF that one field moves, with the same offset, are one property.
void Animations::add_transforms(const std::function<Vec3(std::uint32_t)>& offset) {
  for (const auto& [key, nodes] : moved_) {
    const auto [source, path] = key;
    const std::size_t width = path == Path::rotation ? 4 : 3;
    std::map<Vec3, std::vector<std::uint32_t>> by_offset;
    for (auto node : nodes) by_offset[path == Path::translation ? offset(node) : Vec3{0, 0, 0}].push_back(node);
    for (const auto& [by, same] : by_offset) {
      auto evaluate = [by = by, width](std::span<const Property::At> in, std::vector<double>& out) {
        const Sample s = in[0].value({});
        for (std::size_t k = 0; k < width; ++k) out.push_back(s[k] + (k < 3 ? by[k] : 0));
      };
      add({same, std::string(name_of(path)), width, {{source, *slot_of(scene_, NodeId{source}, path)}}, evaluate});
    }
  }
}

/// One property of glTF, as a colour with its opacity, that two clocks would move, each a part of it.
void Animations::report_clocks_at_odds(const Property& p) const {
  const auto clocks = [&](const Motion::Field& field) {
    std::vector<NodeId> out;
    for (const auto& d : motion_.drives(NodeId{field.first}, field.second)) out.push_back(d.clock);
    return out;
  };
  const Motion::Field* first = nullptr;
  for (const Motion::Field& field : p.inputs) {
    const auto of_field = clocks(field);
    if (of_field.empty()) continue;
    if (!first) first = &field;
    if (of_field == clocks(*first)) continue;
    const NodeId n{field.first};
    const auto name = [&](const Motion::Field& f) {
      return std::string(scene_.type(n).fields[f.second].name_in(scene_.dialect()));
    };
    diag_.report(Diag::no_gltf_value, scene_.where(n), scene_.type(n).name,
                 name(field) + ", animated by another TimeSensor than " + name(*first) + ",");
  }
}

void Animations::store(Store& store, const std::function<Vec3(std::uint32_t)>& offset) {
  add_transforms(offset);
  std::map<std::uint32_t, std::set<std::uint32_t>> of_clock;
  for (const Property& p : properties_) report_clocks_at_odds(p);
  for (std::uint32_t p = 0; p < properties_.size(); ++p)
    for (const auto& [node, slot] : properties_[p].inputs)
      for (const auto& d : motion_.drives(NodeId{node}, slot)) of_clock[d.clock.value].insert(p);
  for (const auto& [clock, properties] : of_clock) {
    Written w{NodeId{clock}, {}, {}, {}};
    for (auto p : properties) add_channel(w, p, cycle_of(w.clock), store);
    if (!w.channels.empty()) written_.push_back(std::move(w));
  }
  for (const Written& w : written_)
    if (waits_for_more(w.clock)) diag_.report(Diag::no_gltf_trigger, scene_.where(w.clock), scene_.name(w.clock));
}

/// Is it started by something that the file does not say?
bool Animations::waits_for_more(NodeId clock) const {
  const auto at = triggers_.find(clock.value);
  return at != triggers_.end() && !std::ranges::all_of(at->second, [&](const Route* r) { return motion_.says(*r); });
}

void Animations::add_channel(Written& w, std::uint32_t id, double cycle, Store& store) {
  const Property& p = properties_[id];
  std::vector<const Curve*> curves;
  for (const auto& [node, slot] : p.inputs) {
    curves.push_back(nullptr);
    for (const auto& d : motion_.drives(NodeId{node}, slot))
      if (d.clock == w.clock) curves.back() = &motion_.curve(d.curve);
  }
  auto all = frames(p, curves);
  if (p.path == "rotation" && !p.nodes.empty()) all = continuous(all);
  std::vector<float> time, out;
  for (const Frame& f : all) {
    auto t = static_cast<float>(f.at * cycle);
    if (!time.empty() && t <= time.back()) t = std::nextafter(time.back(), std::numeric_limits<float>::infinity());
    time.push_back(t);
    for (double v : f.value) out.push_back(to_float(v));
  }
  const Sampler s{store.times(time), store.vertices(view_of(p.path == "weights" ? 1 : p.width), out)};
  auto [known, is_new] = w.known.try_emplace({s.input, s.output}, static_cast<std::uint32_t>(w.samplers.size()));
  if (is_new) w.samplers.push_back(s);
  const auto at = known->second;
  if (p.nodes.empty()) {
    w.channels.push_back({at, none, id});
    pointers_ = true;
  }
  for (auto node : p.nodes) w.channels.push_back({at, node, id});
}

/// Wherever a curve has a frame, and between them where it is not straight.
std::vector<Animations::Frame> Animations::frames(const Property& p, std::span<const Curve* const> curves) const {
  std::vector<double> ats;
  for (const Curve* c : curves)
    for (std::size_t i = 0; c && i < c->frames.size(); ++i) ats.push_back(c->frames[i].at);
  std::ranges::sort(ats);
  ats.erase(std::unique(ats.begin(), ats.end()), ats.end());
  auto value = [&](double at, Curve::Side side) {
    std::vector<Property::At> inputs;
    for (const Curve* c : curves) inputs.push_back({&scene_, c, c ? c->place(at, side) : 0});
    std::vector<double> out;
    p.evaluate(inputs, out);
    return out;
  };
  std::vector<Frame> out;
  for (double at : ats) {
    Frame before{at, value(at, Curve::Side::before)}, behind{at, value(at, Curve::Side::behind)};
    if (!out.empty()) {
      if (!p.straight) cut(out, before, value);
      if (before.value != behind.value) out.push_back(std::move(before));
    }
    out.push_back(std::move(behind));
  }
  return out;
}

/// Adds what is needed between the last frame and the next.
void Animations::cut(std::vector<Frame>& out, const Frame& to,
                     const std::function<std::vector<double>(double, Curve::Side)>& value) const {
  constexpr int most_pieces = 64;
  constexpr double tolerance = 1e-3;
  const Frame from = out.back();
  int pieces = 1;
  std::vector<Frame> inner{from, to};
  auto close = [&] {
    for (std::size_t i = 0; i + 1 < inner.size(); ++i)
      for (double t : {0.25, 0.5, 0.75}) {
        const auto exact = value(inner[i].at + t * (inner[i + 1].at - inner[i].at), Curve::Side::behind);
        for (std::size_t k = 0; k < exact.size(); ++k) {
          const double a = inner[i].value[k], b = inner[i + 1].value[k];
          if (std::abs(exact[k] - (a + t * (b - a))) > tolerance * std::max({1.0, std::abs(a), std::abs(b)}))
            return false;
        }
      }
    return true;
  };
  while (pieces < most_pieces && !close()) {
    pieces *= 2;
    inner.assign(1, from);
    for (int i = 1; i < pieces; ++i) {
      const double at = from.at + (to.at - from.at) * i / pieces;
      inner.push_back({at, value(at, Curve::Side::behind)});
    }
    inner.push_back(to);
  }
  out.insert(out.end(), inner.begin() + 1, inner.end() - 1);
}

void Animations::write_target(JsonOut& json, const Channel& c) const {
  const Property& p = properties_[c.property];
  json.object("target", [&] {
    if (c.node != none) json.member("node", c.node);
    json.member("path", c.node == none ? "pointer" : std::string_view(p.path));
    if (c.node == none) {
      json.object("extensions", [&] { json.member("KHR_animation_pointer", json_object("pointer", p.path)); });
    }
  });
}

void Animations::write(JsonOut& json, std::size_t i, const Extras* extras,
                       const std::function<std::uint32_t(std::uint32_t)>& accessor) const {
  const Written& w = written_[i];
  const auto trigger = triggers_.find(w.clock.value);
  const bool waits = trigger != triggers_.end();
  json.object([&] {
    std::string name(extras && waits ? extras->name(w.clock) : scene_.name(w.clock));
    if (name.empty() && waits) name = "animation_" + std::to_string(i);
    if (!name.empty()) json.member("name", name);
    json.list("channels", w.channels, [&](const auto& c) {
      json.object([&] {
        json.member("sampler", c.sampler);
        write_target(json, c);
      });
    });
    json.list("samplers", w.samplers,
              [&](const auto& s) { json.object("input", accessor(s.input), "output", accessor(s.output)); });
    if (extras) {
      json.object("extras", [&] {
        json.object("vrml97", [&] {
          json.member("loop", scene_.get(w.clock, nodes::time_sensor::loop));
          if (waits) {
            json.key("trigger");
            json.begin_array();
            for (const Route* r : trigger->second) extras->route(json, *r);
            json.end_array();
          }
        });
      });
    }
  });
}

}  // namespace wrlkit::gltf
