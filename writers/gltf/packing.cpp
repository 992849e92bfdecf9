#include "writers/gltf/packing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/stop.h"
#include "writers/gltf/draco.h"
#include "writers/gltf/flat_faces.h"
#include "writers/gltf/tolerance.h"

namespace wrlkit::gltf {
namespace {

constexpr double least_steps =
    16;  // along the longest side of a mesh: what is smaller than the tolerance is still to be seen
constexpr int most_halvings = 4;    // of a step on which faces would vanish
constexpr int more_light_bits = 2;  // a lightmap's texels are small, and those of other charts lie next to them

/// Whether 24 bits with a sign count the steps to all of them; further out floats themselves are finer.
bool fits_grid(std::span<const float> values, double step) {
  constexpr double most = (1 << 23) - 1;
  return std::ranges::all_of(values, [&](float v) { return std::abs(double{v}) <= most * step; });
}

Streams streams_of(const Geometry& g, const MeshRecord& m) {
  return {g.positions, g.normals, g.colors, m.texcoords, m.lightcoords, g.indices, g.features};
}

}  // namespace

Packing::Packing(const GltfCompression& options, const Store& from, const Meshes& meshes, const Document& document)
    : options_(options), from_(from), meshes_(meshes), store_(&from) {
  const auto& records = meshes.meshes();
  for (const MeshRecord& m : records) streams_.push_back(streams_of(meshes.geometries()[m.geometry], m));
  if (options_.method == Method::none) return;
  store_ = &own_;
  summary_.tolerance = tolerance_for(options, diagonal(document.world));
  note_uses(document);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Geometry& g = meshes.geometries()[records[i].geometry];
    const bool still = g.mode == Mode::triangles && g.morph == none;
    streams_[i] = options_.method != Method::draco ? packed(streams_[i])
                  : still                          ? draco(streams_[i])
                                                   : copied(streams_[i]);
  }
  if (options_.method == Method::meshopt && !document.instances.empty() && tolerance_left() > 0)
    summary_.placement = pack_places(document, tolerance_left() / 2);
  pack_others();
}

double Packing::tolerance_left() const {
  if (options_.method == Method::none) return options_.tolerance;
  return summary_.tolerance - summary_.position - summary_.placement;
}

void Packing::note_uses(const Document& document) {
  const std::size_t n = from_.accessors().size();
  to_.assign(n, none);
  scale_.assign(n, 0);
  lines_.assign(n, 0);
  light_.assign(n, 0);
  for (const Geometry& g : meshes_.geometries()) {
    if (g.empty()) continue;
    scale_[g.positions] = std::max(scale_[g.positions], g.scale);
    summary_.rounding = std::max(summary_.rounding, g.rounding * g.scale);
    if (g.morph != none) keep_floats(g);
    if (g.mode == Mode::triangles) faces_[g.positions].push_back(g.indices);
    if (g.indices != none && g.mode != Mode::triangles) lines_[g.indices] = 1;
  }
  for (const MeshRecord& m : meshes_.meshes())
    if (m.lightcoords != none) light_[m.lightcoords] = 1;
  // Metres cannot be made of whole numbers by a node whose places come behind it.
  for (const Node& n : document.nodes) {
    if (n.instances == none || options_.method != Method::quantize) continue;
    const auto positions = meshes_.geometries()[meshes_.meshes()[n.attached].geometry].positions;
    if (to_[positions] == none) {
      ++summary_.kept;
      copied(positions, View::position);
    }
  }
}

/// What morph targets are added to stays as they are.
void Packing::keep_floats(const Geometry& g) {
  copied(g.positions, View::position);
  copied(g.normals, View::normal);
  for (const auto& t : meshes_.morphs()[g.morph].targets) {
    copied(t.positions, View::position);
    copied(t.normals, View::normal);
  }
}

Streams Packing::packed(const Streams& s) {
  check_stop();
  return {positions(s.positions),
          normals(s.normals),
          colors(s.colors),
          texcoords(s.texcoords),
          texcoords(s.lightcoords),
          indices(s.indices),
          s.features == none ? none : copied(s.features, View::feature)};
}

Streams Packing::copied(const Streams& s) {
  auto copy = [&](std::uint32_t a) { return a == none ? none : copied(a, from_.accessors()[a].view); };
  return {copy(s.positions),   copy(s.normals), copy(s.colors),  copy(s.texcoords),
          copy(s.lightcoords), copy(s.indices), copy(s.features)};
}

/// Meshes with the same values are one, whatever their material.
Streams Packing::draco(const Streams& s) {
  constexpr std::size_t json_of_view = 160;  // what a view and the extension take, about
  auto [known, is_new] = by_draco_.try_emplace(s);
  if (!is_new) return known->second;
  check_stop();
  const double grid = step(s.positions), scale = std::max(scale_[s.positions], 0.0);
  if (!fits_grid(floats(s.positions), grid)) {
    ++summary_.kept;
    return known->second = copied(s);
  }
  double error = 0;
  const auto xyz = snapped(floats(s.positions), 3, grid, error);
  std::vector<std::vector<float>> values;
  std::vector<DracoValues> all{{DracoValues::Kind::position, 3, xyz, 0}};
  std::size_t raw = xyz.size() * sizeof(float) + (s.indices == none ? 0 : from_.bytes(s.indices).size());
  values.reserve(5);
  auto add = [&](std::uint32_t a, DracoValues::Kind kind, int bits) {
    if (a == none) return;
    values.push_back(floats(a));
    raw += values.back().size() * sizeof(float);
    all.push_back({kind, info(from_.accessors()[a].view).element / 4u, values.back(), bits});
  };
  add(s.normals, DracoValues::Kind::normal, options_.normal_bits);
  add(s.colors, DracoValues::Kind::color, options_.color_bits);
  const int uv_bits = std::min(options_.texcoord_bits + (s.lightcoords != none ? more_light_bits : 0), 16);
  add(s.texcoords, DracoValues::Kind::texcoord, uv_bits);
  add(s.lightcoords, DracoValues::Kind::texcoord, uv_bits);
  constexpr float most_features = 65535;
  if (s.features != none) {
    add(s.features, DracoValues::Kind::feature, 0);
    if (std::ranges::max(values.back()) > most_features) {
      ++summary_.kept;
      return known->second = copied(s);
    }
  }
  const auto index = corners(s.indices, xyz.size() / 3);
  auto mesh = draco_pack(all, index, grid, options_.level);
  if (!mesh || mesh->n_corners == 0 || mesh->bytes.size() + json_of_view >= raw) {
    ++summary_.kept;
    return known->second = copied(s);
  }
  summary_.position = std::max(summary_.position, error * scale);
  const auto box = box_of<3, float>(xyz);
  auto described = [&](std::uint32_t a) {
    return a == none ? none : own_.described(from_.accessors()[a].view, mesh->n_vertices);
  };
  Streams out{own_.described(View::position, mesh->n_vertices, &box), described(s.normals), described(s.colors),
              described(s.texcoords), described(s.lightcoords)};
  if (s.features != none) out.features = own_.described(View::short_feature, mesh->n_vertices);
  out.indices = own_.described(mesh->n_vertices <= 65535 ? View::index16 : View::index32, mesh->n_corners);
  out.draco = static_cast<std::uint32_t>(blobs_.size());
  blobs_.push_back(std::move(mesh->bytes));
  return known->second = out;
}

/// Half of it for translations, a quarter each for rotations and scales.
double Packing::pack_places(const Document& document, double tolerance) {
  const auto growth = growth_of(document, family_of(document));
  std::map<std::uint32_t, double> steps;  // by accessor
  auto note = [&](std::uint32_t accessor, double step) {
    if (accessor != none) steps[accessor] = std::min(steps.try_emplace(accessor, step).first->second, step);
  };
  for (std::uint32_t id = 0; id < document.nodes.size(); ++id) {
    const Node& n = document.nodes[id];
    if (n.instances == none) continue;
    const Instances& all = document.instances[n.instances];
    double largest = 0;
    for (const Trs& t : all.places) largest = std::max(largest, stretch(t));
    const double reach = std::max(meshes_.reach(n.attached) * growth[id], 1e-9);
    note(all.translations, grid_step(tolerance / 2 / std::max(growth[id], 1e-9)));
    // A turn by four numbers that are each wrong by half a step moves a point by at most two steps of its distance.
    note(all.rotations, grid_step(tolerance / 4 / (reach * std::max(largest, 1e-9)) / 2));
    note(all.scales, grid_step(tolerance / 4 / reach));
  }
  for (const auto& [accessor, step] : steps) {
    const bool turns = from_.accessors()[accessor].view == View::moving4;
    once(accessor, [&, accessor = accessor, step = step, view = turns ? View::place4 : View::place3,
                    width = turns ? 4u : 3u] { return own_.raw(view, on_grid(floats(accessor), width, step).bytes); });
  }
  return tolerance;
}

/// What animations have.
void Packing::pack_others() {
  for (std::uint32_t a = 0; a < to_.size(); ++a) {
    const View v = from_.accessors()[a].view;
    if (!info(v).vertices && !info(v).indices) copied(a, v);
  }
}

std::vector<float> Packing::floats(std::uint32_t accessor) const {
  const std::string bytes = from_.bytes(accessor);
  std::vector<float> out(bytes.size() / sizeof(float));
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

template <class Pack>
std::uint32_t Packing::once(std::uint32_t accessor, Pack pack) {
  if (accessor == none || to_[accessor] != none) return accessor == none ? none : to_[accessor];
  return to_[accessor] = pack();
}

std::uint32_t Packing::copied(std::uint32_t accessor, View view) {
  return once(accessor, [&] {
    const std::uint32_t bounds = from_.accessors()[accessor].bounds;
    return own_.raw(view, from_.bytes(accessor), bounds == none ? nullptr : &from_.bounds()[bounds]);
  });
}

std::vector<std::uint32_t> Packing::corners(std::uint32_t indices, std::size_t n_vertices) const {
  std::vector<std::uint32_t> index(indices == none ? n_vertices : from_.accessors()[indices].count);
  for (std::uint32_t i = 0; i < index.size(); ++i) index[i] = i;
  if (indices == none || index.empty()) return index;
  const std::string bytes = from_.bytes(indices);
  const std::size_t width = bytes.size() / index.size();
  for (std::size_t i = 0; i < index.size(); ++i) {
    index[i] = 0;
    std::memcpy(&index[i], bytes.data() + i * width, width);
  }
  return index;
}

/// The step of the grid of some positions, in their own frame.
double Packing::step(std::uint32_t accessor) const {
  const Bounds& b = from_.bounds_of(accessor);
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, double{b.high[k]} - b.low[k]);
  if (options_.position_bits > 0 && extent > 0)
    return std::exp2(std::ceil(std::log2(extent / ((1 << options_.position_bits) - 1))));
  const double scale = scale_[accessor],
               s = grid_step(summary_.tolerance / (scale > 0 && std::isfinite(scale) ? scale : 1));
  double fine = extent > 0 && s * least_steps > extent ? std::exp2(std::floor(std::log2(extent / least_steps))) : s;
  const auto faces = faces_.find(accessor);
  if (faces == faces_.end()) return fine;
  const auto xyz = floats(accessor);
  for (auto indices : faces->second) {
    const auto index = corners(indices, xyz.size() / 3);
    for (int more = 0;
         more < most_halvings &&
         loses_faces(xyz, index, fine, summary_.tolerance / (scale > 0 && std::isfinite(scale) ? scale : 1));
         ++more)
      fine /= 2;
  }
  return fine;
}

std::uint32_t Packing::positions(std::uint32_t accessor) {
  return once(accessor, [&] {
    const auto xyz = floats(accessor);
    const double s = step(accessor), scale = std::max(scale_[accessor], 0.0);
    auto note = [&](const Quantized& q) { summary_.position = std::max(summary_.position, q.error * scale); };
    if (options_.method == Method::meshopt && !fits_grid(xyz, s)) {
      ++summary_.kept;
      return own_.raw(View::position, from_.bytes(accessor), &from_.bounds_of(accessor));
    }
    if (options_.method == Method::meshopt) {
      const auto q = on_grid(xyz, 3, s);
      note(q);
      return own_.raw(View::grid_position, q.bytes, &q.bounds);
    }
    const Bounds& b = from_.bounds_of(accessor);
    for (std::size_t k = 0; k < 3; ++k)
      if ((double{b.high[k]} - b.low[k]) / s > 65534) {
        ++summary_.kept;
        return own_.raw(View::position, from_.bytes(accessor), &b);
      }
    const auto q = short_positions(xyz, s);
    note(q.values);
    short_.emplace(accessor, Dequantization{q.origin, s});
    return own_.raw(View::short_position, q.values.bytes, &q.values.bounds);
  });
}

std::uint32_t Packing::normals(std::uint32_t accessor) {
  return once(accessor, [&] {
    const bool filtered = options_.method == Method::meshopt;
    const auto q =
        filtered ? octahedral_normals(floats(accessor), options_.normal_bits) : byte_normals(floats(accessor));
    summary_.normal = std::max(summary_.normal, q.error);
    return own_.raw(filtered ? View::oct_normal : View::byte_normal, q.bytes);
  });
}

std::uint32_t Packing::colors(std::uint32_t accessor) {
  return once(accessor, [&] {
    const bool alpha = from_.accessors()[accessor].view == View::rgba;
    const auto q = shorts(floats(accessor), alpha ? 4 : 3, options_.color_bits);
    summary_.color = std::max(summary_.color, q.error);
    return own_.raw(alpha ? View::short_rgba : View::short_rgb, q.bytes);
  });
}

std::uint32_t Packing::texcoords(std::uint32_t accessor) {
  return once(accessor, [&] {
    const auto uv = floats(accessor);
    const int bits = std::min(options_.texcoord_bits + (light_[accessor] ? more_light_bits : 0), 16);
    const bool in_picture = std::ranges::all_of(uv, [](float v) { return v >= 0 && v <= 1; });
    const bool on_a_grid = options_.method == Method::meshopt;
    if (!on_a_grid && !in_picture) {
      ++summary_.kept;
      return own_.raw(View::texcoord, from_.bytes(accessor));
    }
    const auto q = on_a_grid ? on_grid(uv, 2, std::exp2(-bits)) : shorts(uv, 2, bits);
    summary_.texcoord = std::max(summary_.texcoord, q.error);
    return own_.raw(on_a_grid ? View::grid_texcoord : View::short_texcoord, q.bytes);
  });
}

std::uint32_t Packing::indices(std::uint32_t accessor) {
  if (accessor == none) return none;
  const View v = from_.accessors()[accessor].view;
  const bool apart = lines_[accessor] && options_.method == Method::meshopt;
  return copied(accessor, !apart ? v : v == View::index16 ? View::sequence16 : View::sequence32);
}

bool Packing::uses_quantization() const {
  constexpr View kinds[] = {View::short_position, View::byte_normal, View::oct_normal};
  return std::ranges::any_of(kinds, [&](View v) { return store_->view(v).size() > 0; });
}

}  // namespace wrlkit::gltf
