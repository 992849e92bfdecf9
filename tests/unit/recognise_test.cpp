// Forms that were cut into faces come back as what they were: from polygons, triangles and loose faces, wherever they
// stand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "base/math/vec.h"
#include "form_fixture.h"
#include "geometry/polygon.h"
#include "geometry/recognise/recognise.h"

using namespace wrlkit;

namespace {

constexpr double pi = std::numbers::pi;

enum class Style { polygons, triangles, soup };

/// Appends the faces of a form, moved, in decimals if a number of them is given.
void add(Mesh& to, const Form& form, const Matrix& where = {}, int decimals = -1, Style style = Style::polygons) {
  Mesh mesh;
  tessellate_form(form, {}, mesh);
  if (to.kind == Mesh::Kind::none) {
    to.kind = Mesh::Kind::faces;
    to.face_begin.push_back(0);
  }
  auto& out = to.positions.edit();
  auto first = static_cast<std::uint32_t>(out.size() / 3);
  auto put = [&](std::size_t i) {
    Vec3 p = where.point({mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]});
    for (double v : p)
      out.push_back(decimals < 0 ? v : std::round(v * std::pow(10, decimals)) / std::pow(10, decimals));
  };
  if (style != Style::soup)
    for (std::size_t i = 0; i < mesh.n_positions(); ++i) put(i);
  PolygonCutter cutter;
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    const std::span face(mesh.corners.data() + mesh.begin_of(f), mesh.end_of(f) - mesh.begin_of(f));
    std::vector<std::vector<std::uint32_t>> pieces{{face.begin(), face.end()}};
    if (style != Style::polygons) {
      cutter.cut(mesh.positions.data(), face);
      pieces.clear();
      for (std::size_t i = 0; i < cutter.corners().size(); i += 3)
        pieces.push_back({face[cutter.corners()[i]], face[cutter.corners()[i + 1]], face[cutter.corners()[i + 2]]});
    }
    for (const auto& piece : pieces) {
      for (auto c : piece) {
        if (style == Style::soup) {
          to.corners.push_back(static_cast<std::uint32_t>(out.size() / 3));
          put(c);
        } else {
          to.corners.push_back(first + c);
        }
      }
      to.face_begin.push_back(static_cast<std::uint32_t>(to.corners.size()));
    }
  }
}

std::vector<double> sizes(const Form& form) {
  struct Sizes {
    std::vector<double> operator()(const CylinderForm& f) const { return {f.radius, f.height}; }
    std::vector<double> operator()(const FrustumForm& f) const {
      std::vector<double> r{f.bottom_radius, f.top_radius};
      std::ranges::sort(r);
      return {r[0], r[1], f.height, std::hypot(f.offset[0], f.offset[1])};
    }
    std::vector<double> operator()(const TorusForm& f) const { return {f.bend_radius, f.radius, f.angle}; }
    std::vector<double> operator()(const RectangularTorusForm& f) const {
      return {f.inner_radius, f.outer_radius, f.height, f.angle};
    }
    std::vector<double> operator()(const SphereForm& f) const { return {f.radius}; }
    std::vector<double> operator()(const DishForm& f) const { return {f.radius, f.height, double(f.spherical)}; }
    std::vector<double> operator()(const BoxForm& f) const {
      std::vector<double> v{f.size[0], f.size[1], f.size[2]};
      std::ranges::sort(v);
      return v;
    }
    std::vector<double> operator()(const PyramidForm& f) const { return {f.height}; }
    std::vector<double> operator()(const PrismForm& f) const { return {f.height, double(f.points.size())}; }
    std::vector<double> operator()(const RingForm& f) const { return {f.inner_radius, f.outer_radius, f.height}; }
  };
  return std::visit(Sizes{}, form.shape);
}

std::vector<Form> some_of_each() {
  const PrismForm angle{{{0, 0}, {0, 4}, {1, 4}, {1, 1}, {3, 1}, {3, 0}}, {6}, 5, 0};
  const PrismForm tube{{{-2, -2}, {-2, 2}, {2, 2}, {2, -2}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {4, 8}, 5, 0};
  return {form_of(CylinderForm{2, 5}, 16),
          form_of(CylinderForm{2, 0.3}, 7),
          form_of(FrustumForm{2, 1, 3, {}, {}, {}}, 12),
          form_of(FrustumForm{2, 0, 3, {}, {}, {}}, 12),
          form_of(FrustumForm{2, 1, 3, {0.5, 1}, {}, {}}, 12),
          form_of(FrustumForm{1, 1, 4, {}, {0.3, 0.1}, {0, -0.4}}, 12),
          form_of(TorusForm{3, 1, pi / 2, 0.3}, 10, 6),
          form_of(TorusForm{3, 1, pi, 0}, 6, 9),
          form_of(TorusForm{3, 1, pi / 4, 0}, 16, 2),
          form_of(TorusForm{3, 1, 2 * pi, 0}, 10, 9),
          form_of(RectangularTorusForm{2, 3, 1, 2.5}, 9),
          form_of(RectangularTorusForm{2, 2.2, 1, pi}, 6),
          form_of(SphereForm{2}, 12, 7),
          form_of(SphereForm{2}, 16, 8),
          form_of(DishForm{2, 1, false}, 12, 5),
          form_of(DishForm{2, 0.6, true}, 12, 5),
          form_of(DishForm{2, 3, true}, 12, 5),
          form_of(BoxForm{{1, 2, 3}}),
          form_of(PyramidForm{{2, 1}, {1, 3}, 2, {0.5, 0.2}}),
          form_of(PyramidForm{{2, 1}, {0, 0}, 2, {1, 0}}),
          form_of(angle),
          form_of(tube),
          form_of(RingForm{1, 2, 0.5}, 16)};
}

/// The one form that all faces are.
void check_same(const Recognition& found, const Form& form, double tolerance) {
  CHECK(found.rest.empty());
  CHECK(found.forms.size() == 1);
  if (found.forms.size() != 1) return;
  CHECK(kind_of(found.forms[0].form) == kind_of(form));
  const auto is = sizes(found.forms[0].form), should = sizes(form);
  REQUIRE(is.size() == should.size());
  for (std::size_t i = 0; i < is.size(); ++i) CHECK(is[i] == Approx(should[i]).margin(4 * tolerance));
  CHECK(found.forms[0].residual <= 3 * tolerance);
  CHECK_FALSE(found.forms[0].inside_out);
  CHECK(found.forms[0].form.segments == form.segments);
}

}  // namespace

TEST_CASE("recognise: every form from polygons, triangles and loose faces") {
  for (const Form& form : some_of_each())
    for (Style style : {Style::polygons, Style::triangles, Style::soup})
      for (int decimals : {-1, 4}) {
        INFO(kind_of(form) << ", style " << static_cast<int>(style) << ", decimals " << decimals);
        Mesh mesh;
        add(mesh, form, {}, decimals, style);
        check_same(recognise_forms(mesh), form, decimals < 0 ? 1e-6 : 1e-4);
      }
}

TEST_CASE("recognise: at coordinates around 5,000,000") {
  for (const Form& form : some_of_each()) {
    INFO(kind_of(form));
    Mesh mesh;
    add(mesh, form, translation_matrix({5e6, -4.2e6, 3.1e6}), 4, Style::soup);
    check_same(recognise_forms(mesh), form, 1e-4);
  }
}

TEST_CASE("recognise: open ends are told from closed ones") {
  for (Form form : some_of_each())
    for (int caps = 0; caps < 3; ++caps) {
      const std::string kind(kind_of(form));
      if (kind == "sphere" || kind == "prism" || kind == "ring" || kind == "cone" || kind == "dish" ||
          kind == "rectangular-torus" || kind == "pyramid" || (form.segments == 10 && form.rings == 9))
        continue;
      form.bottom = caps == 1;
      form.top = caps == 2;
      INFO(kind << ", " << caps);
      Mesh mesh;
      add(mesh, form);
      const auto found = recognise_forms(mesh);
      check_same(found, form, 1e-6);
      CHECK(found.forms[0].form.bottom + found.forms[0].form.top == form.bottom + form.top);
    }
}

TEST_CASE("recognise: what it finds is cut into the points that it was found in") {
  for (const Form& form : some_of_each()) {
    INFO(kind_of(form));
    Mesh mesh, again;
    add(mesh, form);
    const auto found = recognise_forms(mesh);
    REQUIRE(found.forms.size() == 1);
    tessellate_form(found.forms[0].form, {}, again);
    CHECK(n_triangles(found.forms[0].form, {}) == n_triangles(form, {}));
    for (std::size_t i = 0; i < mesh.n_positions(); ++i) {
      double nearest = 1e9;
      for (std::size_t k = 0; k < again.n_positions(); ++k)
        nearest = std::min(nearest, std::hypot(mesh.positions[3 * i] - again.positions[3 * k],
                                               mesh.positions[3 * i + 1] - again.positions[3 * k + 1],
                                               mesh.positions[3 * i + 2] - again.positions[3 * k + 2]));
      CHECK(nearest < 1e-6);
    }
  }
}

TEST_CASE("recognise: a pipe run in one piece is cut at its rings") {
  // Along +Y, then around a bend, then on.
  Form first = form_of(CylinderForm{1, 4}, 12), bend = form_of(TorusForm{3, 1, pi / 2, 0}, 12, 6),
       last = form_of(CylinderForm{1, 5}, 12);
  first.frame = last.frame = {};
  // The bend begins at +X and runs to -Z; turned so that it begins upwards at the origin.
  bend.frame = rotation_matrix({1, 0, 0, pi / 2}) * translation_matrix({-3, 0, 0});
  first.frame = translation_matrix({0, -2, 0}) * rotation_matrix({0, 1, 0, -pi / 2});
  const Vec3 end = bend.frame.point({0, 0, -3});
  last.frame = translation_matrix({end[0] - 2.5, end[1], end[2]}) * rotation_matrix({0, 0, 1, pi / 2}) *
               rotation_matrix({0, 1, 0, -pi / 2});
  first.top = bend.bottom = bend.top = last.bottom = false;
  Mesh mesh;
  for (const Form& f : {first, bend, last}) add(mesh, f, {}, 6);
  const auto found = recognise_forms(mesh);
  CHECK(found.rest.empty());
  REQUIRE(found.forms.size() == 3);
  std::vector<std::string> kinds;
  for (const auto& f : found.forms) kinds.emplace_back(kind_of(f.form));
  std::ranges::sort(kinds);
  CHECK(kinds == std::vector<std::string>{"cylinder", "cylinder", "torus"});
}

TEST_CASE("recognise: boxes that touch stay boxes") {
  Mesh mesh;
  Form box = form_of(BoxForm{{1, 2, 3}});
  box.frame = {};
  for (int i = 0; i < 3; ++i) add(mesh, box, translation_matrix({double(i), 0, 0}), 4, Style::soup);
  add(mesh, box, translation_matrix({3, 2, 0}), 4, Style::soup);
  const auto found = recognise_forms(mesh);
  CHECK(found.rest.empty());
  CHECK(found.forms.size() == 4);
  for (const auto& f : found.forms) {
    CHECK(kind_of(f.form) == "box");
    CHECK_FALSE(f.inside_out);
  }
}

TEST_CASE("recognise: faces that point inwards, mirrored, turned over one by one") {
  for (const Form& form : {form_of(CylinderForm{2, 5}, 16), form_of(TorusForm{3, 1, pi / 2, 0.3}, 10, 6),
                           form_of(BoxForm{{1, 2, 3}}), form_of(DishForm{2, 1, false}, 12, 5)}) {
    INFO(kind_of(form));
    Mesh mirrored;
    add(mirrored, form, scale_matrix({-1, 1, 1}));
    auto found = recognise_forms(mirrored);
    REQUIRE(found.forms.size() == 1);
    CHECK(found.forms[0].inside_out);
    mirrored.ccw = false;
    found = recognise_forms(mirrored);
    REQUIRE(found.forms.size() == 1);
    CHECK_FALSE(found.forms[0].inside_out);
    CHECK(kind_of(found.forms[0].form) == kind_of(form));
    Mesh mixed;
    add(mixed, form);
    std::reverse(mixed.corners.begin() + mixed.face_begin[1], mixed.corners.begin() + mixed.face_begin[2]);
    found = recognise_forms(mixed);
    REQUIRE(found.forms.size() == 1);
    CHECK(found.forms[0].inside_out);
  }
}

TEST_CASE("recognise: what fits nothing stays") {
  Mesh mesh;
  add(mesh, form_of(CylinderForm{2, 5}, 16));
  auto& p = mesh.positions.edit();
  p[0] += 0.2;  // a dent
  auto found = recognise_forms(mesh);
  CHECK(found.forms.empty());
  CHECK(found.rest.size() == mesh.n_faces());
  CHECK(recognise_forms(mesh, {.tolerance = 0.25}).forms.size() == 1);
  for (const auto& f : recognise_forms(mesh, {.tolerance = 0.15}).forms) CHECK(f.residual <= 0.15);
  CHECK(recognise_forms(mesh, {.tolerance = 0.05}).forms.empty());
}

TEST_CASE("recognise: hostile meshes") {
  Mesh flat;  // no thickness
  add(flat, form_of(BoxForm{{1, 0, 3}}));
  CHECK_NOTHROW(recognise_forms(flat));
  Mesh twice;  // every face two times
  add(twice, form_of(CylinderForm{2, 5}, 16), {}, 4, Style::soup);
  add(twice, form_of(CylinderForm{2, 5}, 16), {}, 4, Style::soup);
  CHECK_NOTHROW(recognise_forms(twice));
  Mesh strange;
  add(strange, form_of(CylinderForm{2, 5}, 16));
  strange.positions.edit()[4] = std::numeric_limits<double>::quiet_NaN();
  CHECK_NOTHROW(recognise_forms(strange));
  strange.positions.edit()[4] = std::numeric_limits<double>::infinity();
  CHECK_NOTHROW(recognise_forms(strange));
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Mesh mesh;
    mesh.kind = Mesh::Kind::faces;
    auto& p = mesh.positions.edit();
    for (int i = 0; i < 24; ++i) p.push_back(static_cast<double>(random() % 3));
    for (int i = 0; i < 60; ++i) mesh.corners.push_back(random() % 8);
    const auto found = recognise_forms(mesh);
    for (const auto& f : found.forms) CHECK(f.residual < 0.2);
  }
}

TEST_CASE("recognise: the cost grows with the number of parts") {
  auto seconds = [](int n) {
    Mesh mesh;
    for (int i = 0; i < n; ++i)
      add(mesh, form_of(CylinderForm{0.01, 0.08}, 6), translation_matrix({0.1 * (i % 300), 0.1 * (i / 300), 0}), 4,
          Style::soup);
    const auto start = std::chrono::steady_clock::now();
    const auto found = recognise_forms(mesh);
    CHECK(found.forms.size() == static_cast<std::size_t>(n));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double few = seconds(2000), many = seconds(20000);
  CHECK(many < 40 * few + 0.1);
}
