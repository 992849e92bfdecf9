// Where pictures are taken from: Viewpoints, fit, levels of detail, Billboards, instances, worlds far away.
#include <tbb/global_control.h>

#include "light/render/camera.h"
#include "light/render/light.h"
#include "light/render/shade.h"
#include "tests/unit/render_fixture.h"

using namespace wrlkit;
using namespace wrlkit::render_tests;
using drawing::V3;

TEST_CASE("render: Viewpoints are found by name and description, in their transformation") {
  const std::string views =
      "Viewpoint { position 5 0 10 } DEF Named Viewpoint { position 50 0 10 description \"from the right\" } " +
      transform("translation 100 0 0 rotation 0 1 0 1.5707963", "DEF Turned Viewpoint { position 0 0 10 }");
  const std::string world = views + transform("translation 5 0 0", shape("Sphere { }", emitting("1 0 0"))) +
                            transform("translation 50 0 0", shape("Sphere { }", emitting("0 1 0"))) +
                            transform("translation 100 0 0", shape("Sphere { }", emitting("0 0 1")));
  Studio s;
  auto seen = [&](const std::string& name) {
    s.options.viewpoint = name;
    return middle(s.render(world));
  };
  CHECK(seen("") == Rgb{255, 0, 0});
  CHECK(seen("Named") == Rgb{0, 255, 0});
  CHECK(seen("from the right") == Rgb{0, 255, 0});
  CHECK(seen("Turned") == Rgb{0, 0, 255});
  CHECK(s.diag.count(Diag::viewpoint_not_found) == 0);
  CHECK(seen("None") == Rgb{255, 0, 0});
  CHECK(s.diag.count(Diag::viewpoint_not_found) == 1);
  s.options.look_at = LookAt{{50, 10, 0}, {50, 0, 0}, {0, 1, 0}};
  CHECK(seen("") == Rgb{0, 255, 0});
}

TEST_CASE("render: fit shows all of a box, with a margin") {
  using namespace drawing;
  for (auto [w, h] : {std::pair{1280, 960}, {300, 900}})
    for (V3 size : {V3(1, 1, 1), V3(100, 1, 0.1), V3(0.01, 5, 3), V3(4, 2, 0), V3(0, 9, 0)}) {
      Box box;
      box.add({1e6, -5, 3});
      box.add(V3(1e6, -5, 3) + size);
      Camera c = camera_on(box, {w, h, 0.785398});
      double most = 0;
      for (int i = 0; i < 8; ++i) {
        V3 p = c.project(box.corner(i));
        CHECK(p.z > 0);
        most = std::max({most, std::fabs(2 * p.x / p.z / w - 1), std::fabs(2 * p.y / p.z / h - 1)});
      }
      CHECK(most == Approx(0.9).epsilon(1e-6));
    }
}

TEST_CASE("render: a world far from the origin looks like one at the origin") {
  const std::string things = shape("Cone { }", "diffuseColor 0.8 0.5 0.2") +
                             transform("translation 2 1 -1", shape("Sphere { }", "specularColor 1 1 1"));
  auto near = render(view + things);
  auto far = render(transform("translation 1e6 -3e6 2e6", view + things));
  CHECK(largest_difference(near, far) <= 1);
  // The same with the distance in the coordinates themselves.
  auto wall = [&](double x) {
    return render(transform("translation " + std::to_string(-x) + " 0 0",
                            shape(quad(x - 2, -2, x + 2, 2), "diffuseColor 1 0.5 0")) +
                  view);
  };
  CHECK(largest_difference(wall(0), wall(8e6)) <= 1);
}

TEST_CASE("render: transformations without sense draw nothing and break nothing") {
  const std::string ball = shape("Sphere { }", emitting("1 1 1"));
  CHECK(area(render(view + transform("scale 0 0 0", ball))) == 0);
  CHECK(area(render(view + transform("scale 1 1 0", ball))) > 300);
  CHECK(area(render(view + transform("scale 1e300 1e300 1e300", transform("scale 1e300 1e300 1e300", ball)))) == 0);
  CHECK(area(render(
            view +
            shape("IndexedFaceSet { coord Coordinate { point [ 0 0 0, 0 0 0, 1e30 0 0 ] } coordIndex [ 0 1 2 ] }"))) ==
        0);
  CHECK(area(render("Viewpoint { position 1e300 0 0 } " + transform("scale 0 1 1", "PointLight { }") + ball)) >= 0);
  CHECK(area(render("Viewpoint { orientation 0 0 0 0 } " + transform("rotation 0 0 0 1", ball))) > 300);
}

TEST_CASE("render: a world that doubles itself forty times ends") {
  std::string world = "DEF G0 Group { children Shape { geometry Box { } } } ";
  for (int i = 1; i <= 40; ++i) {
    auto below = "G" + std::to_string(i - 1);
    world += "DEF G" + std::to_string(i) + " Group { children [ USE " + below + " USE " + below + " ] } ";
  }
  world += "Transform { translation 9 0 0 children Shape { geometry Box { } } } ";
  Diagnostics diag;
  auto parsed = parse_world("#VRML V2.0 utf8\n" + world, "bomb.wrl", {}, diag);
  auto stage_within = [&](const drawing::StageLimits& limits) {
    return drawing::set_stage(parsed->scene, diag, {.limits = limits});
  };
  const std::size_t nodes = parsed->scene.node_count();
  auto stage = stage_within({.visits = 100'000, .shapes = 1000});
  CHECK(stage.uses.size() == 1000 + nodes);
  CHECK(diag.count(Diag::expansion_limit) == 1);
  stage = stage_within({.visits = 1000, .shapes = 100'000});
  CHECK(stage.uses.size() <= 1000 + nodes);
  CHECK(diag.count(Diag::expansion_limit) == 2);
  // A limit for each node leaves room for what comes after the doublings.
  stage = stage_within({.uses = 1000});
  REQUIRE(stage.uses.size() == 1001);
  CHECK(stage.frames[stage.uses.back().frame].t.x == 9);
  CHECK(diag.count(Diag::expansion_limit) == 3);
  CHECK(middle(render(view + world)) == Rgb{255, 255, 255});
}

TEST_CASE("render: Billboards turn to the viewer") {
  const std::string sign = shape(quad(-2, -2, 2, 2), emitting("1 1 1"));
  const std::string from_side = "Viewpoint { position 10 0 0 orientation 0 1 0 1.5707963 fieldOfView 0.927295218 } ";
  CHECK(area(render(from_side + sign)) == 0);
  CHECK(area(render(from_side + "Billboard { children " + sign + " }")) == Approx(40.4 * 40.4).epsilon(0.01));
  CHECK(area(render(from_side + "Billboard { axisOfRotation 0 0 0 children " + sign + " }")) ==
        Approx(40.4 * 40.4).epsilon(0.01));
  CHECK(area(render(from_side + "Billboard { axisOfRotation 1 0 0 children " + sign + " }")) == 0);
}

TEST_CASE("render: LODs show the level that is asked for, or the one for their distance") {
  auto seen = [](std::optional<std::size_t> level, const std::string& fields,
                 RenderOptions::Mode mode = RenderOptions::Mode::preview) {
    std::string levels;
    for (const char* color : {"1 0 0", "0 1 0", "0 0 1", "1 1 1"}) levels += shape("Sphere { }", emitting(color));
    Studio s;
    s.options.level = level;
    s.options.mode = mode;
    return middle(s.render(view + transform("scale 2 2 2", "LOD { " + fields + " level [ " + levels + "] } ")));
  };
  const Rgb red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};
  const std::string near = "range [ 5.1 8 ]";
  CHECK(seen(0, near) == red);
  CHECK(seen(2, near) == blue);
  CHECK(seen(3, near) == white);
  CHECK(seen(99, near) == white);
  // The eye is 10 m away, 5 in the coordinates of the LOD.
  CHECK(seen({}, near) == red);
  CHECK(seen({}, "range [ 5 8 ]") == green);
  CHECK(seen({}, "range [ 4.9 5.1 ]") == green);
  CHECK(seen({}, "range [ 1 2 ]") == blue);  // the fourth level is one too many
  CHECK(seen({}, "range [ 1 2 3 4 4.5 ]") == white);
  CHECK(seen({}, "range [ 1 2 3 4 5.1 ]") == white);
  CHECK(seen({}, "") == red);
  CHECK(seen({}, "center 0 0 3 range 4 ") == red);
  CHECK(seen({}, "center 0 0 -3 range 6 ") == green);
  CHECK(seen({}, "range [ 1 2 ]", RenderOptions::Mode::path) == blue);
  CHECK(seen(1, "", RenderOptions::Mode::path) == green);
}

TEST_CASE("render: the level does not change where the picture is taken from, and LODs within levels have theirs") {
  Studio s;
  const std::string small = shape("Box { size 1 1 1 }", emitting("1 1 1")),
                    large = shape("Box { size 4 4 4 }", emitting("1 1 1"));
  s.options.fit = true;
  const double all = area(s.render("LOD { range 1 level [ " + large + small + " ] }"));
  s.options.level = 1;
  CHECK(area(s.render("LOD { range 1 level [ " + large + small + " ] }")) == Approx(all / 16).epsilon(0.3));
  const std::string red = shape("Box { }", emitting("1 0 0")), green = shape("Box { }", emitting("0 1 0")),
                    blue = shape("Box { }", emitting("0 0 1"));
  s.options.level.reset();
  CHECK(middle(s.render("LOD { range 1 level [ " + red + "Group { children LOD { range 1000 level [ " + green + blue +
                        "] } } ] }")) == Rgb{0, 255, 0});
}

TEST_CASE("render: wireframe shows edges, and only those in front") {
  Studio s;
  s.options.mode = RenderOptions::Mode::wireframe;
  auto image = s.render(view + shape(quad(-4, -4, 4, 4)) + shape(quad(-3, -3, 3, 2, -2)));
  CHECK(pixel(image, 2, 2) == Rgb{255, 255, 255});
  CHECK(pixel(image, 50, 30)[0] > 200);
  CHECK(pixel(image, 50, 30)[0] < 235);
  int dark_in_row = 0, dark_in_column = 0;
  for (int k = 0; k < 101; ++k) {
    dark_in_row += pixel(image, k, 40)[0] < 180;
    dark_in_column += pixel(image, 60, k)[0] < 180;
  }
  // Left edge, diagonal and right edge, each a pixel or two wide; likewise up and down.
  CHECK(dark_in_row >= 3);
  CHECK(dark_in_row <= 7);
  CHECK(dark_in_column >= 3);
  CHECK(dark_in_column <= 7);
}

TEST_CASE("render: the same picture on any number of threads") {
  std::string world = view;
  for (int i = 0; i < 40; ++i)
    world += transform(
        "translation " + std::to_string(i % 7 - 3) + " " + std::to_string(i % 5 - 2) + " 0",
        shape("Sphere { }", "transparency 0.3 specularColor 1 1 1") + shape("Box { }", "diffuseColor 1 0.5 0"));
  auto on = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return render(world);
  };
  CHECK(on(1).pixels == on(4).pixels);
}

TEST_CASE("render: instances look like copies") {
  using namespace drawing;
  Studio s;
  auto world =
      parse_world("#VRML V2.0 utf8\n" + dark + view + "DirectionalLight { direction -1 -1 -1 } " +
                      transform("translation -2 0 0", "DEF Ball " + shape("Sphere { }", "specularColor 1 1 1")) +
                      transform("translation 2 0 0 scale -1 2 0.5 rotation 0 0 1 1", "USE Ball ") +
                      transform("scale 1 1 0", "USE Ball "),
                  "test.wrl", {}, s.diag);
  std::string why;
  auto pipeline = Pipeline::parse("picture", why);
  PassContext ctx{s.diag, s.stats, nullptr};
  auto source = pipeline->run_lazily(world->scene, ctx);
  Stage stage = set_stage(world->scene, s.diag);
  MeshPool pool;
  std::vector<std::uint32_t> mesh_of(3, pool.add(source(stage.uses[0].geometry))), surface_of(3);
  Camera camera = camera_in(translation({0, 0, 10}), {101, 101, 0.927});
  std::size_t hits = 0;
  Tracer copies(stage, pool, mesh_of, camera, {}, s.diag),
      instances(stage, pool, mesh_of, camera, {.all_flat = 0}, s.diag);
  Surfaces surfaces(world->scene, nullptr, s.diag);
  Drawing drawing{stage, pool, surfaces, mesh_of, surface_of};
  for (int y = 0; y < 101; y += 5)
    for (int x = 0; x < 101; x += 5) {
      Ray ray{camera.eye, camera.direction(x + 0.3, y + 0.6)};
      Hit a, b;
      bool hit = copies.nearest(ray, 0, a);
      REQUIRE(hit == instances.nearest(ray, 0, b));
      if (!hit) continue;
      ++hits;
      CHECK(a.use == b.use);
      CHECK(a.distance == Approx(b.distance).epsilon(1e-5));
      CHECK(length(spot_at(drawing, ray, a).normal - spot_at(drawing, ray, b).normal) < 1e-3);
      CHECK(dot(spot_at(drawing, ray, a).normal, ray.direction) < 0.01);
    }
  CHECK(hits > 30);
}
