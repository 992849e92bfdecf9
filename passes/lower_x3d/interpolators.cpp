#include "passes/lower_x3d/interpolators.h"

#include "base/math/quaternion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "passes/lower_x3d/geometry.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

constexpr int most_pieces = 64;
constexpr double part = 0.001;

using Values = std::vector<double>;
/// What lies between two keys, from 0 to 1.
using Between = std::function<Values(double)>;

struct Keys {
  std::vector<double> key, value;

  void add(double k, const Values& v) {
    key.push_back(k);
    value.insert(value.end(), v.begin(), v.end());
  }
};

double distance(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

Values straight(const Values& a, const Values& b, double t) {
  Values out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] + t * (b[i] - a[i]);
  return out;
}

/// As many pieces as it takes so that what is between their ends, by `mix`, is near enough.
int pieces(const Between& at, const std::function<Values(const Values&, const Values&, double)>& mix,
           double tolerance) {
  int n = 1;
  auto near = [&] {
    for (int i = 0; i < n; ++i)
      for (double t : {0.25, 0.5, 0.75})
        if (distance(mix(at(1.0 * i / n), at((i + 1.0) / n), t), at((i + t) / n)) > tolerance) return false;
    return true;
  };
  while (n < most_pieces && !near()) n *= 2;
  return n;
}

/// Every interval of the keys in as many pieces as it takes, the last key at the end.
template <class Make, class Mix>
Keys cut(std::span<const double> key, Make between, Mix mix, double tolerance) {
  Keys out;
  for (std::size_t i = 0; i + 1 < key.size(); ++i) {
    const Between at = between(i);
    const int n = key[i + 1] > key[i] ? pieces(at, mix, tolerance) : 1;
    for (int k = 0; k < n; ++k) out.add(key[i] + (key[i + 1] - key[i]) * k / n, at(1.0 * k / n));
    if (i + 2 == key.size()) out.add(key[i + 1], at(1));
  }
  return out;
}

// ---- splines (19.2.3.1)
// -----------------------------------------------------------------------------------------------

struct Spline {
  std::span<const double> key, value, velocity;
  std::size_t width;
  bool closed, normalized;

  std::size_t count() const { return std::min(key.size(), value.size() / width); }
  Values at(std::span<const double> list, std::size_t i) const {
    return {list.begin() + static_cast<std::ptrdiff_t>(i * width),
            list.begin() + static_cast<std::ptrdiff_t>((i + 1) * width)};
  }

  std::vector<Values> tangents() const {
    const std::size_t n = count();
    std::vector<Values> out(n, Values(width, 0));
    const std::size_t given = velocity.size() / width;
    auto chord = [&](std::size_t from, std::size_t to) {
      Values t(width);
      for (std::size_t k = 0; k < width; ++k) t[k] = (value[to * width + k] - value[from * width + k]) / 2;
      return t;
    };
    for (std::size_t i = 0; i < n; ++i)
      if (given >= n)
        out[i] = at(velocity, i);
      else if (i > 0 && i + 1 < n)
        out[i] = chord(i - 1, i + 1);
    const bool round = closed && n > 2 && at(value, 0) == at(value, n - 1);
    if (given == 2 && n > 2) {
      out[0] = at(velocity, 0);
      out[n - 1] = at(velocity, 1);
    } else if (given < n && round)
      out[0] = out[n - 1] = chord(n - 2, 1);
    if (normalized) normalize(out);
    return out;
  }

  void normalize(std::vector<Values>& tangents) const {
    double way = 0;
    for (std::size_t i = 0; i + 1 < count(); ++i) way += distance(at(value, i), at(value, i + 1));
    for (Values& t : tangents)
      if (const double l = distance(t, Values(width, 0)); l > 0)
        for (double& x : t) x *= way / l;
  }

  Keys keys() const {
    const std::size_t n = count();
    const auto tangent = tangents();
    // A factor for intervals that are not alike.
    auto factor = [&](std::size_t i, bool outgoing) {
      if (i == 0 || i + 1 >= n || !(key[i + 1] > key[i - 1])) return 1.0;
      return 2 * (outgoing ? key[i] - key[i - 1] : key[i + 1] - key[i]) / (key[i + 1] - key[i - 1]);
    };
    auto between = [&](std::size_t i) -> Between {
      return [=, this](double t) {
        const double t2 = t * t, t3 = t2 * t, from = 2 * t3 - 3 * t2 + 1, to = 3 * t2 - 2 * t3,
                     out = (t3 - 2 * t2 + t) * factor(i, true), in = (t3 - t2) * factor(i + 1, false);
        Values v(width);
        for (std::size_t k = 0; k < width; ++k)
          v[k] = from * value[i * width + k] + to * value[(i + 1) * width + k] + out * tangent[i][k] +
                 in * tangent[i + 1][k];
        return v;
      };
    };
    double range = 0;
    for (std::size_t k = 0; k < width; ++k) {
      double low = value[k], high = value[k];
      for (std::size_t i = 1; i < n; ++i) {
        low = std::min(low, value[i * width + k]);
        high = std::max(high, value[i * width + k]);
      }
      range = std::max(range, high - low);
    }
    if (n == 1) return {{key[0]}, at(value, 0)};
    return cut(key.first(n), between, straight, part * range);
  }
};

// ---- rotations (19.4.13)
// ----------------------------------------------------------------------------------------------

/// Half the turn from a to b, as a vector.
Vec3 logarithm(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = inverse(a) * b;
  const double s = std::hypot(d.x, d.y, d.z), angle = std::atan2(s, d.w), f = s > 0 ? angle / s : 0;
  return {d.x * f, d.y * f, d.z * f};
}

Vec4 turn(const Quaternion& q) {
  const double s = std::hypot(q.x, q.y, q.z);
  if (s < 1e-15) return {0, 0, 1, 0};
  return {q.x / s, q.y / s, q.z / s, 2 * std::atan2(s, q.w)};
}

Values values_of(const Quaternion& q) { return {q.x, q.y, q.z, q.w}; }

Keys squad(std::span<const double> key, std::span<const double> value) {
  const std::size_t n = std::min(key.size(), value.size() / 4);
  std::vector<Quaternion> q;
  for (std::size_t i = 0; i < n; ++i) {
    q.push_back(quaternion_of({value[4 * i], value[4 * i + 1], value[4 * i + 2], value[4 * i + 3]}));
    if (i && dot(q[i - 1], q[i]) < 0) q[i] = -q[i];
  }
  std::vector<Quaternion> inner = q;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 a = logarithm(q[i], q[i + 1]), b = logarithm(q[i], q[i - 1]),
               s{-(a[0] + b[0]) / 4, -(a[1] + b[1]) / 4, -(a[2] + b[2]) / 4};
    const double angle = std::hypot(s[0], s[1], s[2]), f = angle > 0 ? std::sin(angle) / angle : 0;
    inner[i] = q[i] * Quaternion{s[0] * f, s[1] * f, s[2] * f, std::cos(angle)};
  }
  auto between = [&](std::size_t i) -> Between {
    return [&q, &inner, i](double t) {
      return values_of(slerp(slerp(q[i], q[i + 1], t), slerp(inner[i], inner[i + 1], t), 2 * t * (1 - t)));
    };
  };
  auto mix = [](const Values& a, const Values& b, double t) {
    return values_of(slerp({a[0], a[1], a[2], a[3]}, {b[0], b[1], b[2], b[3]}, t));
  };
  Keys out;
  if (n == 1)
    out.add(key[0], values_of(q[0]));
  else
    out = cut(key.first(n), between, mix, part);
  for (std::size_t i = 0; i < out.key.size(); ++i) {
    const Vec4 r = turn({out.value[4 * i], out.value[4 * i + 1], out.value[4 * i + 2], out.value[4 * i + 3]});
    std::ranges::copy(r, out.value.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return out;
}

// ---- fractions (19.4.4)
// -----------------------------------------------------------------------------------------------

/// Pairs as the standard has them, (in, out) of each key; or (out, in) of each interval, as its authoring tools say.
Keys eased(std::span<const double> key, std::span<const double> pairs) {
  if (key.empty()) return {};
  const std::size_t n = key.size();
  const bool by_key = pairs.size() / 2 >= n;
  auto ease = [&](std::size_t i, std::size_t k) {
    return 2 * i + k < pairs.size() ? std::clamp(pairs[2 * i + k], 0.0, 1.0) : 0;
  };
  auto between = [&](std::size_t i) -> Between {
    double out = by_key ? ease(i, 1) : ease(i, 0), in = by_key ? ease(i + 1, 0) : ease(i, 1);
    if (const double sum = out + in; sum > 1) {
      out /= sum;
      in /= sum;
    }
    const double from = key[i], length = key[i + 1] - key[i];
    return [=](double u) -> Values {
      const double t = 1 / (2 - out - in);
      const double m = u < out ? t / out * u * u : u <= 1 - in ? t * (2 * u - out) : 1 - t * (1 - u) * (1 - u) / in;
      return {from + m * length};
    };
  };
  if (n == 1) return {{key[0]}, {key[0]}};
  return cut(key, between, straight, part * std::max(key.back() - key.front(), 0.0));
}

class InterpolatorLowering {
 public:
  InterpolatorLowering(Scene& scene, bool report, Diagnostics& diag) : scene_(scene), report_(report), diag_(diag) {}

  bool run() {
    constexpr TypeId types[] = {nodes::SplinePositionInterpolator, nodes::SplinePositionInterpolator2D,
                                nodes::SplineScalarInterpolator, nodes::SquadOrientationInterpolator,
                                nodes::EaseInEaseOut};
    const auto is_one = [&](NodeId n) { return std::ranges::find(types, scene_.type_id(n)) != std::end(types); };
    if (!any_node(scene_, is_one)) return false;
    std::vector<NodeId> eases;
    for (NodeId n : all_nodes(scene_)) {
      if (scene_.is(n, nodes::SplinePositionInterpolator))
        spline(n, nodes::PositionInterpolator, FieldType::MFVec3f, 3);
      if (scene_.is(n, nodes::SplinePositionInterpolator2D))
        spline(n, nodes::PositionInterpolator2D, FieldType::MFVec2f, 2);
      if (scene_.is(n, nodes::SplineScalarInterpolator)) spline(n, nodes::ScalarInterpolator, FieldType::MFFloat, 1);
      if (scene_.is(n, nodes::SquadOrientationInterpolator))
        become(n, nodes::OrientationInterpolator, FieldType::MFRotation, squad(list(n, "key"), list(n, "keyValue")));
      if (scene_.is(n, nodes::EaseInEaseOut)) eases.push_back(n);
    }
    if (!eases.empty()) for_each_scope(scene_, [&](Scope& s) { routes(s); });
    for (NodeId n : eases)
      become(n, nodes::ScalarInterpolator, FieldType::MFFloat, eased(list(n, "key"), list(n, "easeInEaseOut")));
    return changed_;
  }

 private:
  std::span<const double> list(NodeId n, std::string_view field) const {
    const Value& v = scene_.value(n, *scene_.type(n).find(field, Dialect::x3d));
    return v.is ? std::span<const double>{} : v.number_span();
  }
  bool flag(NodeId n, std::string_view field) const {
    return scene_.value(n, *scene_.type(n).find(field, Dialect::x3d)).integer != 0;
  }

  void spline(NodeId n, TypeId type, FieldType values, std::size_t width) {
    const Spline s{list(n, "key"), list(n, "keyValue"), list(n, "keyVelocity"),
                   width,          flag(n, "closed"),   flag(n, "normalizeVelocity")};
    become(n, type, values, s.count() > 0 ? s.keys() : Keys{});
  }

  void become(NodeId n, TypeId type, FieldType values, const Keys& keys) {
    if (report_) diag_.report(Diag::no_vrml97_curve, scene_.where(n), scene_.type(n).name);
    auto fields = fields_for(scene_, n, type);
    const auto& t = scene_.type(type);
    const std::uint16_t key = *t.find("key", Dialect::x3d), value = *t.find("keyValue", Dialect::x3d);
    std::erase_if(fields,
                  [&](const Value& v) { return !scene_.is_extra(v) && !v.is && (v.slot == key || v.slot == value); });
    auto has = [&](std::uint16_t slot) {
      return std::ranges::any_of(fields, [&](const Value& v) { return !scene_.is_extra(v) && v.slot == slot; });
    };
    if (!has(key)) fields.push_back(scene_.make(FieldType::MFFloat, key, keys.key));
    if (!has(value)) fields.push_back(scene_.make(values, value, keys.value));
    scene_.become(n, type, fields);
    changed_ = true;
  }

  void routes(Scope& scope) {
    for (Route& r : scope.routes)
      if (scene_.is(r.from, nodes::EaseInEaseOut) && r.event_out.starts_with("modifiedFraction"))
        r.event_out = "value_changed";
  }

  Scene& scene_;
  bool report_;
  Diagnostics& diag_;
  bool changed_ = false;
};

}  // namespace

bool lower_interpolators(Scene& scene, bool report, Diagnostics& diag) {
  return InterpolatorLowering(scene, report, diag).run();
}

}  // namespace wrlkit::x3d
