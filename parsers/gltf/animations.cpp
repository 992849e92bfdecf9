#include "parsers/gltf/animations.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

constexpr int most_pieces = 64;
constexpr double tolerance = 1e-3;

/// Hermite's cubic (glTF 2.0, appendix C.5).
double cubic(double a, double a_out, double b, double b_in, double span, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a + span * (t3 - 2 * t2 + t) * a_out + (-2 * t3 + 3 * t2) * b +
         span * (t3 - t2) * b_in;
}

}  // namespace

std::set<std::uint32_t> moved_nodes(File& file) {
  std::set<std::uint32_t> out;
  for (std::size_t a = 0; a < file.count(Table::animations); ++a)
    for (Json c : file.at(Table::animations, a)["channels"].elements()) {
      if (auto n = c["target"]["node"].whole();
          n && *n < file.count(Table::nodes) && c["target"]["path"].text() != "weights")
        out.insert(static_cast<std::uint32_t>(*n));
      if (auto p = node_path(c["target"]["extensions"]["KHR_animation_pointer"]["pointer"].text());
          p && p->second != "weights")
        out.insert(p->first);
    }
  return out;
}

void Animations::build() {
  for (std::size_t i = 0; i < c_.file.count(Table::animations); ++i)
    animation(c_.file.at(Table::animations, i), i == 0);
  for (const auto& [node, morphs] : hierarchy_.morphs())
    if (!morphed_.contains(node))
      c_.lost.add("morph targets (as their weights stand)", c_.file.where(c_.file.at(Table::nodes, node)));
  c_.scene.main.roots.insert(c_.scene.main.roots.end(), made_.begin(), made_.end());
}

double Animations::duration(Json a) {
  double last = 0;
  for (Json s : a["samplers"].elements())
    if (auto in = c_.accessors.numbers(c_.file.index(Table::accessors, s["input"]), {1}))
      for (double t : in->values) last = std::max(last, t);
  return last > 0 ? last : 1;
}

/// What wrlkit wrote and another program has kept is there as the TimeSensor that it was, with its ROUTEs.
bool Animations::came_back(Json a) const {
  const NodeId clock = vrml97(a) ? extras_.named(a["name"].text()) : NodeId{};
  return c_.scene.is(clock, nodes::TimeSensor) &&
         std::ranges::any_of(c_.scene.main.routes, [&](const Route& r) { return r.from == clock; });
}

void Animations::animation(Json a, bool runs) {
  if (came_back(a)) return;
  namespace f = nodes::time_sensor;
  NodeId clock = c_.add(nodes::TimeSensor, a);
  const double whole = duration(a);
  c_.scene.set(clock, f::cycleInterval, whole, f::loop, vrml97(a)["loop"].boolean(true));
  if (!runs) c_.scene.set(clock, f::enabled, false);
  c_.set_name(clock, a["name"]);
  made_.push_back(clock);
  for (Json c : a["channels"].elements()) channel(c, a, clock, whole);
  c_.lost.keep(c_.file, a);
}

/// The samples of a sampler, straight between each other.
std::optional<Animations::Track> Animations::track(Json sampler, std::size_t width) {
  auto in = c_.accessors.numbers(c_.file.index(Table::accessors, sampler["input"]), {1});
  auto out = c_.accessors.numbers(c_.file.index(Table::accessors, sampler["output"]), {1, 3, 4});
  if (!in || !out) return std::nullopt;
  const auto how = sampler["interpolation"].text("LINEAR");
  const std::size_t n = in->count(), per_key = width * (how == "CUBICSPLINE" ? 3 : 1);
  if (out->values.size() != n * per_key || !std::ranges::is_sorted(in->values)) {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(sampler), "sampler whose keys and values do not fit");
    return std::nullopt;
  }
  if (how == "CUBICSPLINE") return spline(*in, *out, width);
  Track t;
  auto value = [&](std::size_t i) {
    return std::vector<double>(out->values.begin() + static_cast<std::ptrdiff_t>(i * width),
                               out->values.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (how == "STEP" && i > 0) {
      t.time.push_back(in->values[i]);
      t.value.push_back(t.value.back());
    }
    t.time.push_back(in->values[i]);
    t.value.push_back(value(i));
  }
  return t;
}

Animations::Track Animations::spline(const Numbers& in, const Numbers& out, std::size_t width) const {
  Track t;
  double largest = 1e-9;
  for (std::size_t i = 0; i < in.count(); ++i)
    for (std::size_t k = 0; k < width; ++k) largest = std::max(largest, std::abs(out.values[(3 * i + 1) * width + k]));
  auto part = [&](std::size_t i, int which, std::size_t k) {
    return out.values[(3 * i + static_cast<std::size_t>(which)) * width + k];
  };
  auto at = [&](std::size_t i, double u) {
    std::vector<double> v(width);
    const double span = in.values[i + 1] - in.values[i];
    for (std::size_t k = 0; k < width; ++k)
      v[k] = cubic(part(i, 1, k), part(i, 2, k), part(i + 1, 1, k), part(i + 1, 0, k), span, u);
    return v;
  };
  // A cubic on a piece of length h leaves its chord by at most h^2 / 8 times its second derivative, which is largest at
  // an end.
  for (std::size_t i = 0; i + 1 < in.count(); ++i) {
    const double span = in.values[i + 1] - in.values[i];
    double bend = 0;
    for (std::size_t k = 0; k < width; ++k) {
      const double a = part(i, 1, k), b = part(i + 1, 1, k), m = span * part(i, 2, k), n = span * part(i + 1, 0, k);
      bend = std::max({bend, std::abs(-6 * a + 6 * b - 4 * m - 2 * n), std::abs(6 * a - 6 * b + 2 * m + 4 * n)});
    }
    const auto pieces =
        static_cast<int>(std::ceil(std::fmin(std::fmax(std::sqrt(bend / (8 * tolerance * largest)), 1), most_pieces)));
    for (int p = 0; p < pieces; ++p) {
      t.time.push_back(in.values[i] + span * p / pieces);
      t.value.push_back(at(i, double(p) / pieces));
    }
  }
  if (in.count() > 0) {
    t.time.push_back(in.values.back());
    t.value.emplace_back();
    for (std::size_t k = 0; k < width; ++k) t.value.back().push_back(part(in.count() - 1, 1, k));
  }
  return t;
}

void Animations::connect(NodeId clock, NodeId interpolator, NodeId to, std::string_view event) {
  made_.push_back(interpolator);
  auto& routes = c_.scene.main.routes;
  routes.push_back({clock, interpolator, "fraction_changed", "set_fraction"});
  routes.push_back({interpolator, to, "value_changed", event});
}

void Animations::channel(Json c, Json animation, NodeId clock, double whole) {
  const auto samplers = animation["samplers"].elements();
  const auto path = c["target"]["path"].text();
  auto s = c["sampler"].whole();
  if (!s || *s >= samplers.size())
    return c_.diag().report(Diag::gltf_bad_index, c_.file.where(c), "sampler", c["sampler"].source().substr(0, 20));
  if (path == "pointer")
    return pointer(samplers[*s], c["target"]["extensions"]["KHR_animation_pointer"]["pointer"].text(), clock, whole, c);
  move(samplers[*s], c_.file.index(Table::nodes, c["target"]["node"]), path, clock, whole, c);
}

void Animations::move(Json sampler, std::uint32_t node, std::string_view path, NodeId clock, double whole, Json c) {
  if (node == none) return c_.lost.add("animation of " + std::string(path), c_.file.where(c));
  if (path == "weights") return morph(sampler, node, clock, whole, c);
  const NodeId to = hierarchy_.made(node);
  const bool rotates = path == "rotation";
  if (!to || !c_.scene.is(to, nodes::Transform) || (!rotates && path != "translation" && path != "scale"))
    return c_.lost.add("animation of " + std::string(path), c_.file.where(c));
  auto t = track(sampler, rotates ? 4 : 3);
  if (!t) return;
  std::vector<double> key, value;
  const Vec3 back = path == "translation" ? hierarchy_.moved_back(node) : Vec3{};
  for (std::size_t i = 0; i < t->time.size(); ++i) {
    key.push_back(std::clamp(t->time[i] / whole, 0.0, 1.0));
    auto& v = t->value[i];
    if (!rotates) {
      for (std::size_t k = 0; k < back.size(); ++k) v[k] += back[k];
      value.insert(value.end(), v.begin(), v.end());
      continue;
    }
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    const double by = length > 0 ? length : 1;
    const Vec4 r = rotation_of({v[0] / by, v[1] / by, v[2] / by, v[3] / by});
    value.insert(value.end(), r.begin(), r.end());
  }
  NodeId n = c_.add(rotates ? nodes::OrientationInterpolator : nodes::PositionInterpolator, c);
  if (rotates) {
    c_.scene.set(n, nodes::orientation_interpolator::key, key, nodes::orientation_interpolator::keyValue, value);
  } else {
    c_.scene.set(n, nodes::position_interpolator::key, key, nodes::position_interpolator::keyValue, value);
  }
  connect(clock, n, to, path == "rotation" ? "set_rotation" : path == "scale" ? "set_scale" : "set_translation");
}

void Animations::pointer(Json sampler, std::string_view pointer, NodeId clock, double whole, Json at) {
  if (auto p = node_path(pointer); p && p->first < c_.file.count(Table::nodes))
    return move(sampler, p->first, p->second, clock, whole, at);
  const Pointed p = followers_of(c_, hierarchy_, meshes_, pointer);
  if (p.followers.empty()) return c_.lost.add("animation of " + std::string(pointer.substr(0, 80)), c_.file.where(at));
  if (auto t = track(sampler, p.width))
    for (const Follower& f : p.followers) follow(*t, f, clock, whole, at);
}

/// Unless the field stays as it is.
void Animations::follow(const Track& t, const Follower& f, NodeId clock, double whole, Json at) {
  constexpr int pieces = 8;
  const std::size_t width = f.color ? 3 : 1;
  auto same = [&](const auto& a, const auto& b) {
    return std::equal(a.begin() + static_cast<std::ptrdiff_t>(f.at),
                      a.begin() + static_cast<std::ptrdiff_t>(f.at + width),
                      b.begin() + static_cast<std::ptrdiff_t>(f.at));
  };
  std::vector<double> key, value;
  auto add = [&](double time, const std::vector<double>& v) {
    key.push_back(std::clamp(time / whole, 0.0, 1.0));
    if (!f.color) return value.push_back(f.scale * v[f.at] + f.offset);
    for (std::size_t k = 0; k < 3; ++k) value.push_back(display(v[f.at + k]));
  };
  bool moves = false;
  for (std::size_t i = 0; i < t.time.size(); ++i) {
    add(t.time[i], t.value[i]);
    if (i + 1 == t.time.size() || same(t.value[i], t.value[i + 1])) continue;
    moves = true;
    for (int p = 1; f.color && t.time[i + 1] > t.time[i] && p < pieces; ++p) {
      const double u = double(p) / pieces;
      auto v = t.value[i];
      for (std::size_t k = 0; k < v.size(); ++k) v[k] += u * (t.value[i + 1][k] - v[k]);
      add(t.time[i] + u * (t.time[i + 1] - t.time[i]), v);
    }
  }
  if (!moves) return;
  NodeId n = c_.add(f.color ? nodes::ColorInterpolator : nodes::ScalarInterpolator, at);
  if (f.color) {
    c_.scene.set(n, nodes::color_interpolator::key, key, nodes::color_interpolator::keyValue, value);
  } else {
    c_.scene.set(n, nodes::scalar_interpolator::key, key, nodes::scalar_interpolator::keyValue, value);
  }
  connect(clock, n, f.node, f.event);
}

void Animations::morph(Json sampler, std::uint32_t node, NodeId clock, double whole, Json at) {
  auto found = hierarchy_.morphs().find(node);
  if (found == hierarchy_.morphs().end()) return c_.lost.add("animation of weights", c_.file.where(at));
  morphed_.insert(node);
  for (const Morph& m : found->second) {
    auto t = m.targets.empty() || !m.coordinate ? std::nullopt : track(sampler, m.targets.size());
    if (!t) continue;
    n_numbers_ += t->time.size() * m.base.size();
    if (n_numbers_ > max_numbers)
      return c_.diag().report(Diag::expansion_limit, c_.file.where(at), max_numbers, "numbers of animated points");
    std::vector<double> key, value;
    value.reserve(t->time.size() * m.base.size());
    for (std::size_t i = 0; i < t->time.size(); ++i) {
      key.push_back(std::clamp(t->time[i] / whole, 0.0, 1.0));
      const auto first = value.size();
      value.insert(value.end(), m.base.begin(), m.base.end());
      for (std::size_t k = 0; k < m.targets.size(); ++k)
        for (std::size_t p = 0; p < m.base.size(); ++p) value[first + p] += t->value[i][k] * m.targets[k][p];
    }
    NodeId n = c_.add(nodes::CoordinateInterpolator, at);
    c_.scene.set(n, nodes::coordinate_interpolator::key, key, nodes::coordinate_interpolator::keyValue, value);
    connect(clock, n, m.coordinate, "set_point");
  }
}

}  // namespace wrlkit::gltf_reader
