#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "convert/tiles.h"
#include "convert/tiles/coarser.h"
#include "convert/tiles/farthest_point.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece_store.h"
#include "convert/tiles/reading_progress.h"
#include "convert/tiles/staging.h"
#include "convert/tiles/surface_error.h"
#include "geometry/space_cells.h"
#include "scenegraph/nodes.h"
#include "tests/unit/temp_folder.h"
#include "writers/tiles/tileset.h"

using namespace wrlkit;

namespace {

/// A square of two triangles in the plane of x and z.
Mesh square(double x, double y, double size) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.positions.edit() = {x, y, 0, x, y, size, x + size, y, size, x + size, y, 0};
  m.corners = {0, 1, 2, 0, 2, 3};
  return m;
}

/// A sheet of 2 n * n triangles with waves, from x on.
Mesh waves(double x, std::uint32_t n) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  auto& points = m.positions.edit();
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t k = 0; k <= n; ++k) {
      const double u = double(i) / n, v = double(k) / n;
      points.insert(points.end(), {x + u, 0.1 * std::sin(7 * u) * std::cos(9 * v), v});
      if (const auto at = i * (n + 1) + k; i < n && k < n)
        m.corners.insert(m.corners.end(), {at, at + 1, at + n + 1, at + 1, at + n + 2, at + n + 1});
    }
  return m;
}

tiles::Piece piece(std::string name, Mesh mesh) { return {std::move(name), 0, 0, std::move(mesh)}; }

/// Boxes in a row, in a file.
TilesInput row_of_boxes(const TempFolder& folder, int n) {
  std::ofstream file(folder / "row.wrl");
  file << "#VRML V2.0 utf8\n";
  for (int i = 0; i < n; ++i)
    file << "DEF B" << i << " Transform { translation " << 3 * i << " 0 " << i % 7
         << " children Shape { geometry Cylinder { } } }\n";
  return {folder / "row.wrl", "row.wrl"};
}

/// All files below a folder with what is in them.
std::map<std::string, std::string> files_of(const std::string& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    if (entry.is_regular_file())
      out[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return out;
}

Box at(double x, double y, double z) {
  Box out;
  out.add({x, y, z});
  return out;
}

/// Notes what is said of long work.
class Noted : public Monitor {
 public:
  void begin(std::string what, std::uint64_t total, std::string unit) override {
    said.push_back(what + ": " + std::to_string(total) + ' ' + unit);
    n_done.push_back(0);
  }
  void step(std::uint64_t n) override { n_done.back() += n; }

  std::vector<std::string> said;
  std::vector<std::uint64_t> n_done;
};

}  // namespace

TEST_CASE("tiles: while many files are read their megabytes are counted", "[tiles]") {
  const TempFolder folder;
  std::vector<TilesInput> inputs;
  for (const auto& [name, bytes] : {std::pair{"a.wrl", 1'400'000}, {"b.wrl", 700'000}, {"c.wrl", 2'100'000}}) {
    std::ofstream(folder / name) << std::string(static_cast<std::size_t>(bytes), ' ');
    inputs.push_back({folder / name, name});
  }
  Noted noted;
  Monitor* monitor = &noted;
  {
    tiles::ReadingProgress progress(inputs, monitor);
    CHECK(noted.said == std::vector<std::string>{"reading 3 files: 5 MB"});
    CHECK(monitor == nullptr);  // what a file says of itself would begin another stretch of work
    std::vector<std::uint64_t> done;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      progress.next();
      done.push_back(noted.n_done.back());
    }
    CHECK(done == std::vector<std::uint64_t>{1, 2, 4});
  }
  CHECK(monitor == &noted);
}

TEST_CASE("tiles: every tile is counted, and its error is measured with it", "[tiles]") {
  const TempFolder folder;
  Noted noted;
  const std::vector inputs{row_of_boxes(folder, 60)};
  Document reader({}, {.monitor = &noted});
  TilesOptions options;
  options.triangles = 400;
  const auto made = make_tiles(inputs, folder / "out", options, reader);
  REQUIRE(made);
  const auto of = [&](const std::string& what) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < noted.said.size(); ++i)
      if (noted.said[i].starts_with(what))
        out.push_back(noted.said[i] + ", " + std::to_string(noted.n_done[i]) + " done");
    return out;
  };
  const auto n = std::to_string(made.tiles.size());
  CHECK(of("making tiles") == std::vector<std::string>{"making tiles: " + n + " tiles, " + n + " done"});
  // Errors are measured with the tiles; nothing is left afterwards.
  CHECK(of("measuring tiles").empty());
}

TEST_CASE("tiles: a piece comes back from the disk as it was", "[tiles]") {
  const TempFolder folder;
  std::string why;
  auto store = tiles::PieceStore::open(folder.path().string(), why);
  REQUIRE(store);
  auto first = piece("plant.wrl/Pump", square(5e6, 1, 2)), second = piece("", square(0, 0, 1));
  first.look = 7;
  first.mesh.solid = false;
  first.mesh.crease_angle = 0.5;
  first.mesh.color.width = 4;
  first.mesh.color.values = {0, 0.5, 1, 1};
  first.mesh.color.index = {0, 0, 0, 0, 0, 0};
  tiles::PieceStore::Entry a{}, b{};
  REQUIRE(store->add(first, a));
  REQUIRE(store->add(second, b));
  CHECK(a.n_drawn == 2);
  CHECK(a.box.centre() == Vec3{5e6 + 1, 1, 1});
  const auto back = store->read(a);
  CHECK(back.name == first.name);
  CHECK(back.look == 7);
  CHECK_FALSE(back.mesh.solid);
  CHECK(back.mesh.crease_angle == 0.5);
  CHECK(back.mesh.corners == first.mesh.corners);
  CHECK(std::ranges::equal(back.mesh.positions.span(), first.mesh.positions.span()));
  CHECK(back.mesh.color.values == first.mesh.color.values);
  CHECK(back.mesh.color.width == 4);
  CHECK(store->read(b).mesh.corners.size() == 6);
  CHECK(std::filesystem::is_empty(folder.path()));  // its file has no name
}

TEST_CASE("tiles: cells hold each piece once, within the budget, and are not empty", "[tiles]") {
  std::vector<SpaceItem> pieces;
  for (std::uint32_t i = 0; i < 1000; ++i)
    pieces.push_back({.n_drawn = 1 + i % 7, .box = at(double(i % 40), 0, double(i / 40))});
  const auto cells = cut_into_cells(pieces, {100});
  std::vector<int> times(pieces.size());
  for (const auto& c : cells.cells) {
    REQUIRE(c.begin < c.end);
    std::size_t drawn = 0;
    for (auto i = c.begin; i < c.end; ++i) drawn += pieces[cells.order[i]].n_drawn;
    if (!c.children.empty()) {
      CHECK(drawn > 100);
      CHECK(cells.cells[c.children.front()].begin == c.begin);
      CHECK(cells.cells[c.children.back()].end == c.end);
      continue;
    }
    CHECK(drawn <= 100);
    for (auto i = c.begin; i < c.end; ++i) ++times[cells.order[i]];
  }
  CHECK(std::ranges::all_of(times, [](int n) { return n == 1; }));
}

TEST_CASE("tiles: a piece more or less leaves cells elsewhere as they are", "[tiles]") {
  std::vector<SpaceItem> pieces;
  for (std::uint32_t i = 0; i < 2000; ++i)
    pieces.push_back({.n_drawn = 10, .box = at(0.37 * i, 0, 0.01 * (i % 50)), .look = i});
  const auto leaves = [&] {
    const auto cells = cut_into_cells(pieces, {400});
    std::set<std::set<std::uint32_t>> out;
    for (const auto& c : cells.cells) {
      std::set<std::uint32_t> looks;
      for (auto i = c.begin; i < c.end; ++i) looks.insert(pieces[cells.order[i]].look);
      if (c.children.empty()) out.insert(std::move(looks));
    }
    return out;
  };
  const auto before = leaves();
  pieces.erase(pieces.begin() + 700);
  const auto after = leaves();
  std::vector<std::set<std::uint32_t>> same;
  std::ranges::set_intersection(before, after, std::back_inserter(same));
  CHECK(same.size() + 2 >= before.size());
}

TEST_CASE("tiles: shards make what one run makes, of tiles that are made of tiles, too", "[tiles]") {
  const TempFolder folder;
  const auto input = row_of_boxes(folder, 80);
  TilesOptions options{.triangles = 200, .at_once = 600, .program = "test"};
  Document reader;
  const auto once = make_tiles({&input, 1}, folder / "once", options, reader);
  REQUIRE(once.whole);
  REQUIRE(once.depth >= 2);
  options.shards = 3;
  for (const std::uint32_t shard : {2u, 0u, 1u}) {
    options.shard = shard;
    CHECK(make_tiles({&input, 1}, folder / "shards", options, reader).whole == (shard == 1));
  }
  CHECK(files_of(folder / "once") == files_of(folder / "shards"));
}

TEST_CASE("tiles: a cell that would draw too much is coarser than others of its level", "[tiles]") {
  constexpr std::uint32_t n_full = 12, n_few = 3;
  std::vector<tiles::Piece> pieces;
  for (std::uint32_t i = 0; i < n_full + n_few; ++i) pieces.push_back(piece(std::to_string(i), waves(2 * i, 10)));
  const tiles::CoarseLevel levels[] = {{1500, {{0, n_full}, {n_full, n_full + n_few}}}, {300, {{0, n_full + n_few}}}};
  Diagnostics diag;
  Statistics stats;
  const Task ctx{diag, stats};
  tiles::Looks looks;
  looks.add(Scene(), {}, ctx, nullptr);
  const auto coarse = tiles::coarser(pieces, levels, 700, looks, ctx);
  const auto drawn = [&](std::size_t level, std::uint32_t begin, std::uint32_t end) {
    std::size_t out = 0;
    for (const auto& c : coarse[level])
      if (c.from >= begin && c.from < end) out += c.mesh.n_faces();
    return out;
  };
  CHECK(drawn(0, 0, n_full) <= 700);
  CHECK(drawn(0, 0, n_full) > 500);
  CHECK(drawn(0, n_full, n_full + n_few) > 230);  // a fifth of 1500 is theirs
  CHECK(drawn(1, 0, n_full + n_few) <= 300);
  CHECK(std::ranges::is_sorted(coarse[0], {}, &tiles::Coarse::from));
}

TEST_CASE("tiles: the less memory there is, the less is simplified together", "[tiles]") {
  constexpr std::uint64_t mega = 1 << 20;
  const TilesOptions usual;
  CHECK(triangles_within(4096 * mega) == usual.at_once);
  CHECK(triangles_within(512 * mega) == (512 - 150) * mega / 350);
  CHECK(triangles_within(100 * mega) == 3 * usual.triangles);
}

TEST_CASE("tiles: an update makes nothing again", "[tiles]") {
  const TempFolder folder;
  const auto input = row_of_boxes(folder, 40);
  TilesOptions options{.triangles = 200, .at_once = 600, .program = "test", .update = true};
  Document reader;
  CHECK(make_tiles({&input, 1}, folder / "out", options, reader).n_kept == 0);
  const auto again = make_tiles({&input, 1}, folder / "out", options, reader);
  CHECK(again.n_kept == again.tiles.size());
  options.save.compress = GltfCompression::Method::none;
  CHECK(make_tiles({&input, 1}, folder / "out", options, reader).n_kept == 0);
}

TEST_CASE("tiles: pieces in one place are cut, too", "[tiles]") {
  const std::vector<SpaceItem> pieces(9, {.n_drawn = 50, .box = at(1, 2, 3)});
  for (const auto& c : cut_into_cells(pieces, {60}).cells)
    if (c.children.empty()) CHECK(c.end - c.begin == 1);
}

TEST_CASE("tiles: the error of a coarse surface is that of the farthest point, either way", "[tiles]") {
  const std::vector<tiles::Piece> all{piece("a", square(0, 0, 1)), piece("b", square(3, 0, 1))};
  const auto full = [&](std::size_t i) {
    return tiles::FullTile{box_of_corners(all[i].mesh), [&all, i] { return std::vector{all[i]}; }};
  };
  const std::vector<tiles::FullTile> both{full(0), full(1)};
  SECTION("nothing is missing") { CHECK(tiles::surface_error(all, both) == Approx(0).margin(1e-5)); }
  SECTION("a part has left") { CHECK(tiles::surface_error(std::span(all).first(1), both) == Approx(3).epsilon(0.03)); }
  SECTION("a part is elsewhere") {
    const std::vector<tiles::Piece> moved{all[0], piece("b", square(3, 0.5, 1))};
    CHECK(tiles::surface_error(moved, both) == Approx(0.5).epsilon(0.03));
  }
  SECTION("there is more than there was") {
    const std::vector<tiles::Piece> more{all[0], all[1], piece("c", square(0, 2, 1))};
    CHECK(tiles::surface_error(more, both) == Approx(2).epsilon(0.03));
  }
  SECTION("a large triangle bridges a gap that no point of it is asked in") {
    auto coarse = piece("plate", square(0, 0, 8)), left = coarse, right = coarse;
    const auto clip = [](tiles::Piece& p, double low, double high) {
      auto& points = p.mesh.positions.edit();
      for (std::size_t k = 0; k < points.size(); k += 3) points[k] = std::clamp(points[k], low, high);
    };
    clip(left, 0, 1);
    clip(right, 1.6, 8);
    const std::vector<tiles::FullTile> halves{
        {box_of_corners(left.mesh), [&] { return std::vector{left}; }},
        {box_of_corners(right.mesh), [&] { return std::vector{right}; }},
    };
    CHECK(tiles::surface_error({&coarse, 1}, halves) == Approx(0.3).epsilon(0.06));
  }
  SECTION("large triangles are near to many small ones") {
    const auto plate = piece("plate", square(0, 0, 10));
    const tiles::FullTile whole{box_of_corners(plate.mesh), [&] { return std::vector{plate}; }};
    std::vector<tiles::Piece> small;
    for (int i = 0; i < 100; ++i) {
      auto& points = small.emplace_back(piece("small", square(i % 10, 0.2, 1))).mesh.positions.edit();
      for (std::size_t k = 2; k < points.size(); k += 3) points[k] += i / 10;
    }
    CHECK(tiles::surface_error(small, {&whole, 1}) == Approx(0.2).epsilon(0.03));
  }
}

TEST_CASE("tiles: a coarse surface is as far from the full one as its colours are", "[tiles]") {
  const auto painted = [](std::string name, double x, double size, std::vector<float> color) {
    auto out = piece(std::move(name), square(x, 0, size));
    out.mesh.color.values = std::move(color);
    out.mesh.color.index.assign(6, 0);
    return out;
  };
  const std::vector<float> red{1, 0, 0}, blue{0, 0, 1};
  const std::vector<tiles::Piece> all{painted("a", 0, 1, red), painted("b", 1, 1, blue)};
  const tiles::FullTile full{box_of_corners(all[0].mesh), [&all] { return all; }};
  const auto error = [&](const std::vector<tiles::Piece>& coarse) { return tiles::surface_error(coarse, {&full, 1}); };
  CHECK(error(all) == Approx(0).margin(1e-4));
  CHECK(error({painted("a", 0, 1, blue), painted("b", 1, 1, red)}) == Approx(1).epsilon(0.06));
  CHECK(error({painted("a", 0, 1, red), painted("b", 1, 1, red)}) == Approx(1).epsilon(0.06));
  // One that nothing has there may be anything; so may colours of vertices.
  CHECK(error({all[0], painted("b", 1, 1, {0, 1, 0})}) == Approx(0).margin(1e-4));
  auto blended = all;
  blended[1].mesh.color.values = {1, 0, 0, 0, 0, 1};
  blended[1].mesh.color.index = {0, 0, 0, 0, 0, 1};
  CHECK(error(blended) == Approx(0).margin(1e-4));
}

TEST_CASE("tiles: full triangles that lie across coarse ones are cut along these", "[tiles]") {
  // Both the same two squares in a plane, cut along other diagonals, and a roof of coarse ones above one ridge.
  const auto full = piece("full", square(0, 0, 4));
  auto coarse = full;
  coarse.mesh.corners = {1, 2, 3, 1, 3, 0};
  const auto bound = [&](const tiles::Piece& of, const tiles::Piece& to) {
    const tiles::Soup soup({&to, 1}, {});
    tiles::FarthestPoint farthest(soup, 1e-4);
    farthest.add({&of, 1}, {});
    return farthest.bound();
  };
  CHECK(bound(full, coarse) <= 2e-6);
  auto roof = full;
  roof.mesh.positions.edit() = {0, 0, 0, 0, 0, 4, 2, 1, 0, 2, 1, 4, 4, 0, 0, 4, 0, 4};
  roof.mesh.corners = {0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4};
  auto wrong = full;
  wrong.mesh.positions.edit()[0] = NAN;
  CHECK(bound(wrong, coarse) <= 2e-6);
  // The point below the ridge is 2 / sqrt(5) from either side, and no other is farther.
  CHECK(bound(full, roof) >= 2 / std::sqrt(5.) - 1e-4);
  CHECK(bound(full, roof) <= 1.02 * 2 / std::sqrt(5.) + 1e-4);
}

TEST_CASE("tiles: equal appearances are one look", "[tiles]") {
  Scene a, b;
  const auto red = [](Scene& s, double r) {
    const NodeId appearance = s.add(nodes::Appearance), material = s.add(nodes::Material);
    s.set(material, nodes::material::diffuseColor, Vec3{r, 0, 0});
    s.set(appearance, nodes::appearance::material, material);
    return appearance;
  };
  Diagnostics diag;
  Statistics stats;
  const Task ctx{diag, stats};
  tiles::Looks looks;
  const auto first = looks.add(a, red(a, 0.5), ctx, nullptr);
  CHECK(looks.add(b, red(b, 0.5), ctx, nullptr) == first);
  CHECK(looks.add(b, red(b, 0.6), ctx, nullptr) != first);
  CHECK(looks.add(b, {}, ctx, nullptr) == 2);
  CHECK_FALSE(looks.appearance(2));
  const auto& scene = looks.scene();
  CHECK(scene.get(scene.get(looks.appearance(first), nodes::appearance::material), nodes::material::diffuseColor)[0] ==
        0.5);
}

TEST_CASE("tiles: places on the Earth", "[tiles]") {
  const auto m = earth_matrix({.latitude = 52.0, .longitude = 5.0, .height = 10});
  const Vec3 at{m(0, 3), m(1, 3), m(2, 3)};
  CHECK(m(1, 3) / m(0, 3) == Approx(std::tan(5 * 3.14159265358979 / 180)));
  CHECK(length(at) > 6.36e6);
  CHECK(length(at) < 6.37e6);
  for (int c = 0; c < 3; ++c) CHECK(length(m.column(c)) == Approx(1));
  CHECK(m.determinant() == Approx(1));
  CHECK(dot(m.column(2), unit(at)) > 0.9999);                             // up
  CHECK(earth_matrix({.latitude = 90}).column(3 - 1)[2] == Approx(1));    // at the pole
  CHECK(earth_matrix({.latitude = 90})(2, 3) == Approx(6356752.314245));  // the semi-minor axis
  CHECK(earth_matrix({.heading = 90})(1, 1) == Approx(1));                // -z is east
}

TEST_CASE("tiles: runs that begin and end at the same time leave each other's folders alone", "[tiles]") {
  TempFolder folder;
  const std::string set = folder / "set";
  std::atomic<int> n_failed = 0;
  const auto run = [&] {
    for (int i = 0; i < 200; ++i) {
      Diagnostics diag;
      tiles::Staging staging;
      const bool good = staging.open(set, diag);
      n_failed += !good || !std::filesystem::exists(staging.path());
    }
  };
  {
    std::vector<std::jthread> runs;
    for (int i = 0; i < 4; ++i) runs.emplace_back(run);
  }
  CHECK(n_failed == 0);
}
