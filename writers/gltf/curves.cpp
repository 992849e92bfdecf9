#include "writers/gltf/curves.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {
namespace {

double sample_dot(const Sample& a, const Sample& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

/// Hue in sixths of the circle, saturation, value.
std::array<double, 3> hsv(const Sample& c) {
  const double high = std::max({c[0], c[1], c[2]}), low = std::min({c[0], c[1], c[2]}), d = high - low;
  if (!(d > 0)) return {0, 0, high};
  const double h = high == c[0] ? (c[1] - c[2]) / d : high == c[1] ? 2 + (c[2] - c[0]) / d : 4 + (c[0] - c[1]) / d;
  return {h < 0 ? h + 6 : h, d / high, high};
}

Sample rgb(double h, double s, double v) {
  auto part = [&](double n) {
    const double k = std::fmod(n + h, 6.0);
    return v - v * s * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {part(5), part(3), part(1), 0};
}

Sample mix_colors(const Sample& a, const Sample& b, double t) {
  auto from = hsv(a), to = hsv(b);
  if (from[1] == 0) from[0] = to[0];
  if (to[1] == 0) to[0] = from[0];
  if (to[0] - from[0] > 3) from[0] += 6;
  if (from[0] - to[0] > 3) to[0] += 6;
  auto at = [&](std::size_t i) { return from[i] + t * (to[i] - from[i]); };
  return rgb(at(0), at(1), at(2));
}

/// The place of a key or of what lies between two; of equal keys the first or the last.
double place_of(std::span<const double> key, double v, bool last) {
  const auto begin = key.begin();
  const auto at = last ? std::ranges::upper_bound(key, v) : std::ranges::lower_bound(key, v);
  const auto i = static_cast<std::size_t>(at - begin);
  if (last) {
    if (i == 0) return 0;
    if (i == key.size()) return static_cast<double>(key.size() - 1);
    return static_cast<double>(i - 1) + (v - key[i - 1]) / (key[i] - key[i - 1]);
  }
  if (i == key.size()) return static_cast<double>(key.size() - 1);
  if (i == 0 || key[i] == v) return static_cast<double>(i);
  return static_cast<double>(i - 1) + (v - key[i - 1]) / (key[i] - key[i - 1]);
}

/// All interpolators have key and keyValue, of one type.
std::span<const double> numbers(const Scene& scene, NodeId n, std::string_view field) {
  auto slot = scene.type(n).find(field, Dialect::x3d);
  const Value* v = slot ? &scene.value(n, *slot) : nullptr;
  return v && !v->is ? v->number_span() : std::span<const double>();
}

bool has_lists(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::CoordinateInterpolator) || scene.is(n, nodes::NormalInterpolator);
}

std::size_t width_of(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::ScalarInterpolator)        ? 1
         : scene.is(n, nodes::PositionInterpolator2D)  ? 2
         : scene.is(n, nodes::OrientationInterpolator) ? 4
                                                       : 3;
}

}  // namespace

Sample mix(const Sample& a, Sample b, double t, bool rotation) {
  double wa = 1 - t, wb = t;
  if (rotation) {
    double c = sample_dot(a, b);
    if (c < 0) {
      c = -c;
      b = {-b[0], -b[1], -b[2], -b[3]};
    }
    if (const double angle = std::acos(std::min(c, 1.0)); angle > 1e-6) {
      wa = std::sin((1 - t) * angle) / std::sin(angle);
      wb = std::sin(t * angle) / std::sin(angle);
    }
  }
  return {wa * a[0] + wb * b[0], wa * a[1] + wb * b[1], wa * a[2] + wb * b[2], wa * a[3] + wb * b[3]};
}

bool is_interpolator(const Scene& scene, NodeId n) {
  constexpr TypeId types[] = {nodes::PositionInterpolator,  nodes::OrientationInterpolator, nodes::ScalarInterpolator,
                              nodes::ColorInterpolator,     nodes::CoordinateInterpolator,  nodes::NormalInterpolator,
                              nodes::PositionInterpolator2D};
  return n && std::ranges::find(types, scene.type_id(n)) != std::end(types);
}

std::span<const double> keys(const Scene& scene, NodeId n) {
  const auto key = numbers(scene, n, "key");
  return values_per_key(scene, n) == 0 ? key.first(0)
         : has_lists(scene, n)         ? key
                               : key.first(std::min(key.size(), key_values(scene, n).size() / width_of(scene, n)));
}

std::span<const double> key_values(const Scene& scene, NodeId n) { return numbers(scene, n, "keyValue"); }

std::size_t values_per_key(const Scene& scene, NodeId n) {
  const std::size_t n_keys = numbers(scene, n, "key").size(), n_numbers = key_values(scene, n).size();
  if (n_keys == 0) return 0;
  return has_lists(scene, n) ? n_numbers / 3 / n_keys : n_numbers >= width_of(scene, n);
}

double Curve::place(double at, Side side) const {
  auto past = side == Side::behind ? std::ranges::upper_bound(frames, at, {}, &Frame::at)
                                   : std::ranges::lower_bound(frames, at, {}, &Frame::at);
  if (past == frames.end()) return frames.back().place;
  if (past == frames.begin()) return frames.front().place;
  const Frame &a = past[-1], &b = *past;
  return a.place + (b.place - a.place) * (at - a.at) / (b.at - a.at);
}

std::optional<Curve> follow(const Scene& scene, NodeId n, const Ramp& ramp, std::size_t most) {
  const auto key = keys(scene, n);
  if (key.empty() || !std::ranges::is_sorted(key)) return std::nullopt;
  Curve c{n, {}};
  auto add = [&](double at, double place) {
    if (c.frames.size() < most && (c.frames.empty() || c.frames.back().at != at || c.frames.back().place != place))
      c.frames.push_back({at, place});
  };
  for (std::size_t i = 0; i + 1 < ramp.points.size(); ++i) {
    const auto [f0, v0] = ramp.points[i];
    const auto [f1, v1] = ramp.points[i + 1];
    if (!(f1 > f0)) continue;
    const bool up = v1 >= v0;
    auto time_of = [&, f0 = f0, v0 = v0, f1 = f1, v1 = v1](double k) {
      return std::clamp(f0 + (f1 - f0) * (k - v0) / (v1 - v0), f0, f1);
    };
    add(f0, place_of(key, v0, up));
    if (v0 != v1) {
      auto low = static_cast<std::size_t>(std::ranges::upper_bound(key, std::min(v0, v1)) - key.begin());
      auto high = static_cast<std::size_t>(std::ranges::lower_bound(key, std::max(v0, v1)) - key.begin());
      for (std::size_t k = low; k < high; ++k) {
        const std::size_t at = up ? k : low + high - 1 - k;
        const bool inner = at > low && at + 1 < high && key[at - 1] == key[at] &&
                           key[at + 1] == key[at];  // of more than two equal keys
        if (!inner) add(time_of(key[at]), static_cast<double>(at));
      }
    }
    add(f1, place_of(key, v1, v0 == v1 || !up));
  }
  const double end = place_of(key, ramp.points.back()[1], true);
  add(1, end);
  return c;
}

Ramp ramp_of(const Scene& scene, const Curve& c) {
  Ramp r;
  r.points.clear();
  for (const auto& f : c.frames) r.points.push_back({f.at, value_at(scene, c.interpolator, f.place)[0]});
  return r;
}

Sample value_at(const Scene& scene, NodeId n, double place) {
  if (!n) return {place};
  const auto raw = key_values(scene, n);
  const bool turns = scene.is(n, nodes::OrientationInterpolator);
  const std::size_t width = width_of(scene, n), count = raw.size() / width;
  auto at = [&](std::size_t i) {
    Sample s{};
    std::copy_n(raw.begin() + static_cast<std::ptrdiff_t>(std::min(i, count - 1) * width), width, s.begin());
    if (!turns) return s;
    const Quaternion q = quaternion(s);
    return Sample{q.x, q.y, q.z, q.w};
  };
  const auto i = static_cast<std::size_t>(place);
  const double t = place - static_cast<double>(i);
  if (t == 0) return at(i);
  return scene.is(n, nodes::ColorInterpolator) ? mix_colors(at(i), at(i + 1), t) : mix(at(i), at(i + 1), t, turns);
}

}  // namespace wrlkit::gltf
