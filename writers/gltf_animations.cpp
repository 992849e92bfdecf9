#include "writers/gltf_animations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scenegraph/nodes.h"
#include "writers/gltf_number.h"

namespace wrlkit::gltf {
namespace {

bool is_event(std::string_view event, std::string_view field) { return event == field || event == "set_" + std::string(field); }

std::span<const double> keys(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::PositionInterpolator) ? scene.get(n, nodes::position_interpolator::key) : scene.get(n, nodes::orientation_interpolator::key);
}

std::span<const double> values(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::PositionInterpolator) ? scene.get(n, nodes::position_interpolator::keyValue) : scene.get(n, nodes::orientation_interpolator::keyValue);
}

/// A vector or a quaternion.
using Sample = std::array<double, 4>;

double dot(const Sample& a, const Sample& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

Sample mix(const Sample& a, Sample b, double t, bool rotation) {
  double wa = 1 - t, wb = t;
  if (rotation) {
    double c = dot(a, b);
    if (c < 0) c = -c, b = {-b[0], -b[1], -b[2], -b[3]};
    if (const double angle = std::acos(std::min(c, 1.0)); angle > 1e-6) wa = std::sin((1 - t) * angle) / std::sin(angle), wb = std::sin(t * angle) / std::sin(angle);
  }
  return {wa * a[0] + wb * b[0], wa * a[1] + wb * b[1], wa * a[2] + wb * b[2], wa * a[3] + wb * b[3]};
}

struct Frame {
  double key;
  Sample value;
};

/// What an interpolator says at fraction 0, at 1, and at its keys between them (ISO/IEC 14772-1, 4.6.8).
std::vector<Frame> frames(std::span<const double> key, const std::vector<Sample>& value, bool rotation) {
  std::vector<Frame> out;
  const std::size_t n = std::min(key.size(), value.size());
  auto between = [&](std::size_t i, double f) { return mix(value[i], value[i + 1], (f - key[i]) / (key[i + 1] - key[i]), rotation); };
  auto add = [&](double k, const Sample& v) {
    const bool again = out.size() > 1 && out.back().key == k && out[out.size() - 2].key == k;  // of more than two equal keys, the last counts
    if (again) out.back().value = v;
    else out.push_back({k, v});
  };
  if (key[0] > 0) add(0, value[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const bool crosses_0 = i + 1 < n && key[i] < 0 && key[i + 1] > 0, crosses_1 = i + 1 < n && key[i] < 1 && key[i + 1] > 1;
    if (key[i] >= 0 && key[i] <= 1) add(key[i], value[i]);
    if (crosses_0) add(0, between(i, 0));
    if (crosses_1) add(1, between(i, 1));
  }
  if (out.empty()) add(0, key[0] > 1 ? value[0] : value[n - 1]);
  if (out.back().key < 1) add(1, out.back().value);
  return out;
}

/// Rotations follow one another without a change of sign; between distant ones stands one more.
std::vector<Frame> continuous(const std::vector<Frame>& in) {
  constexpr double distant = 0.1;  // cosine of half the angle
  std::vector<Frame> out;
  for (Frame f : in) {
    if (!out.empty()) {
      const Frame last = out.back();
      if (dot(last.value, f.value) < 0) for (double& v : f.value) v = -v;
      if (dot(last.value, f.value) < distant && f.key > last.key) out.push_back({(last.key + f.key) / 2, mix(last.value, f.value, 0.5, true)});
    }
    out.push_back(f);
  }
  return out;
}

}  // namespace

Animations::Animations(const Scene& scene, bool wanted, Diagnostics& diag) : scene_(scene), diag_(diag) {
  if (!wanted) return;
  const auto& routes = scene.main.routes;
  std::multimap<std::uint32_t, const Route*> onward;
  for (const Route& r : routes) onward.emplace(r.from.value, &r);
  std::set<const Route*> expressed;
  for (const Route& r : routes) {
    if (!scene.is(r.from, nodes::TimeSensor) || r.event_out != "fraction_changed" || r.event_in != "set_fraction") continue;
    if (!scene.is(r.to, nodes::PositionInterpolator) && !scene.is(r.to, nodes::OrientationInterpolator)) continue;
    auto key = keys(scene, r.to);
    if (key.empty() || values(scene, r.to).empty()) continue;
    if (!std::ranges::is_sorted(key)) {
      diag.report(Diag::no_gltf_value, scene.where(r.to), scene.type(r.to).name, "key, as it does not ascend,");
      continue;
    }
    for (auto [i, end] = onward.equal_range(r.to.value); i != end; ++i) {
      Path path{};
      if (!drives(*i->second, path)) continue;
      channels_[r.from.value].push_back({r.to, i->second->to, path});
      moved_[{i->second->to.value, path}];
      expressed.insert(&r), expressed.insert(i->second);
    }
  }
  n_routes_ = expressed.size();
  for (const Route& r : routes)
    for (NodeId n : {r.from, r.to}) {
      auto& [all, said] = routes_[n.value];
      ++all;
      said += expressed.contains(&r);
    }
}

bool Animations::drives(const Route& r, Path& path) const {
  if (r.event_out != "value_changed") return false;
  const bool turns = scene_.is(r.from, nodes::OrientationInterpolator);
  if (scene_.is(r.to, nodes::Transform)) {
    if (turns) return path = Path::rotation, is_event(r.event_in, "rotation");
    path = is_event(r.event_in, "scale") ? Path::scale : Path::translation;
    return path == Path::scale || is_event(r.event_in, "translation");
  }
  path = turns ? Path::rotation : Path::translation;
  return scene_.is(r.to, nodes::Viewpoint) && is_event(r.event_in, turns ? "orientation" : "position");
}

bool Animations::expressed(NodeId n) const {
  auto i = routes_.find(n.value);
  return i != routes_.end() && i->second.first == i->second.second;
}

void Animations::add_target(NodeId source, Path p, std::uint32_t node) {
  if (auto i = moved_.find({source.value, p}); i != moved_.end()) i->second.push_back(node);
}

void Animations::store(Store& store, const std::function<Vec3(std::uint32_t)>& offset) {
  for (const auto& [clock, channels] : channels_) {
    Written w{NodeId{clock}, {}, {}};
    const double cycle = scene_.get(w.clock, nodes::time_sensor::cycleInterval);
    for (const auto& c : channels) add_channel(w, c, cycle > 0 && fits_float(cycle) ? cycle : 1, store, offset);
    if (!w.channels.empty()) written_.push_back(std::move(w));
  }
}

void Animations::add_channel(Written& w, const Channel& c, double cycle, Store& store, const std::function<Vec3(std::uint32_t)>& offset) {
  const bool turns = c.path == Path::rotation;
  const auto raw = values(scene_, c.interpolator);
  const std::size_t width = turns ? 4 : 3;
  std::vector<Sample> value;
  for (std::size_t i = 0; i + width <= raw.size(); i += width) {
    if (!turns) { value.push_back({raw[i], raw[i + 1], raw[i + 2], 0}); continue; }
    const Quaternion q = quaternion({raw[i], raw[i + 1], raw[i + 2], raw[i + 3]});
    value.push_back({q.x, q.y, q.z, q.w});
  }
  auto all = frames(keys(scene_, c.interpolator), value, turns);
  if (turns) all = continuous(all);
  std::vector<float> time;
  for (const Frame& f : all) {
    auto t = static_cast<float>(f.key * cycle);
    if (!time.empty() && t <= time.back()) t = std::nextafter(time.back(), std::numeric_limits<float>::infinity());
    time.push_back(t);
  }
  std::map<Vec3, std::uint32_t> by_offset;
  for (std::uint32_t node : moved_[{c.target.value, c.path}]) {
    const bool twice = std::ranges::any_of(w.channels, [&](const WrittenChannel& k) { return k.node == node && k.path == c.path; });
    if (twice) continue;
    const Vec3 by = c.path == Path::translation ? offset(node) : Vec3{0, 0, 0};
    auto [at, is_new] = by_offset.try_emplace(by, static_cast<std::uint32_t>(w.samplers.size()));
    if (is_new) {
      std::vector<float> out;
      for (const Frame& f : all)
        for (std::size_t k = 0; k < width; ++k) out.push_back(to_float(f.value[k] + (k < 3 ? by[k] : 0)));
      w.samplers.push_back({store.times(time), store.vertices(turns ? View::moving4 : View::moving3, out)});
    }
    w.channels.push_back({at->second, node, c.path});
  }
}

void Animations::write(JsonOut& json, std::size_t i, const std::function<std::uint32_t(std::uint32_t)>& accessor) const {
  constexpr std::string_view paths[] = {"translation", "rotation", "scale"};
  const Written& w = written_[i];
  json.begin_object();
  if (auto name = scene_.name(w.clock); !name.empty()) json.member("name", name);
  json.key("channels");
  json.begin_array();
  for (const auto& c : w.channels) {
    json.begin_object();
    json.member("sampler", c.sampler);
    json.key("target");
    json.begin_object();
    json.member("node", c.node);
    json.member("path", paths[static_cast<std::size_t>(c.path)]);
    json.end_object();
    json.end_object();
  }
  json.end_array();
  json.key("samplers");
  json.begin_array();
  for (const auto& s : w.samplers) {
    json.begin_object();
    json.member("input", accessor(s.input));
    json.member("output", accessor(s.output));
    json.end_object();
  }
  json.end_array();
  json.end_object();
}

}  // namespace wrlkit::gltf
