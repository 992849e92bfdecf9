// What lit surfaces show at a place: their own colour times their light.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "light/render/surface.h"
#include "passes/combine_lightmap/page.h"
#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::combine {

class ChartImage;

/// A triangle that is painted, for each PageTriangle.
struct Painted {
  const drawing::Surface* surface;
  const Mesh* mesh;
  std::uint32_t corner;               // the first of three
  double detail;                      // pixels of the texture for each texel
  TexcoordMap at;                     // from texels of the page, y down, to the place in the light, or in `image`
  const ChartImage* image = nullptr;  // what its chart shows, with fewer texels; null: surface and light say it

  /// Without alpha: 255.
  Texel4 color(const std::array<double, 3>& weights, double x, double y, bool alpha) const;
};

/// Of texture coordinates of a triangle after a map: twice the area, without a sign.
double picture_area(const Attribute& a, std::uint32_t corner, const TexcoordMap& map);

/// Pixels of the texture for each texel along a side, of a triangle of that area; 1 without a texture.
double texture_detail(const drawing::Surface& surface, const Mesh& mesh, std::uint32_t corner, double texels);

/// Triangles of a mesh as they lie on a page of that size with the surface's light, in texels. Left out is what has no
/// area there, or is too far away.
void list_triangles(const drawing::Surface& surface, const Mesh& mesh, int width, int height,
                    std::vector<PageTriangle>& triangles, std::vector<Painted>& painted);

/// Its numbers can be reckoned with. What is further away shows nothing of the page.
bool is_near(const PageTriangle& t);

}  // namespace wrlkit::combine
