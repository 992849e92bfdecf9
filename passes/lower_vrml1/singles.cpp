#include "passes/lower_vrml1/singles.h"

#include <algorithm>
#include <charconv>

#include "base/math/affine.h"
#include "geometry/half_space.h"
#include "passes/lower_vrml1/placement.h"
#include "scenegraph/decompose.h"

#include "base/text/blanks.h"

namespace wrlkit::vrml1 {
namespace {

namespace v1 = nodes::vrml1;

NodeId named(Scene& scene, TypeId type, NodeId source) {
  NodeId n = scene.add(type, scene.where(source));
  scene.set_name(n, scene.name(source));
  return n;
}

/// Three numbers, "0.2 0.3 0.8".
bool read_color(std::string_view s, Vec3& out) {
  for (double& v : out) {
    s = trim(s);
    auto r = std::from_chars(s.data(), s.data() + s.size(), v);
    if (r.ec != std::errc{}) return false;
    s.remove_prefix(static_cast<std::size_t>(r.ptr - s.data()));
  }
  return true;
}

// A lobe of cos^(128 rate), which has half of its brightness at some angle; so has the ramp from beamWidth to
// cutOffAngle.
double beam_width(double rate, double cut_off) {
  if (rate <= 0 || cut_off <= 0) return cut_off;
  const double half = std::acos(std::pow(0.5, 1 / (128 * rate)));
  return std::clamp(2 * half - cut_off, 0.0, cut_off);
}

// Inventor keeps what lies in front of the plane, at `distance` or more along its normal.
NodeId clip_plane(Scene& scene, NodeId source, const Matrix& axes) {
  NodeId n = named(scene, nodes::ClipPlane, source);
  const Vec4 p = scene.get(source, v1::clip_plane::plane);
  const bool turns = is_invertible(axes);
  const Vec4 plane{p[0], p[1], p[2], -p[3]};
  scene.set(n, nodes::clip_plane::plane, turns ? plane_below(plane, inverse(axes)) : plane);
  return n;
}

}  // namespace

NodeId viewpoint(Scene& scene, NodeId camera, Diagnostics& diag) {
  constexpr double default_angle = 0.785398;
  namespace p = v1::perspective_camera;
  namespace o = v1::orthographic_camera;
  NodeId n = named(scene, nodes::Viewpoint, camera);
  const bool parallel = scene.is(camera, v1::OrthographicCamera);
  auto position = parallel ? scene.get(camera, o::position) : scene.get(camera, p::position);
  const auto orientation = parallel ? scene.get(camera, o::orientation) : scene.get(camera, p::orientation);
  const double angle = parallel ? default_angle : scene.get(camera, p::heightAngle);
  if (parallel) {  // back to where as much is seen
    diag.report(Diag::no_vrml97_value, scene.where(camera), "OrthographicCamera", "height");
    const double back =
        scene.get(camera, o::height) / 2 / std::tan(default_angle / 2) - scene.get(camera, o::focalDistance);
    const auto offset = rotation_matrix(orientation).point({0, 0, back});
    for (std::size_t i = 0; i < 3; ++i) position[i] += offset[i];
  }
  scene.set(n, nodes::viewpoint::position, position, nodes::viewpoint::orientation, orientation);
  if (angle != default_angle)
    scene.set(n, nodes::viewpoint::fieldOfView, angle);  // the default of both, with the digits of each
  scene.set(n, nodes::viewpoint::description, scene.name(camera));
  return n;
}

NodeId light(Scene& scene, NodeId source, const Matrix& axes, Diagnostics& diag) {
  constexpr double unlimited = 1e9;
  namespace d = v1::directional_light;
  namespace p = v1::point_light;
  namespace s = v1::spot_light;
  auto common = [&](NodeId n, auto on, auto intensity, auto color, auto from_on, auto from_intensity, auto from_color) {
    scene.set(n, on, scene.get(source, from_on));
    scene.set(n, intensity, scene.get(source, from_intensity));
    scene.set(n, color, scene.get(source, from_color));
  };
  if (scene.is(source, v1::DirectionalLight)) {
    namespace t = nodes::directional_light;
    NodeId n = named(scene, nodes::DirectionalLight, source);
    common(n, t::on, t::intensity, t::color, d::on, d::intensity, d::color);
    Matrix linear = axes;
    for (int r = 0; r < 3; ++r) linear(r, 3) = 0;
    auto direction = linear.point(scene.get(source, d::direction));
    without_noise(direction);
    scene.set(n, t::direction, direction);
    return n;
  }
  if (scene.is(source, v1::PointLight)) {
    namespace t = nodes::point_light;
    NodeId n = named(scene, nodes::PointLight, source);
    common(n, t::on, t::intensity, t::color, p::on, p::intensity, p::color);
    scene.set(n, t::location, scene.get(source, p::location), t::radius, unlimited);
    return n;
  }
  if (scene.is(source, v1::ClipPlane)) return clip_plane(scene, source, axes);
  namespace t = nodes::spot_light;
  NodeId n = named(scene, nodes::SpotLight, source);
  common(n, t::on, t::intensity, t::color, s::on, s::intensity, s::color);
  scene.set(n, t::location, scene.get(source, s::location), t::direction, scene.get(source, s::direction), t::radius,
            unlimited);
  const double cut_off = scene.get(source, s::cutOffAngle), rate = scene.get(source, s::dropOffRate);
  scene.set(n, t::cutOffAngle, cut_off, t::beamWidth, beam_width(rate, cut_off));
  if (rate > 0) diag.report(Diag::no_vrml97_value, scene.where(source), "SpotLight", "dropOffRate");
  return n;
}

NodeId inline_of(Scene& scene, NodeId source) {
  const bool www = scene.is(source, v1::WWWInline);
  const auto name = www ? scene.get(source, v1::www_inline::name) : scene.get(source, v1::file::name);
  if (name.empty()) return {};
  NodeId n = named(scene, nodes::Inline, source);
  scene.set(n, nodes::inline_::url, std::vector<std::string_view>{name});
  if (!www || scene.get(source, v1::www_inline::bboxSize) == Vec3{0, 0, 0}) return n;
  scene.set(n, nodes::inline_::bboxSize, scene.get(source, v1::www_inline::bboxSize), nodes::inline_::bboxCenter,
            scene.get(source, v1::www_inline::bboxCenter));
  return n;
}

NodeId info_of(Scene& scene, NodeId source) {
  const auto text =
      scene.is(source, v1::Info) ? scene.get(source, v1::info::string) : scene.get(source, v1::label::label);
  const auto name = scene.name(source);
  if (Vec3 color; name == "BackgroundColor" && read_color(text, color)) {
    NodeId n = scene.add(nodes::Background, scene.where(source));
    scene.set(n, nodes::background::skyColor, std::vector<double>(color.begin(), color.end()));
    return n;
  }
  if (name == "Viewer") {
    std::string type(text);
    std::ranges::transform(type, type.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (type == "EXAMINER") type = "EXAMINE";
    NodeId n = scene.add(nodes::NavigationInfo, scene.where(source));
    scene.set(n, nodes::navigation_info::type, std::vector<std::string_view>{type, "ANY"});
    return n;
  }
  NodeId n = named(scene, nodes::WorldInfo, source);
  if (name == "Title")
    scene.set(n, nodes::world_info::title, text);
  else
    scene.set(n, nodes::world_info::info, std::vector<std::string_view>{text});
  return n;
}

NodeId fog_of(Scene& scene, NodeId source, Diagnostics& diag) {
  namespace e = v1::environment;
  const auto report_given = [&](std::uint16_t slot, std::string_view field) {
    if (scene.find(source, slot)) diag.report(Diag::no_vrml97_value, scene.where(source), "Environment", field);
  };
  report_given(e::ambientIntensity.slot, "ambientIntensity");
  report_given(e::ambientColor.slot, "ambientColor");
  report_given(e::attenuation.slot, "attenuation");
  const auto type = scene.get(source, e::fogType);
  if (type == "NONE") return {};
  NodeId n = named(scene, nodes::Fog, source);
  scene.set(n, nodes::fog::color, scene.get(source, e::fogColor), nodes::fog::visibilityRange,
            scene.get(source, e::fogVisibility));
  if (type != "HAZE") scene.set(n, nodes::fog::fogType, "EXPONENTIAL");
  if (type == "SMOKE") diag.report(Diag::no_vrml97_value, scene.where(source), "Environment", "fogType");
  return n;
}

TransformFields transform_of(const Scene& scene, NodeId n, Diagnostics& diag) {
  TransformFields out;
  if (scene.is(n, v1::Translation))
    out.translation = scene.get(n, v1::translation::translation);
  else if (scene.is(n, v1::Rotation))
    out.rotation = scene.get(n, v1::rotation::rotation);
  else if (scene.is(n, v1::Scale))
    out.scale = scene.get(n, v1::scale::scaleFactor);
  else if (scene.is(n, v1::Rotor))
    out.rotation = scene.get(n, v1::rotor::rotation);
  else if (scene.is(n, v1::Pendulum))
    out.rotation = scene.get(n, v1::pendulum::rotation);
  else if (scene.is(n, v1::Shuttle))
    out.translation = scene.get(n, v1::shuttle::translation);
  else if (scene.is(n, v1::RotationXYZ)) {
    const auto axis = scene.get(n, v1::rotation_xyz::axis);
    out.rotation = {axis == "X" ? 1.0 : 0.0, axis == "Y" ? 1.0 : 0.0, axis == "Z" ? 1.0 : 0.0,
                    scene.get(n, v1::rotation_xyz::angle)};
  } else if (scene.is(n, v1::Transform)) {
    namespace t = v1::transform;
    out = {scene.get(n, t::translation), scene.get(n, t::rotation), scene.get(n, t::scaleFactor),
           scene.get(n, t::scaleOrientation), scene.get(n, t::center)};
  }
  const bool moves = scene.is(n, v1::Rotor) || scene.is(n, v1::Pendulum) || scene.is(n, v1::Shuttle);
  if (moves) diag.report(Diag::no_vrml97_value, scene.where(n), scene.type(n).name, "speed");
  if (scene.is(n, v1::ResetTransform) || scene.is(n, v1::AntiSquish))
    diag.report(Diag::no_vrml97_node, scene.where(n), scene.type(n).name);
  return out;
}

Matrix matrix_of_rows(std::span<const double> rows, Span where, Diagnostics& diag) {
  Matrix m = matrix_of_columns(rows.data());
  for (double& v : m.m) v /= rows[15] != 0 ? rows[15] : 1;
  if (rows[3] != 0 || rows[7] != 0 || rows[11] != 0)
    diag.report(Diag::no_vrml97_value, where, "MatrixTransform", "matrix");
  return m;
}

namespace {
struct Unit {
  std::string_view name;
  double metres;
};
constexpr Unit units[] = {{"METERS", 1},       {"CENTIMETERS", 0.01},   {"MILLIMETERS", 0.001},  {"MICROMETERS", 1e-6},
                          {"MICRONS", 1e-6},   {"NANOMETERS", 1e-9},    {"ANGSTROMS", 1e-10},    {"KILOMETERS", 1000},
                          {"FEET", 0.3048},    {"INCHES", 0.0254},      {"POINTS", 0.0254 / 72}, {"YARDS", 0.9144},
                          {"MILES", 1609.344}, {"NAUTICAL_MILES", 1852}};
}  // namespace

double metres(std::string_view unit, std::uint8_t& number) {
  auto u = std::ranges::find(units, unit, &Unit::name);
  number = u == std::end(units) ? 0 : static_cast<std::uint8_t>(u - units);
  return units[number].metres;
}
double metres(std::uint8_t number) { return units[number].metres; }

}  // namespace wrlkit::vrml1
