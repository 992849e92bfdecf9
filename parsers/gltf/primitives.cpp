#include "parsers/gltf/primitives.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "parsers/gltf/draco.h"

namespace wrlkit::gltf_reader {
namespace {

enum Mode { points = 0, lines = 1, line_loop = 2, line_strip = 3, triangles = 4, triangle_strip = 5, triangle_fan = 6 };

/// The triangles or segments of a strip, fan or list of n vertices, as places in it.
std::vector<std::uint32_t> list_of(int mode, std::uint32_t n) {
  std::vector<std::uint32_t> out;
  auto add = [&](std::initializer_list<std::uint32_t> v) { out.insert(out.end(), v); };
  switch (mode) {
    case points:
      for (std::uint32_t i = 0; i < n; ++i) out.push_back(i);
      break;
    case lines:
      for (std::uint32_t i = 0; i + 1 < n; i += 2) add({i, i + 1});
      break;
    case line_loop:
    case line_strip:
      for (std::uint32_t i = 0; i + 1 < n; ++i) add({i, i + 1});
      if (mode == line_loop && n > 2) add({n - 1, 0});
      break;
    case triangles:
      for (std::uint32_t i = 0; i + 2 < n; i += 3) add({i, i + 1, i + 2});
      break;
    case triangle_strip:
      for (std::uint32_t i = 0; i + 2 < n; ++i) i % 2 ? add({i, i + 2, i + 1}) : add({i, i + 1, i + 2});
      break;
    default:
      for (std::uint32_t i = 1; i + 1 < n; ++i) add({i, i + 1, 0});
  }
  return out;
}

}  // namespace

bool PrimitiveReader::fill(Stream& s, std::initializer_list<std::size_t> widths) {
  if (s.accessor == none || !s.values.empty()) return true;
  auto read = c_.accessors.numbers(s.accessor, widths);
  if (!read) {
    s.accessor = none;
    return false;
  }
  s.width = read->width;
  s.values = std::move(read->values);
  return true;
}

Stream PrimitiveReader::stream(const Primitive& p, std::string_view name, std::size_t n,
                               std::initializer_list<std::size_t> widths) {
  const Json a = p.json["attributes"][name];
  Stream s{c_.file.index(Table::accessors, a), *widths.begin(), {}};
  if (s.accessor == none) return s;
  if (c_.accessors.count(s.accessor) != n) {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(a), std::string(name) + " with another count than POSITION");
    s.accessor = none;
  } else if (c_.file.is_whole()) {
    fill(s, widths);
  }
  return s;
}

bool PrimitiveReader::load(const Primitive& p, const Pose& how, const Sets& sets, Streams& s) {
  if (p.json["extensions"]["KHR_draco_mesh_compression"]) {
    if (!load_draco(p, sets, s)) return false;
  } else {
    const Json position = p.json["attributes"]["POSITION"];
    auto accessor = c_.file.index(Table::accessors, position);
    if (accessor == none) {
      c_.diag().report(Diag::gltf_bad_value, c_.file.where(p.json), "primitive without POSITION");
      return false;
    }
    s.n = c_.accessors.count(accessor);
    s.position = {accessor, 3, {}};
    s.normal = stream(p, "NORMAL", s.n, three);
    s.color =
        stream(p, p.json["attributes"]["COLOR_0"] || !c_.file.is_whole() ? "COLOR_0" : "_COLOR", s.n, color_widths);
    s.texcoord = stream(p, sets.texcoord, s.n, two);
    if (!sets.light.empty()) s.light = stream(p, sets.light, s.n, two);
    if (p.json["indices"]) {
      s.index_accessor = c_.file.index(Table::accessors, p.json["indices"]);
      s.indexed = true;
      if (s.index_accessor == none) return false;
    }
  }
  const bool moved = !how.joints.empty() || !how.weights.empty() || p.json["targets"] || how.origin != Vec3{0, 0, 0};
  if ((c_.file.is_whole() || moved) && !fill(s.position, three)) return false;
  if (const double step = c_.file.is_whole() ? vrml97(p.mesh)["step"].number(1) : 1; step != 1)
    for (double& v : s.position.values) v = finite_decimal(static_cast<float>(v * step));
  return !moved || pose(p, how, s);
}

bool PrimitiveReader::load_draco(const Primitive& p, const Sets& sets, Streams& s) {
  const Json ext = p.json["extensions"]["KHR_draco_mesh_compression"];
  auto view = c_.file.index(Table::bufferViews, ext["bufferView"]);
  auto bytes = view == none ? std::nullopt : c_.buffers.view(view);
  if (!bytes) return false;
  struct Row {
    const char* name;
    Stream* to;
    std::size_t width;
  };
  const std::string color_type(
      c_.file.at(Table::accessors, p.json["attributes"]["COLOR_0"].whole().value_or(none))["type"].text());
  const Row rows[] = {{"POSITION", &s.position, 3},
                      {"NORMAL", &s.normal, 3},
                      {"COLOR_0", &s.color, color_type == "VEC4" ? 4u : 3u},
                      {sets.texcoord.c_str(), &s.texcoord, 2},
                      {sets.light.c_str(), &s.light, 2},
                      {"_FEATURE_ID_0", &s.feature, 1}};
  std::vector<DracoAttribute> wanted;
  std::vector<const Row*> used;
  for (const Row& r : rows)
    if (auto id = ext["attributes"][r.name].whole(); id && *id < none) {
      wanted.push_back({static_cast<std::uint32_t>(*id), static_cast<std::uint32_t>(r.width), {}});
      used.push_back(&r);
    }
  auto index = draco_unpack(bytes->bytes, wanted);
  if (!index) {
    c_.diag().report(Diag::gltf_packed, c_.file.where(ext), "KHR_draco_mesh_compression");
    return false;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    used[i]->to->width = used[i]->width;
    used[i]->to->values = std::move(wanted[i].values);
    for (double& v : used[i]->to->values) v = finite_decimal(static_cast<float>(v));
  }
  if (s.position.values.empty()) {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(p.json), "primitive without POSITION");
    return false;
  }
  s.n = s.position.values.size() / 3;
  unpacked_ids_ = std::move(s.feature.values);
  s.index = std::move(*index);
  s.indexed = s.loose = true;
  return true;
}

bool PrimitiveReader::pose(const Primitive& p, const Pose& how, Streams& s) {
  n_posed_ += s.n;
  if (n_posed_ > max_posed) {
    c_.diag().report(Diag::expansion_limit, c_.file.where(p.json), max_posed, "vertices of posed meshes");
    return false;
  }
  s.loose = true;
  fill(s.normal, three);
  for (std::size_t i = 0; i < s.position.values.size(); ++i) s.position.values[i] += how.origin[i % 3];
  if (p.json["targets"]) morph(p, how, s);
  return how.joints.empty() || skin(p, how, s);
}

void PrimitiveReader::morph(const Primitive& p, const Pose& how, Streams& s) {
  Morph m;
  m.base = s.position.values;
  m.weights = how.weights.empty() ? p.mesh["weights"].numbers() : how.weights;
  for (Json target : p.json["targets"].elements()) {
    for (Json a : target)
      if (a.key() != "POSITION" && a.key() != "NORMAL")
        c_.lost.add("morph target of " + std::string(a.key()), c_.file.where(a));
    auto moves = c_.accessors.numbers(c_.file.index(Table::accessors, target["POSITION"]), three);
    auto turns = c_.accessors.numbers(c_.file.index(Table::accessors, target["NORMAL"]), three);
    const std::size_t k = m.targets.size();
    const double w = k < m.weights.size() ? m.weights[k] : 0;
    n_posed_ += s.n;
    if (n_posed_ > max_posed)
      return c_.diag().report(Diag::expansion_limit, c_.file.where(p.json), max_posed, "vertices of posed meshes");
    m.targets.push_back(moves && moves->count() == s.n ? std::move(moves->values) : std::vector<double>(s.n * 3, 0.0));
    for (std::size_t i = 0; i < s.n * 3; ++i) s.position.values[i] += w * m.targets.back()[i];
    if (turns && turns->count() == s.n && s.normal.values.size() == s.n * 3)
      for (std::size_t i = 0; i < s.n * 3; ++i) s.normal.values[i] += w * turns->values[i];
  }
  m.weights.resize(m.targets.size(), 0.0);
  morphs_.push_back(std::move(m));
}

/// Each vertex by the mean of its joints' matrices.
bool PrimitiveReader::skin(const Primitive& p, const Pose& how, Streams& s) {
  std::vector<Matrix> sum(s.n, Matrix{{}});
  std::vector<double> weight(s.n, 0.0);
  for (int set = 0;; ++set) {
    const auto suffix = std::to_string(set);
    const Json joints = p.json["attributes"]["JOINTS_" + suffix], weights = p.json["attributes"]["WEIGHTS_" + suffix];
    if (!joints || !weights) break;
    auto j = c_.accessors.whole(c_.file.index(Table::accessors, joints), 4);
    auto w = c_.accessors.numbers(c_.file.index(Table::accessors, weights), {4});
    if (!j || !w || j->size() != s.n * 4 || w->values.size() != s.n * 4) break;
    for (std::size_t i = 0; i < s.n * 4; ++i) {
      const double share = w->values[i];
      if (!(share > 0) || (*j)[i] >= how.joints.size()) continue;
      for (std::size_t k = 0; k < 12; ++k) sum[i / 4].m[k] += share * how.joints[(*j)[i]].m[k];
      weight[i / 4] += share;
    }
  }
  for (std::size_t i = 0; i < s.n; ++i) {
    if (!(weight[i] > 0)) continue;
    Matrix& m = sum[i];
    for (double& v : m.m) v /= weight[i];
    double* q = &s.position.values[i * 3];
    const Vec3 moved = m.point({q[0], q[1], q[2]});
    std::ranges::copy(moved, q);
    if (s.normal.values.size() != s.n * 3) continue;
    double* nv = &s.normal.values[i * 3];
    const Vec3 to = m.point({nv[0], nv[1], nv[2]}), from = m.point({0, 0, 0});
    Vec3 d{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double length = std::hypot(d[0], d[1], d[2]);
    for (std::size_t k = 0; k < 3 && length > 0; ++k) nv[k] = finite_decimal(static_cast<float>(d[k] / length));
  }
  return true;
}

std::vector<std::uint32_t> PrimitiveReader::elements(const Primitive& p, Streams& s) {
  if (s.index_accessor != none)
    if (auto read = c_.accessors.whole(s.index_accessor)) s.index = std::move(*read);
  const std::size_t n = s.indexed ? s.index.size() : s.n;
  auto out = list_of(p.mode, static_cast<std::uint32_t>(std::min<std::size_t>(n, none - 1)));
  if (s.indexed)
    for (auto& v : out) v = s.index[v];
  const std::size_t size = p.faces() ? 3 : p.mode == points_mode ? 1 : 2;
  std::size_t bad = 0, to = 0;
  for (std::size_t i = 0; i + size <= out.size(); i += size) {
    const bool outside =
        std::any_of(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(i + size),
                    [&](auto v) { return v >= s.n; });
    const bool flat = size == 3 && (out[i] == out[i + 1] || out[i + 1] == out[i + 2] ||
                                    out[i] == out[i + 2]);  // strips turn with such
    bad += outside;
    if (outside || flat) continue;
    for (std::size_t k = 0; k < size; ++k) out[to++] = out[i + k];
  }
  out.resize(to);
  if (bad > 0) c_.diag().report(Diag::bad_index, c_.file.where(p.json), "primitive", bad, n / size);
  return out;
}

}  // namespace wrlkit::gltf_reader
