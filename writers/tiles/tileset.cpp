#include "writers/tiles/tileset.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text/json.h"

namespace wrlkit {
namespace {

constexpr double noise = 1e-9;  // of angles, and metres on the Earth

/// From y up to z up, as viewers turn the content of a tile.
Vec3 z_up(const Vec3& p) { return {p[0], 0 - p[2], p[1]}; }

/// Tiles that are described in a file of their own. From the leaves up: where there are too many, the largest leave.
std::vector<char> apart(const Tileset& set) {
  const auto n = set.tiles.size();
  std::vector<char> out(n);
  std::vector<std::size_t> described(n, 1);  // in the file that describes the tile
  for (auto i = n; i-- > 0;) {
    const auto& children = set.tiles[i].children;
    for (const auto child : children) described[i] += described[child];
    while (described[i] > set.tiles_in_file) {
      const auto largest = std::ranges::max_element(children, {}, [&](std::size_t c) { return described[c]; });
      if (largest == children.end() || described[*largest] == 1) break;
      out[*largest] = 1;
      described[i] -= described[*largest] - 1;
      described[*largest] = 1;
    }
  }
  return out;
}

/// One file.
class TilesetJson {
 public:
  TilesetJson(const Tileset& set, const std::vector<char>& apart) : set_(set), apart_(apart), json_(out_) {}

  /// `above`: the origin of the tile that refers to this file.
  TilesetFile run(std::size_t root, const Vec3& above) {
    root_ = root;
    json_.object([&] {
      json_.member("asset", json_object("version", "1.1", "generator", "wrlkit"));
      json_.member("geometricError", root == 0 ? set_.error : set_.tiles[root].error);
      json_.key("root");
      tile(root, above);
    });
    return {root == 0 ? "tileset.json" : set_.folder + '/' + set_.tiles[root].name + ".json", out_ + '\n'};
  }

 private:
  /// As deep as the tree of cells, which halves at each step.
  void tile(std::size_t i, const Vec3& origin_above) {
    const auto& t = set_.tiles[i];
    const bool is_elsewhere = apart_[i] && i != root_;  // the file has its transform
    const Vec3 origin = is_elsewhere ? origin_above : t.origin;
    json_.begin_object();
    transform(i == 0, origin - origin_above);
    json_.object("boundingVolume", [&] { box(t, origin); });
    json_.member("geometricError", t.error);
    if (i == root_) json_.member("refine", "REPLACE");
    if (t.has_content || is_elsewhere)
      json_.member("content", json_object("uri", (root_ == 0 ? set_.folder + '/' : "") + t.name +
                                                     (is_elsewhere ? ".json" : ".glb")));
    if (!t.children.empty() && !is_elsewhere) {
      json_.list("children", t.children, [&](const auto child) { tile(child, t.origin); });
    }
    json_.end_object();
  }

  /// In columns.
  void transform(bool is_root, const Vec3& origin) {
    const Vec3 up = z_up(origin);
    Matrix m = translation_matrix(up);
    if (is_root && set_.place) m = earth_matrix(*set_.place) * m;
    if (m == Matrix{}) return;
    std::vector<double> numbers;
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 3; ++r) numbers.push_back(std::abs(m(r, c)) < noise ? 0 : m(r, c));
      numbers.push_back(c == 3 ? 1 : 0);
    }
    json_.member("transform", numbers);
  }

  void box(const TilesetTile& t, const Vec3& origin) {
    const Vec3 middle = z_up(t.box.centre() - origin);
    std::vector<double> numbers(middle.begin(), middle.end());
    const Vec3 half = 0.5 * t.box.size();
    for (const double x : {half[0], 0., 0., 0., half[2], 0., 0., 0., half[1]}) numbers.push_back(x);
    for (double& x : numbers) x += 0.0;
    json_.member("box", numbers);
  }

  const Tileset& set_;
  const std::vector<char>& apart_;
  std::size_t root_ = 0;  // of the file
  std::string out_;
  JsonOut json_;
};

}  // namespace

Matrix earth_matrix(const EarthPlace& place) {
  constexpr double a = 6378137, flattening = 1 / 298.257223563, degree = std::numbers::pi / 180;
  const double e2 = flattening * (2 - flattening);
  const double lat = place.latitude * degree, lon = place.longitude * degree, heading = place.heading * degree;
  const double n = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
  const Vec3 at = {(n + place.height) * std::cos(lat) * std::cos(lon),
                   (n + place.height) * std::cos(lat) * std::sin(lon), (n * (1 - e2) + place.height) * std::sin(lat)};
  const Vec3 east = {-std::sin(lon), std::cos(lon), 0};
  const Vec3 north = {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)};
  const Vec3 up = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  const Vec3 x = std::cos(heading) * east - std::sin(heading) * north;
  const Vec3 y = std::sin(heading) * east + std::cos(heading) * north;
  return matrix_of_columns(x, y, up, at);
}

std::vector<TilesetFile> tileset_files(const Tileset& set) {
  const auto own = apart(set);
  std::vector<Vec3> above(set.tiles.size());  // origins of the tiles that they are in
  for (const auto& t : set.tiles)
    for (const auto child : t.children) above[child] = t.origin;
  std::vector<TilesetFile> out;
  for (std::size_t i = 0; i < set.tiles.size(); ++i)
    if (i == 0 || own[i]) out.push_back(TilesetJson(set, own).run(i, above[i]));
  return out;
}

}  // namespace wrlkit
