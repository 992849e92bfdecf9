#include "geometry/simplify/wedges.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wrlkit::simplify {
namespace {

constexpr int max_compared = 16;  // wedges of one vertex that a corner is compared with

/// Copies `width` floats of each wedge in use, once for each run of equal wedges at a vertex.
void write_stream(Attribute& to, const Wedges& wedges, const Surface& surface, int offset) {
  std::vector<std::uint32_t> id(wedges.count(), none);
  for (std::uint32_t f = 0; f < surface.n_slots(); ++f) {
    if (!surface.alive(f)) continue;
    for (std::uint32_t w : wedges.of_face[f]) {
      if (id[w] == none) {
        id[w] = static_cast<std::uint32_t>(to.count());
        const float* v = wedges.at(w) + offset;
        to.values.insert(to.values.end(), v, v + to.width);
      }
      to.index.push_back(id[w]);
    }
  }
}

}  // namespace

Wedges::Wedges(const Mesh& mesh, const Surface& surface) {
  n_normal_ = mesh.normal.present() ? mesh.normal.width : 0;
  n_color_ = mesh.color.present() ? mesh.color.width : 0;
  n_texcoord_ = mesh.texcoord.present() ? mesh.texcoord.width : 0;
  n_lightcoord_ = mesh.lightcoord.present() ? mesh.lightcoord.width : 0;
  width_ = n_normal_ + n_color_ + n_texcoord_ + n_lightcoord_;
  if (!present()) return;
  of_face.resize(surface.n_slots());
  std::vector<std::uint32_t> last(surface.n_vertices(), none), before;  // chains of the wedges of a vertex
  std::vector<float> v(width_);
  for (std::uint32_t f = 0; f < surface.n_slots(); ++f) {
    if (!surface.alive(f)) continue;
    for (int k = 0; k < 3; ++k) {
      std::size_t corner = std::size_t{3} * f + k;
      float* to = v.data();
      for (const Attribute* a : mesh.attributes())
        if (a->present()) to = std::copy_n(a->at(a->index[corner]), a->width, to);
      std::uint32_t& head = last[surface.face[f].v[k]];
      std::uint32_t w = head;
      for (int i = 0; w != none && std::memcmp(at(w), v.data(), width_ * sizeof(float)) != 0; ++i)
        w = i < max_compared ? before[w] : none;
      if (w == none) {
        w = count();
        before.push_back(head);
        head = w;
        values.insert(values.end(), v.begin(), v.end());
      }
      of_face[f][k] = w;
    }
  }
  values.shrink_to_fit();
}

bool Wedges::differ(std::uint32_t a, std::uint32_t b, double cosine) const {
  if (a == b) return false;
  const float *p = at(a), *q = at(b);
  if (!std::equal(p + n_normal_, p + width_, q + n_normal_)) return true;
  double pq = 0, pp = 0, qq = 0;
  for (int i = 0; i < n_normal_; ++i) {
    pq += p[i] * q[i];
    pp += p[i] * p[i];
    qq += q[i] * q[i];
  }
  return n_normal_ && pq < cosine * std::sqrt(pp * qq);
}

void Wedges::interpolate(std::uint32_t a, std::uint32_t b, double t, float* out) const {
  const float *p = at(a), *q = at(b);
  for (int i = 0; i < width_; ++i)
    out[i] = t <= 0 ? p[i] : t >= 1 ? q[i] : static_cast<float>(p[i] + t * (q[i] - p[i]));
  if (t <= 0 || t >= 1 || !n_normal_) return;
  double length = 0;
  for (int i = 0; i < n_normal_; ++i) length += double{out[i]} * out[i];
  if (length > 0)
    for (int i = 0; i < n_normal_; ++i) out[i] = static_cast<float>(out[i] / std::sqrt(length));
  else
    std::copy_n(p, n_normal_, out);
}

void Wedges::write(Mesh& mesh, const Surface& surface) const {
  mesh.normal = Attribute(3);
  mesh.color = Attribute(n_color_ ? n_color_ : 3);
  mesh.texcoord = Attribute(2);
  mesh.lightcoord = Attribute(2);
  if (n_normal_) write_stream(mesh.normal, *this, surface, 0);
  if (n_color_) write_stream(mesh.color, *this, surface, n_normal_);
  if (n_texcoord_) write_stream(mesh.texcoord, *this, surface, n_normal_ + n_color_);
  if (n_lightcoord_) write_stream(mesh.lightcoord, *this, surface, n_normal_ + n_color_ + n_texcoord_);
}

}  // namespace wrlkit::simplify
