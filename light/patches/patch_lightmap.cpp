#include "light/patches/patch_lightmap.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "light/flux.h"
#include "light/patches/patch_mesh.h"
#include "light/patches/smooth_patches.h"

namespace wrlkit::light {
namespace {

using Triangle = std::array<V3, 3>;

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
        if (o != PatchMesh::none && polygon_of[o] == PatchMesh::none &&
            dot(normals[first], normals[o]) > least_cosine) {
          polygon_of[o] = n;
          waiting.push_back(o);
        }
    }
    ++n;
  }
  return n;
}

/// A side of a polygon on its way to its place in the picture.
struct Polygon {
  PictureFrame frame;
  Box2 box;
  std::vector<FlatPatch> patches;
  std::array<int, 2> size{};
  int x = 0, y = 0;  // of its upper left corner in the picture
};

class ShapeDrawing {
 public:
  ShapeDrawing(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options,
               std::span<const PlacedPatch> placed)
      : set_(set), world_(world), options_(options), placed_(placed), use_(placed[0].use) {}

  ShapePicture draw() {
    find_triangles();
    place_patches();
    ShapePicture out{.use = use_};
    out.n_polygons =
        static_cast<std::size_t>(std::ranges::count_if(polygons_, [](auto& p) { return !p.patches.empty(); }));
    choose_texel();
    if (n_bare()) add_rest();
    pack(out.picture);
    for (auto& p : polygons_) paint(p, out.picture);
    out.texel = picture_.texel;
    out.front = places(out.picture, false);
    out.back = places(out.picture, true);
    return out;
  }

  /// Triangles with an area that have no patch on either side.
  std::size_t n_bare() const {
    std::size_t n = 0;
    for (std::uint32_t e = 0; e < triangles_.size(); ++e) n += !shown(e, false) && length(across(triangles_[e])) > 0;
    return n;
  }

 private:
  /// Fronts of polygons come first, then their backs.
  void find_triangles() {
    const auto n = world_.meshes()[world_.mesh_of()[use_]].n_elements;
    for (std::uint32_t e = 0; e < n; ++e) triangles_.push_back(triangle_of(world_, use_, e));
    const bool mirrored = world_.stage().frames[world_.stage().uses[use_].frame].determinant() < 0;
    n_flat_ = find_polygons(triangles_, polygon_of_);
    polygons_.resize(2 * std::size_t{n_flat_});
    std::vector<double> largest(n_flat_, -1);
    for (std::uint32_t e = 0; e < n; ++e) {
      const V3 normal = mirrored ? -across(triangles_[e]) : across(triangles_[e]);
      if (!(length(normal) > largest[polygon_of_[e]])) continue;
      largest[polygon_of_[e]] = length(normal);
      polygon(e, false).frame = PictureFrame::facing(unit(normal), triangles_[e][0]);
      polygon(e, true).frame = PictureFrame::facing(-unit(normal), triangles_[e][0]);
    }
    for (std::uint32_t e = 0; e < n; ++e)
      for (bool back : {false, true})
        for (const V3& corner : triangles_[e]) polygon(e, back).box.add(polygon(e, back).frame.place(corner));
  }

  Polygon& polygon(std::uint32_t e, bool back) { return polygons_[polygon_of_[e] + (back ? n_flat_ : 0)]; }

  /// What that side of a triangle shows; null: nothing.
  const Polygon* shown(std::uint32_t e, bool back) const {
    for (bool side : {back, !back})
      if (const auto& p = polygons_[polygon_of_[e] + (side ? n_flat_ : 0)]; !p.patches.empty()) return &p;
    return nullptr;
  }

  void place_patches() {
    std::vector<std::array<V3, 3>> colors;
    for (const auto& p : placed_) colors.push_back({color(p), {}, {}});
    if (options_.smooth)
      colors = smooth_colors(meeting(colors));
    else
      for (auto& c : colors) c[1] = c[2] = c[0];
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      auto& to = polygon(placed_[i].element, placed_[i].back);
      FlatPatch flat{{}, colors[i]};
      for (std::size_t k = 0; k < 3; ++k) flat.corners[k] = to.frame.place(corners_of(placed_[i])[k]);
      to.patches.push_back(flat);
    }
  }

  std::vector<MeetingPatch> meeting(const std::vector<std::array<V3, 3>>& colors) const {
    std::vector<MeetingPatch> out;
    out.reserve(placed_.size());
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const auto& p = placed_[i];
      MeetingPatch m{corners_of(p), {}, colors[i][0]};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto w = weights_in(triangles_[p.element], m.corners[k]);
        const Hit hit{.use = use_, .element = p.element, .back = p.back, .weights = {w[0], w[1], w[2]}};
        m.normals[k] = world_.normal(hit, face_of(p));
      }
      out.push_back(m);
    }
    return out;
  }

  /// The normal of the side that a patch is on.
  V3 face_of(const PlacedPatch& p) const {
    const bool mirrored = world_.stage().frames[world_.stage().uses[use_].frame].determinant() < 0;
    const V3 n = unit(across(triangles_[p.element]));
    return mirrored != p.back ? -n : n;
  }

  std::array<V3, 3> corners_of(const PlacedPatch& p) const {
    const auto& c = set_.patches[p.patch].corners;
    return {V3(c[0]), V3(c[1]), V3(c[2])};
  }

  V3 color(const PlacedPatch& p) const {
    const auto& patch = set_.patches[p.patch];
    const V3 rgb(patch.rgb[0], patch.rgb[1], patch.rgb[2]);
    if (!options_.without_color) return rgb;
    const auto own = color_of(world_, p.use, p.element, p.back, corners_of(p));
    return {light_on(rgb.x, own.albedo.x, own.emission.x), light_on(rgb.y, own.albedo.y, own.emission.y),
            light_on(rgb.z, own.albedo.z, own.emission.z)};
  }

  /// Where nothing can be seen of it, there is none: the digits of what is emitted, or of nothing, would be taken for
  /// light.
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
        const Vec2 a{p.corners[1][0] - p.corners[0][0], p.corners[1][1] - p.corners[0][1]},
            b{p.corners[2][0] - p.corners[0][0], p.corners[2][1] - p.corners[0][1]};
        area += 0.5 * std::fabs(a[0] * b[1] - a[1] * b[0]);
        ++n;
      }
    picture_.texel = area > 0 ? std::sqrt(area / n) / 4 : 1;
  }

  /// A texel for triangles without patches, of the mean colour of the others.
  void add_rest() {
    V3 sum;
    double n = 0;
    for (const auto& polygon : polygons_)
      for (const auto& p : polygon.patches) {
        sum += p.colors[0] + p.colors[1] + p.colors[2];
        n += 3;
      }
    const V3 mean = (1 / n) * sum;
    const double t = picture_.texel;
    Polygon rest;
    rest.patches.push_back({{Vec2{0, 0}, Vec2{2 * t, 0}, Vec2{0, 2 * t}}, {mean, mean, mean}});
    rest.box.add({0, 0});
    rest.box.add({t, t});
    polygons_.push_back(std::move(rest));
    has_rest_ = true;
  }

  /// Rows of polygons, the highest first. A Shape that is one polygon gets a picture of just that. Where there are so
  /// many polygons that their borders alone take too much, these go.
  void pack(FloatPicture& picture) {
    constexpr int attempts = 64;
    for (double i = 0, before = HUGE_VAL; !try_to_pack(picture) && i < attempts; ++i) {
      const double area = static_cast<double>(picture.width) * picture.height;
      if (area > 0.9 * before && picture_.border > 0) --picture_.border;
      before = area;
      picture_.texel *= 1.25;
    }
    picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  }

  bool try_to_pack(FloatPicture& picture) {
    std::vector<Polygon*> order;
    double area = 0;
    int widest = 1;
    for (auto& p : polygons_) {
      if (p.patches.empty()) continue;
      p.size = picture_size(p.box, picture_);
      order.push_back(&p);
      area += static_cast<double>(p.size[0]) * p.size[1];
      widest = std::max(widest, p.size[0]);
    }
    std::ranges::stable_sort(order, std::greater{}, [](const Polygon* p) { return p->size[1]; });
    picture.width =
        order.size() == 1 ? widest : std::max(widest, static_cast<int>(std::min(std::sqrt(1.1 * area), 0x1p30)));
    int x = 0, row = 0;
    double y = 0;
    for (auto* p : order) {
      if (x + p->size[0] > picture.width) {
        x = 0;
        y += row;
        row = 0;
      }
      p->x = x;
      p->y = static_cast<int>(std::min(y, 0x1p30));
      x += p->size[0];
      row = std::max(row, p->size[1]);
    }
    picture.height = static_cast<int>(std::min(y + row, 0x1p30));
    return std::max(picture.width, picture.height) <= std::max(options_.most_side, 4 * picture_.border + 4);
  }

  void paint(const Polygon& polygon, FloatPicture& to) const {
    if (polygon.patches.empty()) return;
    auto picture = light::draw(polygon.patches, polygon.box, picture_);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) to.at(polygon.x + x, polygon.y + y) = picture.at(x, y);
  }

  std::vector<TrianglePlaces> places(const FloatPicture& picture, bool back) const {
    std::vector<TrianglePlaces> out(triangles_.size());
    for (std::uint32_t e = 0; e < triangles_.size(); ++e) {
      const Polygon* p = shown(e, back);
      if (!p && !has_rest_) continue;  // no area
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 at = p ? p->frame.place(triangles_[e][k]) : Vec2{0.5 * picture_.texel, 0.5 * picture_.texel};
        const Polygon& in = p ? *p : polygons_.back();
        const double x = in.x + picture_.border + (at[0] - in.box.low[0]) / picture_.texel;
        const double y = in.y + in.size[1] - picture_.border - (at[1] - in.box.low[1]) / picture_.texel;
        out[e][k] = {static_cast<float>(x / picture.width), static_cast<float>(1 - y / picture.height)};
      }
    }
    return out;
  }

  const PatchSet& set_;
  const LightWorld& world_;
  const PatchLightmapOptions& options_;
  std::span<const PlacedPatch> placed_;
  std::uint32_t use_, n_flat_ = 0;
  PictureOptions picture_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> polygon_of_;
  std::vector<Polygon> polygons_;  // fronts, backs, and `rest`
  bool has_rest_ = false;
};

}  // namespace

PatchLightmap patch_lightmap(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options) {
  const auto match = match_patches(set, world);
  PatchLightmap out{.n_patches = match.placed.size(), .n_orphans = match.n_orphans};
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < match.placed.size(); ++i)
    if (i == 0 || match.placed[i].use != match.placed[i - 1].use) begins.push_back(i);
  out.shapes.resize(begins.size());
  std::vector<std::size_t> n_bare(begins.size());
  parallel_for(begins.size(), [&](std::size_t i) {
    const auto end = i + 1 < begins.size() ? begins[i + 1] : match.placed.size();
    ShapeDrawing drawing(set, world, options, std::span(match.placed).subspan(begins[i], end - begins[i]));
    out.shapes[i] = drawing.draw();
    n_bare[i] = drawing.n_bare();
  });
  out.n_bare = std::accumulate(n_bare.begin(), n_bare.end(), std::size_t{0});
  return out;
}

}  // namespace wrlkit::light
