#include "passes/recognise/faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/vec.h"
#include "base/overloaded.h"

namespace wrlkit {
namespace {

Vec3 position(const Mesh& mesh, std::size_t corner) {
  const double* p = mesh.positions.data() + std::size_t{mesh.corners[corner]} * 3;
  return {p[0], p[1], p[2]};
}

}  // namespace

std::size_t triangles_in(const Mesh& mesh, std::span<const std::uint32_t> faces, bool listed) {
  std::size_t out = 0;
  auto add = [&](std::size_t f) { out += std::max<std::size_t>(mesh.end_of(f) - mesh.begin_of(f), 2) - 2; };
  for (auto f : faces) add(f);
  if (!listed && faces.empty())
    for (std::size_t f = 0; f < mesh.n_faces(); ++f) add(f);
  return out;
}

Mesh only_faces(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  Mesh out;
  out.kind = mesh.kind;
  out.ccw = mesh.ccw;
  out.solid = mesh.solid;
  out.convex = mesh.convex;
  out.crease_angle = mesh.crease_angle;
  StampedMap points;
  points.reset(mesh.n_positions());
  auto& positions = out.positions.edit();
  out.face_begin.push_back(0);
  const auto from = mesh.attributes();
  const auto to = out.attributes();
  for (std::size_t k = 0; k < to.size(); ++k) {
    to[k]->width = from[k]->width;
    to[k]->values = from[k]->values;
  }
  for (auto f : faces) {
    for (std::size_t c = mesh.begin_of(f); c < mesh.end_of(f); ++c) {
      const auto p = mesh.corners[c];
      if (!points.contains(p)) {
        points.set(p, static_cast<std::uint32_t>(positions.size() / 3));
        for (std::size_t k = 0; k < 3; ++k) positions.push_back(mesh.positions[std::size_t{p} * 3 + k]);
      }
      out.corners.push_back(points[p]);
      for (std::size_t k = 0; k < to.size(); ++k)
        if (from[k]->present()) to[k]->index.push_back(from[k]->index[c]);
    }
    out.face_begin.push_back(static_cast<std::uint32_t>(out.corners.size()));
  }
  return out;
}

bool has_normals_of(const Mesh& mesh, std::span<const std::uint32_t> faces, const Form& form) {
  if (!mesh.normal.present()) return true;
  constexpr double slack = 0.1;
  const double chord = form.segments > 0 ? std::numbers::pi / form.segments + std::numbers::pi / 16 : 0;
  const double least = std::cos(chord + slack);
  for (auto f : faces) {
    const std::size_t begin = mesh.begin_of(f), end = mesh.end_of(f);
    Vec3 sum{};
    for (std::size_t c = begin + 2; c < end; ++c)
      sum = sum + cross(position(mesh, c - 1) - position(mesh, begin), position(mesh, c) - position(mesh, begin));
    sum = (mesh.ccw ? 1.0 : -1.0) * unit(sum);
    for (std::size_t c = begin; c < end && length(sum) > 0; ++c) {
      const float* n = mesh.normal.at(mesh.normal.index[c]);
      if (dot(unit({n[0], n[1], n[2]}), sum) < least) return false;
    }
  }
  return true;
}

std::optional<Vec4> color_of(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  const Attribute& color = mesh.color;
  if (!color.present() || faces.empty()) return std::nullopt;
  const float* first = color.at(color.index[mesh.begin_of(faces[0])]);
  for (auto f : faces)
    for (std::size_t c = mesh.begin_of(f); c < mesh.end_of(f); ++c)
      if (!std::equal(first, first + color.width, color.at(color.index[c]))) return std::nullopt;
  // As it was written, not as single precision has it.
  auto decimal = [](float v) { return std::round(double{v} * 1e7) / 1e7; };
  return Vec4{decimal(first[0]), decimal(first[1]), decimal(first[2]), color.width == 4 ? decimal(first[3]) : -1};
}

double reach_of_form(const Form& form) {
  return std::visit(Overloaded{[](const CylinderForm& f) { return std::hypot(f.radius, f.height / 2); },
                               [](const FrustumForm& f) {
                                 return std::hypot(std::max(f.bottom_radius, f.top_radius), f.height / 2) +
                                        std::abs(f.offset[0]) + std::abs(f.offset[1]);
                               },
                               [](const TorusForm& f) { return f.bend_radius + f.radius; },
                               [](const RectangularTorusForm& f) { return std::hypot(f.outer_radius, f.height / 2); },
                               [](const SphereForm& f) { return f.radius; },
                               [](const DishForm& f) { return std::max(f.radius, f.height) * 2; },
                               [](const BoxForm& f) { return std::hypot(f.size[0], f.size[1], f.size[2]) / 2; },
                               [](const PyramidForm& f) {
                                 return std::hypot(std::max(f.bottom[0], f.top[0]), std::max(f.bottom[1], f.top[1]),
                                                   f.height) +
                                        std::abs(f.offset[0]) + std::abs(f.offset[1]);
                               },
                               [](const PrismForm& f) {
                                 double out = 0;
                                 for (const Vec2& p : f.points)
                                   out = std::max(out, std::hypot(p[0], p[1], f.height / 2));
                                 return out;
                               },
                               [](const RingForm& f) { return std::hypot(f.outer_radius, f.height / 2); }},
                    form.shape);
}

void round_sizes(Form& form, double step) {
  if (!(step > 0)) return;
  const double per = step < 1 ? std::round(1 / step) : 1 / step;  // decimals without noise behind them
  auto whole = [&](double& v) {
    if (const double rounded = std::round(v * per) / per; rounded != 0) v = rounded;
  };
  auto zero = [&](double& v) { v = std::round(v * per) / per + 0.0; };
  auto angle = [&](double& v, double radius) {
    const double digits = std::pow(10, std::ceil(std::log10(std::max(radius / step, 1.0))) + 1);
    v = std::round(v * digits) / digits;
  };
  std::visit(Overloaded{[&](CylinderForm& f) {
                          whole(f.radius);
                          whole(f.height);
                        },
                        [&](FrustumForm& f) {
                          whole(f.bottom_radius);
                          whole(f.top_radius);
                          whole(f.height);
                          zero(f.offset[0]);
                          zero(f.offset[1]);
                        },
                        [&](TorusForm& f) {
                          whole(f.bend_radius);
                          whole(f.radius);
                          if (f.angle < 6.28) angle(f.angle, f.bend_radius + f.radius);
                          angle(f.turn, f.radius);
                        },
                        [&](RectangularTorusForm& f) {
                          whole(f.inner_radius);
                          whole(f.outer_radius);
                          whole(f.height);
                          if (f.angle < 6.28) angle(f.angle, f.outer_radius);
                        },
                        [&](SphereForm& f) { whole(f.radius); },
                        [&](DishForm& f) {
                          whole(f.radius);
                          whole(f.height);
                        },
                        [&](BoxForm& f) {
                          for (double& v : f.size) whole(v);
                        },
                        [&](PyramidForm& f) {
                          for (Vec2* v : {&f.bottom, &f.top, &f.offset})
                            for (double& c : *v) zero(c);
                          whole(f.height);
                        },
                        [&](PrismForm& f) {
                          for (Vec2& p : f.points)
                            for (double& c : p) zero(c);
                          whole(f.height);
                        },
                        [&](RingForm& f) {
                          whole(f.inner_radius);
                          whole(f.outer_radius);
                          whole(f.height);
                        }},
             form.shape);
}

}  // namespace wrlkit
