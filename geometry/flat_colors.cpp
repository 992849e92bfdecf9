#include "geometry/flat_colors.h"

#include <algorithm>
#include <cmath>

namespace wrlkit {

std::optional<std::uint32_t> flat_color(const Mesh& mesh, std::size_t face) {
  const Attribute& a = mesh.color;
  if (!a.present()) return std::nullopt;
  const float* first = a.at(a.index[3 * face]);
  for (std::size_t k = 1; k < 3; ++k)
    if (!std::equal(first, first + a.width, a.at(a.index[3 * face + k]))) return std::nullopt;
  std::uint32_t out = 0;
  for (int k = 0; k < 4; ++k) {
    const float part = k < a.width ? std::clamp(first[k], 0.f, 1.f) : 1.f;
    out = out << 8 | static_cast<std::uint32_t>(std::round(255 * part));
  }
  return out;
}

std::optional<FlatColors> FlatColors::of(const Mesh& mesh) {
  if (!mesh.is_triangles() || !mesh.color.present()) return std::nullopt;
  std::vector<std::uint32_t> colors;
  colors.reserve(mesh.n_faces());
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    const auto color = flat_color(mesh, f);
    if (!color) return std::nullopt;
    colors.push_back(*color);
  }
  FlatColors out;
  out.width_ = mesh.color.width;
  const auto number_all = [&] {
    for (std::size_t f = 0; f < colors.size(); ++f) {
      const auto [known, is_new] = out.number_.try_emplace(colors[f] & out.mask_, out.n_regions());
      if (is_new) {
        Color& color = out.colors_.emplace_back();
        std::copy_n(mesh.color.at(mesh.color.index[3 * f]), out.width_, color.begin());
      }
      out.regions_.push_back(known->second);
      if (out.n_regions() > most_regions) return false;
    }
    return true;
  };
  while (!number_all()) {
    out.mask_ = coarser(out.mask_);
    out.number_.clear();
    out.colors_.clear();
    out.regions_.clear();
  }
  if (out.n_regions() < 2) return std::nullopt;
  return out;
}

std::vector<std::uint32_t> FlatColors::regions_of(const Mesh& mesh) const {
  std::vector<std::uint32_t> out(mesh.n_faces(), none);
  if (!mesh.color.present() || mesh.color.width != width_) return out;
  for (std::size_t f = 0; f < out.size(); ++f) {
    const auto color = flat_color(mesh, f);
    const auto known = color ? number_.find(*color & mask_) : number_.end();
    if (known != number_.end()) out[f] = known->second;
  }
  return out;
}

void FlatColors::paint(Mesh& mesh, std::span<const std::uint32_t> regions) const {
  mesh.color = Attribute(width_);
  std::vector<std::uint32_t> place(colors_.size(), none);  // among those in use
  for (const auto region : regions) {
    if (place[region] == none) {
      place[region] = static_cast<std::uint32_t>(mesh.color.count());
      const Color& c = colors_[region];
      mesh.color.values.insert(mesh.color.values.end(), c.begin(), c.begin() + width_);
    }
    mesh.color.index.insert(mesh.color.index.end(), 3, place[region]);
  }
}

}  // namespace wrlkit
