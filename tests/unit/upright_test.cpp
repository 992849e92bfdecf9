// A form may be turned within its symmetry and divided by its size: its faces stay where they are.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/math/vec.h"
#include "form_fixture.h"
#include "geometry/forms/upright.h"
#include "passes/instance/unit_form.h"

using namespace wrlkit;

namespace {

constexpr double pi = std::numbers::pi;

PrismForm angle_profile() {
  PrismForm f;
  f.points = {{0.3, 0.1}, {0.3, -0.2}, {0.2, -0.2}, {0.2, 0}, {-0.1, 0}, {-0.1, 0.1}};
  f.ring_ends = {6};
  f.height = 2;
  return f;
}

std::vector<Form> all_forms() {
  std::vector<Form> out{form_of(CylinderForm{0.2, 3}, 12),
                        form_of(CylinderForm{0.2, 3}, 7),
                        form_of(FrustumForm{0.2, 0.1, 3, {}, {}, {}}, 8),
                        form_of(FrustumForm{0.2, 0.1, 3, {0.1, 0.2}, {}, {}}, 8),
                        form_of(TorusForm{2, 0.3, pi / 2, 0}, 8, 4),
                        form_of(TorusForm{2, 0.3, pi / 3, 0.2}, 8, 4),
                        form_of(TorusForm{2, 0.3, 2 * pi, 0}, 8, 12),
                        form_of(RectangularTorusForm{1, 2, 0.5, 1}, 6),
                        form_of(SphereForm{0.4}, 8, 5),
                        form_of(DishForm{1, 0.5, false}, 12, 4),
                        form_of(DishForm{1, 0.5, true}, 12, 4),
                        form_of(BoxForm{{1, 2, 3}}),
                        form_of(PyramidForm{{1, 2}, {0.5, 0}, 1, {0.1, 0}}),
                        form_of(angle_profile()),
                        form_of(RingForm{0.1, 0.3, 0.2}, 16)};
  const auto closed = out.size();
  for (std::size_t i = 0; i < closed; ++i) {
    out.push_back(out[i]);
    out.back().bottom = false;
  }
  return out;
}

std::vector<Vec3> points_of(const Form& form, const Vec3& scale = {1, 1, 1}) {
  Mesh mesh;
  Form own = form;
  own.frame = {};
  tessellate_form(own, {}, mesh);
  std::vector<Vec3> out;
  for (auto c : mesh.corners) {
    const double* p = mesh.positions.data() + std::size_t{c} * 3;
    out.push_back(form.frame.point({p[0] * scale[0], p[1] * scale[1], p[2] * scale[2]}));
  }
  return out;
}

/// Each corner of the one is a corner of the other, equally often.
bool same_corners(const std::vector<Vec3>& a, std::vector<Vec3> b) {
  if (a.size() != b.size()) return false;
  for (const Vec3& p : a) {
    const auto near = std::ranges::find_if(b, [&](const Vec3& q) { return length(p - q) < 1e-9; });
    if (near == b.end()) return false;
    *near = b.back();
    b.pop_back();
  }
  return true;
}

double turn_of(const Matrix& m) { return std::acos(std::clamp((m(0, 0) + m(1, 1) + m(2, 2) - 1) / 2, -1.0, 1.0)); }

}  // namespace

TEST_CASE("upright forms have the same faces, and turning them again does nothing", "[upright]") {
  for (const Form& form : all_forms()) {
    CAPTURE(kind_of(form), form.bottom, form.segments);
    Form upright = form;
    turn_upright(upright);
    CHECK(same_corners(points_of(form), points_of(upright)));
    CHECK(upright.frame.determinant() == Approx(1));
    Form again = upright;
    turn_upright(again);
    CHECK(again.frame == upright.frame);
  }
}

TEST_CASE("parts that stand alike have one frame, whichever point comes first", "[upright]") {
  Form pipe = form_of(CylinderForm{0.2, 3}, 12);
  pipe.frame = rotation_matrix({0, 0, 1, pi}) * rotation_matrix({0, 1, 0, 5 * pi / 6});
  turn_upright(pipe);
  CHECK(turn_of(pipe.frame) == Approx(0).margin(1e-6));

  Form box = form_of(BoxForm{{1, 2, 3}});
  box.frame = rotation_matrix({1, 1, 1, 2 * pi / 3});
  turn_upright(box);
  CHECK(turn_of(box.frame) == Approx(0).margin(1e-6));
  CHECK(std::get<BoxForm>(box.shape).size == Vec3{3, 1, 2});

  Form one = form_of(angle_profile()), other = one;
  auto& points = std::get<PrismForm>(other.shape).points;
  for (Vec2& p : points) p = {p[1], -p[0]};
  std::rotate(points.begin(), points.begin() + 2, points.end());
  other.frame = other.frame * rotation_matrix({0, 1, 0, -pi / 2});
  REQUIRE(same_corners(points_of(one), points_of(other)));
  turn_upright(one);
  turn_upright(other);
  CHECK(std::get<PrismForm>(one.shape).points == points);
}

TEST_CASE("a unit form and its scale are the form", "[upright]") {
  for (const Form& form : all_forms()) {
    CAPTURE(kind_of(form), form.bottom, form.segments);
    const auto unit = instancing::unit_form(form, true);
    REQUIRE(unit);
    Form placed = unit->form;
    placed.frame = form.frame;
    CHECK(same_corners(points_of(form), points_of(placed, unit->scale)));
    Form larger = form;
    if (auto* cylinder = std::get_if<CylinderForm>(&larger.shape)) {
      cylinder->height *= 3;
      CHECK(instancing::unit_form(larger, true)->key == unit->key);
      CHECK(instancing::unit_form(larger, false)->key != unit->key);
      larger.segments += 1;
      CHECK(instancing::unit_form(larger, true)->key != unit->key);
    }
  }
  CHECK(!instancing::unit_form(form_of(CylinderForm{1, 1}), true));
}
