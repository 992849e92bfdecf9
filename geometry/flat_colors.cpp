#include "geometry/flat_colors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace wrlkit {

namespace {

std::uint32_t color_at(const Attribute& a, std::size_t corner) {
  const float* value = a.at(a.index[corner]);
  std::uint32_t out = 0;
  for (int k = 0; k < 4; ++k) {
    const float part = k < a.width ? std::clamp(value[k], 0.f, 1.f) : 1.f;
    out = out << 8 | static_cast<std::uint32_t>(std::round(255 * part));
  }
  return out;
}

/// A colour of a face, and a corner that has it.
struct FaceColor {
  std::uint32_t color;
  std::size_t corner;
};

/// That most corners of a face have.
FaceColor usual_color(const Attribute& a, std::size_t face) {
  const auto first = color_at(a, 3 * face), second = color_at(a, 3 * face + 1), third = color_at(a, 3 * face + 2);
  return second == third && first != second ? FaceColor{second, 3 * face + 1} : FaceColor{first, 3 * face};
}

/// Whether all colours that blend within faces are those of whole faces, and these are most.
bool is_crisp(const Mesh& mesh) {
  std::set<std::uint32_t> whole;
  std::size_t n_whole = 0;
  for (std::size_t f = 0; f < mesh.n_faces() && whole.size() <= FlatColors::most_regions; ++f)
    if (const auto color = flat_color(mesh, f)) {
      whole.insert(*color);
      ++n_whole;
    }
  if (whole.size() > FlatColors::most_regions || 2 * n_whole < mesh.n_faces()) return false;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    if (!whole.contains(color_at(mesh.color, c))) return false;
  return true;
}

}  // namespace

std::optional<std::uint32_t> flat_color(const Mesh& mesh, std::size_t face) {
  const Attribute& a = mesh.color;
  if (!a.present()) return std::nullopt;
  const float* first = a.at(a.index[3 * face]);
  for (std::size_t k = 1; k < 3; ++k)
    if (!std::equal(first, first + a.width, a.at(a.index[3 * face + k]))) return std::nullopt;
  return color_at(a, 3 * face);
}

std::optional<FlatColors> FlatColors::of(const Mesh& mesh) {
  if (!mesh.is_triangles() || !mesh.color.present()) return std::nullopt;
  FlatColors out;
  out.width_ = mesh.color.width;
  std::vector<FaceColor> colors;
  colors.reserve(mesh.n_faces());
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    if (!out.blends_ && !flat_color(mesh, f)) {
      if (!is_crisp(mesh)) return std::nullopt;
      out.blends_ = true;
    }
    colors.push_back(usual_color(mesh.color, f));
  }
  const auto number_all = [&] {
    for (const auto& [color, corner] : colors) {
      const auto [known, is_new] = out.number_.try_emplace(color & out.mask_, out.n_regions());
      if (is_new) {
        Color& value = out.colors_.emplace_back();
        std::copy_n(mesh.color.at(mesh.color.index[corner]), out.width_, value.begin());
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

std::optional<Mesh> with_whole_faces(const Mesh& mesh) {
  const auto colors = FlatColors::of(mesh);
  if (!colors || !colors->blends()) return std::nullopt;
  std::optional<Mesh> out = mesh;
  colors->paint(*out, colors->regions());
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
