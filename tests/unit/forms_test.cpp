// Forms and what they are cut into: closed surfaces that face outwards, with the area and the number of triangles that
// are promised.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "base/math/vec.h"
#include "form_fixture.h"
#include "geometry/deviation.h"
#include "geometry/forms/form.h"

using namespace wrlkit;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<Form> some_of_each() {
  const PrismForm angle{{{0, 0}, {0, 4}, {1, 4}, {1, 1}, {3, 1}, {3, 0}}, {6}, 5, 0};
  const PrismForm tube{{{-2, -2}, {-2, 2}, {2, 2}, {2, -2}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {4, 8}, 5, 0};
  return {form_of(CylinderForm{2, 5}, 16),
          form_of(FrustumForm{2, 1, 3, {}, {}, {}}, 12),
          form_of(FrustumForm{2, 0, 3, {0.5, 1}, {}, {}}, 12),
          form_of(FrustumForm{1, 1, 4, {}, {0.3, 0.1}, {0, -0.4}}, 12),
          form_of(TorusForm{3, 1, pi / 2, 0.3}, 10, 6),
          form_of(TorusForm{3, 1, 2 * pi, 0}, 10, 9),
          form_of(RectangularTorusForm{2, 3, 1, 2.5}, 9),
          form_of(RectangularTorusForm{2, 3, 1, 2 * pi}, 9),
          form_of(SphereForm{2}, 12, 7),
          form_of(DishForm{2, 1, false}, 12, 5),
          form_of(DishForm{2, 0.6, true}, 12, 5),
          form_of(DishForm{2, 3, true}, 12, 5),
          form_of(BoxForm{{1, 2, 3}}),
          form_of(PyramidForm{{2, 1}, {1, 3}, 2, {0.5, 0.2}}),
          form_of(PyramidForm{{2, 1}, {1, 0}, 2, {}}),
          form_of(PyramidForm{{2, 1}, {0, 0}, 2, {1, 0}}),
          form_of(angle),
          form_of(tube),
          form_of(RingForm{1, 2, 0.5}, 16)};
}

Vec3 at(const Mesh& mesh, std::size_t corner) {
  const double* p = mesh.positions.data() + std::size_t{mesh.corners[corner]} * 3;
  return {p[0], p[1], p[2]};
}

struct Measures {
  double area = 0, volume = 0, worst_normal = 1;
  std::size_t triangles = 0, open_edges = 0;
};

Measures measure(const Mesh& mesh) {
  Measures out;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const Vec3 origin{3, -2, 7};
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    const std::size_t begin = mesh.begin_of(f), end = mesh.end_of(f);
    Vec3 sum{};
    for (std::size_t i = begin + 2; i < end; ++i)
      sum = sum + cross(at(mesh, i - 1) - at(mesh, begin), at(mesh, i) - at(mesh, begin));
    out.area += length(sum) / 2;
    out.volume += dot(sum, at(mesh, begin) - origin) / 6;
    out.triangles += end - begin - 2;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t k = i + 1 == end ? begin : i + 1;
      ++edges[{mesh.corners[i], mesh.corners[k]}];
      --edges[{mesh.corners[k], mesh.corners[i]}];
      const float* n = mesh.normal.at(mesh.normal.index[i]);
      out.worst_normal = std::min(out.worst_normal, dot(unit(sum), {n[0], n[1], n[2]}));
    }
  }
  for (const auto& [edge, n] : edges) out.open_edges += n != 0;
  return out;
}

Mesh cut_triangles(const Form& form, const FormCut& cut) {
  Mesh faces, out;
  tessellate_form(form, cut, faces);
  out.kind = Mesh::Kind::faces;
  out.positions = faces.positions;
  for (std::size_t f = 0; f < faces.n_faces(); ++f)
    for (std::size_t i = faces.begin_of(f) + 2; i < faces.end_of(f); ++i)
      out.corners.insert(out.corners.end(), {faces.corners[faces.begin_of(f)], faces.corners[i - 1], faces.corners[i]});
  return out;
}

}  // namespace

TEST_CASE("forms: closed, facing outwards, as many triangles as said") {
  Mesh mesh;
  for (const Form& form : some_of_each()) {
    INFO(kind_of(form));
    tessellate_form(form, {}, mesh);
    const Measures m = measure(mesh);
    CHECK(m.open_edges == 0);
    CHECK(m.volume > 0);
    CHECK(m.worst_normal > 0.5);
    CHECK(m.triangles == n_triangles(form, {}));
  }
}

TEST_CASE("forms: fine cuts come to the area of the form") {
  const std::vector<std::pair<Form, double>> areas{
      {form_of(CylinderForm{2, 5}), 2 * pi * 2 * (5 + 2)},
      {form_of(FrustumForm{2, 1, 3, {}, {}, {}}), pi * (3 * std::sqrt(10) + 4 + 1)},
      {form_of(TorusForm{3, 1, pi / 2, 0.3}), pi / 2 * 3 * 2 * pi + 2 * pi},
      {form_of(RectangularTorusForm{2, 3, 1, 2.5}), 2.5 * 5 * 2 + 2},
      {form_of(SphereForm{2}), 16 * pi},
      {form_of(DishForm{2, 0.6, true}), pi * (4 + 0.36) + 4 * pi},
      {form_of(RingForm{1, 2, 0.5}), 2 * pi * 3 * 0.5 + 2 * pi * 3},
  };
  Mesh mesh;
  for (const auto& [form, area] : areas) {
    INFO(kind_of(form));
    tessellate_form(form, {150, 150}, mesh);
    CHECK_THAT(measure(mesh).area, WithinRel(area, 3e-3));
  }
}

TEST_CASE("forms: chords stay within the tolerance that they were cut for") {
  for (const Form& form : some_of_each()) {
    if (std::holds_alternative<PrismForm>(form.shape)) continue;  // has no chords
    for (double tolerance : {0.3, 0.01}) {
      INFO(kind_of(form));
      const Mesh coarse = cut_triangles(form, cut_within(form, tolerance)), fine = cut_triangles(form, {400, 200});
      CHECK(measure_deviation(triangles_of(coarse), triangles_of(fine)).max <= tolerance * 1.02);  // slanted ends
    }
  }
  CHECK(cut_within(form_of(CylinderForm{1, 1}), 0.5).segments == 3);
  CHECK(cut_within(form_of(CylinderForm{1, 1}), 1e-3).segments == 71);
}

TEST_CASE("forms: polygons of equal area") {
  Mesh mesh;
  const Form pipe = form_of(CylinderForm{1, 2});
  for (int n : {3, 5, 6, 8}) {
    tessellate_form(pipe, {n, 0, true}, mesh);
    CHECK_THAT(measure(mesh).volume, WithinRel(2 * pi, 1e-9));
  }
}

TEST_CASE("forms: round ends go on where the form ends") {
  Mesh mesh;
  for (const Form& form : {form_of(CylinderForm{2, 5}, 16), form_of(TorusForm{3, 1, 1.2, 0.3}, 10, 6),
                           form_of(DishForm{2, 1, false}, 12, 5), form_of(FrustumForm{2, 1, 3, {1, 0}, {}, {}}, 12)}) {
    INFO(kind_of(form));
    tessellate_form(form, {}, mesh);
    for (const FormEnd& end : round_ends(form)) {
      const Vec3 first = end.centre + end.radius * end.first;
      double nearest = 1e9;
      for (std::size_t c = 0; c < mesh.corners.size(); ++c) nearest = std::min(nearest, length(at(mesh, c) - first));
      CHECK_THAT(nearest, WithinAbs(0, 1e-9));
      CHECK_THAT(length(end.axis), WithinAbs(1, 1e-12));
    }
  }
}
