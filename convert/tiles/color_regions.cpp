#include "convert/tiles/color_regions.h"

namespace wrlkit::tiles {
namespace {

bool has_flat_colors(const Piece& piece) {
  if (!piece.mesh.is_triangles() || !piece.mesh.color.present()) return false;
  for (std::size_t f = 0; f < piece.mesh.n_faces(); ++f)
    if (!flat_color(piece.mesh, f)) return false;
  return true;
}

}  // namespace

ColorRegions::ColorRegions(std::span<const Piece> coarse, const std::set<std::uint32_t>& full) {
  std::set<std::uint32_t> colors;
  for (const auto& p : coarse) {
    if (!has_flat_colors(p)) continue;
    colored_.insert(&p);
    for (std::size_t f = 0; f < p.mesh.n_faces(); ++f)
      if (const auto color = flat_color(p.mesh, f); full.contains(*color)) colors.insert(*color);
  }
  const auto number_all = [&] {
    number_.clear();
    for (const auto color : colors) number_.try_emplace(color & mask_, number_.size() + 1);
    return number_.size() <= FlatColors::most_regions;
  };
  while (!number_all()) mask_ = wrlkit::coarser(mask_);
}

/// 0: of none of the colours.
std::size_t ColorRegions::of(const Mesh& mesh, std::size_t triangle) const {
  const auto color = flat_color(mesh, triangle);
  const auto known = color ? number_.find(*color & mask_) : number_.end();
  return known == number_.end() ? 0 : known->second;
}

Soup ColorRegions::coarse(std::size_t region, std::span<const Piece> pieces, const Vec3& origin) const {
  if (number_.empty()) return {pieces, origin};
  return {pieces, origin, [&](const Piece& p, std::size_t triangle) {
            return (colored_.contains(&p) ? of(p.mesh, triangle) : 0) == region;
          }};
}

Soup ColorRegions::full(std::size_t region, std::span<const Piece> pieces, const Vec3& origin) const {
  if (region == 0) return {pieces, origin};
  return {pieces, origin, [&](const Piece& p, std::size_t triangle) { return of(p.mesh, triangle) == region; }};
}

void add_flat_colors(std::span<const Piece> pieces, std::set<std::uint32_t>& to) {
  for (const auto& p : pieces) {
    if (!p.mesh.is_triangles() || !p.mesh.color.present()) continue;
    for (std::size_t f = 0; f < p.mesh.n_faces(); ++f)
      if (const auto color = flat_color(p.mesh, f)) to.insert(*color);
  }
}

}  // namespace wrlkit::tiles
