// Pages: where charts are placed on them.
#include "tests/unit/folders.h"
#include "tests/unit/unwrap_fixture.h"

using namespace wrlkit;
using namespace wrlkit::unwrap_tests;
using namespace wrlkit::unwrap;
namespace fs = std::filesystem;

TEST_CASE("unwrap: charts keep their distance") {
  for (int padding : {0, 1, 2, 5})
    for (unsigned seed : {1u, 2u}) {
      Charts c = random_charts(80, 20, seed);
      PackItem item{&c};
      Atlas fitted = pack({&item, 1}, {.padding = padding, .side = 200});
      CHECK(fitted.pages.size() == 1);
      check({&item, 1}, fitted, padding);
      Atlas dense = pack({&item, 1}, {.padding = padding, .max_side = 64});
      CHECK(dense.pages.size() > 1);
      CHECK(dense.factor == 1);
      check({&item, 1}, dense, padding);
    }
}

TEST_CASE("unwrap: turning does not mirror") {
  Charts c = random_charts(200, 10, 3);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {.side = 256});
  std::set<int> turns;
  for (std::size_t t = 0; t < c.chart_of.size(); ++t) {
    const Placement& p = atlas.items[0].charts[c.chart_of[t]];
    Triangle2 before = places(c, t), after{p.apply(before[0]), p.apply(before[1]), p.apply(before[2])};
    CHECK(area(after) == Approx(area(before) * p.scale * p.scale).margin(1e-9));
    turns.insert(p.quarter_turns);
  }
  CHECK(turns.size() > 1);
}

TEST_CASE("unwrap: copies are placed as one piece") {
  Charts a = random_charts(12, 9, 4), b = random_charts(30, 6, 5);
  PackItem items[] = {{&a, 1.5, 7}, {&b, 1, 1}};
  for (int side : {0, 128}) {
    Atlas atlas = pack(items, {.side = side});
    check(items, atlas, 2);
    CHECK(atlas.items[0].copies.size() == 7);
    CHECK(atlas.items[1].copies.empty());
    for (const Placement& p : atlas.items[0].copies) CHECK(p.scale == 1);
    for (const Placement& p : atlas.items[0].charts) CHECK(p.scale == Approx(1.5 * atlas.factor));
  }
}

TEST_CASE("unwrap: what is less than a texel has one") {
  Charts c = random_charts(500, 0.3, 6);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {});
  check({&item, 1}, atlas, 2);
  for (std::uint32_t k = 0; k < c.size(); ++k) {
    // The middle of its box is the middle of a texel.
    Point2 m = atlas.items[0].charts[k].apply({c.sizes[k].x / 2, c.sizes[k].y / 2});
    CHECK(m.x - std::floor(m.x) == Approx(0.5));
    CHECK(m.y - std::floor(m.y) == Approx(0.5));
  }
  // More of them than a page has room for: more pages.
  Charts many = random_charts(3000, 0.3, 7);
  item.charts = &many;
  atlas = pack({&item, 1}, {.side = 64});
  CHECK(atlas.pages.size() > 3);
  check({&item, 1}, atlas, 2);
}

TEST_CASE("unwrap: a chart larger than a page is scaled down") {
  Charts c = random_charts(3, 1000, 8);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {.max_side = 128});
  check({&item, 1}, atlas, 2);
  for (const Page& p : atlas.pages) CHECK((p.width == 128 && p.height <= 128));
}

TEST_CASE("unwrap: one page as small as it can be") {
  Charts c = random_charts(40, 20, 9);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {});
  check({&item, 1}, atlas, 2);
  REQUIRE(atlas.pages.size() == 1);
  double covered = 0;
  for (std::size_t t = 0; t < c.chart_of.size(); ++t) covered += area(places(c, t));
  CHECK(covered > 0.2 * atlas.pages[0].width * atlas.pages[0].height);
  // A strip that is longer than the square of its area is wide.
  Solid bar = sheet(1, 1, false, [](double u, double v) { return P3{300 * u, 2 * v, 0}; });
  c = bar.charts();
  atlas = pack({&item, 1}, {});
  REQUIRE(atlas.pages.size() == 1);
  CHECK((atlas.pages[0].width == 512 && atlas.pages[0].height == 2));
  CHECK(atlas.items[0].charts[0].scale == 1);
}

TEST_CASE("unwrap: more charts in a copy than a page has texels") {
  Charts c = random_charts(200, 3, 10);
  PackItem item{&c, 1, 3};
  for (const PackOptions& options : {PackOptions{.max_side = 16}, PackOptions{.side = 16}}) {
    Atlas atlas = pack({&item, 1}, options);
    CHECK(texels({&item, 1}, atlas, 0).outside == 0);
    CHECK(atlas.pages.size() == 3);
    CHECK(atlas.items[0].crowded);
  }
  CHECK_FALSE(pack({&item, 1}, {.max_side = 256}).items[0].crowded);
}

TEST_CASE("unwrap: nothing to pack") {
  Charts none;
  none.begin = {0};
  PackItem item{&none};
  CHECK(pack({}, {}).items.empty());
  CHECK(pack({&item, 1}, {.side = 64}).items.size() == 1);
  CHECK(pack({&item, 1}, {}).items[0].charts.empty());
}

TEST_CASE("unwrap: the same on any number of threads") {
  Solid s = sheet(60, 30, true, [](double u, double v) {
    double a = 2 * pi * u, b = pi * (0.02 + 0.96 * v), r = 1 + 0.2 * std::sin(5 * a) * std::sin(3 * b);
    return P3{r * std::sin(b) * std::cos(a), r * std::sin(b) * std::sin(a), -r * std::cos(b)};
  });
  std::vector<Atlas> atlases;
  std::vector<Charts> charts;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    charts.push_back(s.charts());
    PackItem item{&charts.back()};
    atlases.push_back(pack({&item, 1}, {.side = 256}));
  }
  CHECK(charts[0].chart_of == charts[1].chart_of);
  for (std::size_t i = 0; i < charts[0].places.size(); ++i)
    REQUIRE((charts[0].places[i].x == charts[1].places[i].x && charts[0].places[i].y == charts[1].places[i].y));
  for (std::size_t k = 0; k < charts[0].size(); ++k)
    CHECK(same(atlases[0].items[0].charts[k], atlases[1].items[0].charts[k]));
}

TEST_CASE("unwrap: scans and parts", "[found]") {
  const auto folder = shared_folder("meshes");
  if (!fs::exists(folder)) {
    return skip("there is no folder " + folder.string() + " (WRLKIT_SHARED)");
  }
  for (std::string name : {"bunny", "fandisk", "flange", "ibeam", "valve", "ellhole452"}) {
    INFO(name);
    Diagnostics diag;
    Statistics stats;
    auto world = read_world((folder / (name + ".wrl.gz")).string(), {}, diag);
    REQUIRE(world);
    PassContext ctx{diag, stats};
    std::string why;
    auto pipeline = Pipeline::parse("weld,triangulate", why);
    MeshSource source = pipeline->run_lazily(world->scene, ctx);
    for (std::uint32_t i = 0; i < world->scene.node_count(); ++i) {
      if (!world->scene.is(NodeId{i}, nodes::X3DGeometryNode)) continue;
      const Mesh& m = source(NodeId{i});
      Solid s;
      s.positions.assign(m.positions.span().begin(), m.positions.span().end());
      s.corners = m.corners;
      Charts c = s.charts();
      check(s, c);
      CHECK(stretch(s, c) < 1.02);
      CHECK(c.size() < s.size() / 50 + 6);
      PackItem item{&c};
      check({&item, 1}, pack({&item, 1}, {.side = 512}), 2);
    }
  }
}
