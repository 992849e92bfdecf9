#include "passes/patches/patch_lightmap.h"

#include <algorithm>
#include <numeric>

#include "passes/light/flux.h"
#include "passes/parallel.h"
#include "passes/patches/patch_mesh.h"

namespace wrlkit::light {
namespace {

using Triangle = std::array<V3, 3>;

V3 across(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// For each triangle the polygon it belongs to; returns how many there are.
std::uint32_t find_polygons(const std::vector<Triangle>& triangles, std::vector<std::uint32_t>& polygon_of) {
  constexpr double least_cosine = 1 - 1e-7;
  const PatchMesh mesh(triangles);
  std::vector<V3> normals;
  for (const auto& t : triangles) normals.push_back(unit(across(t)));
  polygon_of.assign(triangles.size(), PatchMesh::none);
  std::uint32_t n = 0;
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (polygon_of[first] != PatchMesh::none) continue;
    polygon_of[first] = n;
    waiting.assign(1, first);
    while (!waiting.empty()) {
      const auto t = waiting.back();
      waiting.pop_back();
      for (auto o : mesh.faces()[t].neighbours)
        if (o != PatchMesh::none && polygon_of[o] == PatchMesh::none && dot(normals[first], normals[o]) > least_cosine) polygon_of[o] = n, waiting.push_back(o);
    }
    ++n;
  }
  return n;
}

/// A polygon on its way to its place in the picture.
struct Polygon {
  PictureFrame frame;
  std::vector<FlatPatch> patches;
  std::array<int, 2> size{};
  int x = 0, y = 0;                  // of its upper left corner in the picture
  Place low{};
};

class ShapeDrawing {
 public:
  ShapeDrawing(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options, std::span<const PlacedPatch> placed)
      : set_(set), world_(world), options_(options), placed_(placed), use_(placed[0].use) {}

  ShapePicture draw() {
    find_triangles();
    place_patches();
    ShapePicture out{.use = use_};
    choose_texel();
    pack(out.picture);
    for (auto& p : polygons_) paint(p, out.picture);
    out.texel = picture_.texel;
    out.n_polygons = static_cast<std::size_t>(std::ranges::count_if(polygons_, [](auto& p) { return !p.patches.empty(); }));
    set_texcoords(out);
    return out;
  }

 private:
  void find_triangles() {
    const auto n = world_.meshes()[world_.mesh_of()[use_]].n_elements;
    for (std::uint32_t e = 0; e < n; ++e) triangles_.push_back(triangle_of(world_, use_, e));
    const bool mirrored = world_.stage().frames[world_.stage().uses[use_].frame].determinant() < 0;
    polygons_.resize(find_polygons(triangles_, polygon_of_));
    std::vector<double> largest(polygons_.size(), -1);
    for (std::uint32_t e = 0; e < n; ++e) {
      const V3 normal = mirrored ? -across(triangles_[e]) : across(triangles_[e]);
      if (!(length(normal) > largest[polygon_of_[e]])) continue;
      largest[polygon_of_[e]] = length(normal);
      polygons_[polygon_of_[e]].frame = PictureFrame::facing(unit(normal), triangles_[e][0]);
    }
  }

  void place_patches() {
    std::vector<char> has_front(polygons_.size());
    for (const auto& p : placed_)
      if (!p.back) has_front[polygon_of_[p.element]] = 1;
    for (const auto& p : placed_) {
      auto& polygon = polygons_[polygon_of_[p.element]];
      if (p.back && has_front[polygon_of_[p.element]]) continue;
      FlatPatch flat{{}, color(p)};
      for (std::size_t i = 0; i < 3; ++i) flat.corners[i] = polygon.frame.place(set_.patches[p.patch].corners[i]);
      polygon.patches.push_back(flat);
    }
  }

  V3 color(const PlacedPatch& p) const {
    const auto& patch = set_.patches[p.patch];
    const V3 rgb(patch.rgb[0], patch.rgb[1], patch.rgb[2]);
    if (!options_.without_color) return rgb;
    const auto own = color_of(world_, p.use, p.element, p.back, {V3(patch.corners[0]), V3(patch.corners[1]), V3(patch.corners[2])});
    return {light_on(rgb.x, own.albedo.x, own.emission.x), light_on(rgb.y, own.albedo.y, own.emission.y), light_on(rgb.z, own.albedo.z, own.emission.z)};
  }

  /// Where nothing can be seen of it, there is none: the digits of what is emitted, or of nothing, would be taken for light.
  static double light_on(double radiance, double albedo, double emission) {
    constexpr double darkest = 0.001, digits = 1e-5;
    const double reflected = radiance - emission;
    return albedo < darkest || reflected < digits * emission ? 0 : reflected / albedo;
  }

  void choose_texel() {
    picture_ = options_.picture;
    if (picture_.texel > 0) return;
    double area = 0, n = 0;
    for (const auto& polygon : polygons_)
      for (const auto& p : polygon.patches) {
        const Place a{p.corners[1][0] - p.corners[0][0], p.corners[1][1] - p.corners[0][1]}, b{p.corners[2][0] - p.corners[0][0], p.corners[2][1] - p.corners[0][1]};
        area += 0.5 * std::fabs(a[0] * b[1] - a[1] * b[0]), ++n;
      }
    picture_.texel = area > 0 ? std::sqrt(area / n) / 4 : 1;
  }

  /// Rows of polygons, the highest first. A Shape that is one polygon gets a picture of just that.
  void pack(FloatPicture& picture) {
    constexpr int attempts = 64;     // borders alone may need more than most_side
    for (int i = 0; !try_to_pack(picture) && i < attempts; ++i) picture_.texel *= 1.25;
    picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  }

  bool try_to_pack(FloatPicture& picture) {
    std::vector<Polygon*> order;
    double area = 0;
    int widest = 1;
    for (auto& p : polygons_) {
      if (p.patches.empty()) continue;
      p.size = picture_size(p.patches, picture_);
      order.push_back(&p);
      area += static_cast<double>(p.size[0]) * p.size[1];
      widest = std::max(widest, p.size[0]);
    }
    std::ranges::stable_sort(order, std::greater{}, [](const Polygon* p) { return p->size[1]; });
    picture.width = order.size() == 1 ? widest : std::max(widest, static_cast<int>(std::sqrt(1.1 * area)));
    int x = 0, y = 0, row = 0;
    for (auto* p : order) {
      if (x + p->size[0] > picture.width) x = 0, y += row, row = 0;
      p->x = x, p->y = y;
      x += p->size[0];
      row = std::max(row, p->size[1]);
    }
    picture.height = y + row;
    return std::max(picture.width, picture.height) <= std::max(options_.most_side, 4 * picture_.border + 4);
  }

  void paint(Polygon& polygon, FloatPicture& to) {
    if (polygon.patches.empty()) return;
    auto picture = light::draw(polygon.patches, picture_);
    polygon.low = picture.low;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) to.at(polygon.x + x, polygon.y + y) = picture.at(x, y);
  }

  void set_texcoords(ShapePicture& out) const {
    out.texcoords.resize(triangles_.size());
    for (std::uint32_t e = 0; e < triangles_.size(); ++e) {
      const auto& polygon = polygons_[polygon_of_[e]];
      if (polygon.patches.empty()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto p = polygon.frame.place(triangles_[e][k]);
        const double x = polygon.x + (p[0] - polygon.low[0]) / picture_.texel, y = polygon.y + polygon.size[1] - (p[1] - polygon.low[1]) / picture_.texel;
        out.texcoords[e][k] = {static_cast<float>(std::clamp(x / out.picture.width, 0.0, 1.0)), static_cast<float>(std::clamp(1 - y / out.picture.height, 0.0, 1.0))};
      }
    }
  }

  const PatchSet& set_;
  const LightWorld& world_;
  const PatchLightmapOptions& options_;
  std::span<const PlacedPatch> placed_;
  std::uint32_t use_;
  PictureOptions picture_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> polygon_of_;
  std::vector<Polygon> polygons_;
};

}  // namespace

PatchLightmap patch_lightmap(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options) {
  const auto match = match_patches(set, world);
  PatchLightmap out{.n_patches = match.placed.size(), .n_orphans = match.n_orphans};
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < match.placed.size(); ++i)
    if (i == 0 || match.placed[i].use != match.placed[i - 1].use) begins.push_back(i);
  out.shapes.resize(begins.size());
  parallel_for(begins.size(), [&](std::size_t i) {
    const auto end = i + 1 < begins.size() ? begins[i + 1] : match.placed.size();
    out.shapes[i] = ShapeDrawing(set, world, options, std::span(match.placed).subspan(begins[i], end - begins[i])).draw();
  });
  return out;
}

}  // namespace wrlkit::light
