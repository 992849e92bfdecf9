#include "light/render/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <unordered_set>

#include "base/lazy_library.h"
#include "base/parallel.h"
#include "light/render/placement.h"

namespace wrlkit::drawing {
namespace {

constexpr std::uint32_t small_mesh = 16;                            // elements; an instance costs more than those
constexpr std::size_t fast_build = 2'000'000;                       // above, the build counts for more than the rays
constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();  // Embree leaves such elements out
constexpr float infinity = std::numeric_limits<float>::infinity();
enum Mask : unsigned { opaque = 1, clear = 2 };

/// Embree, which is opened for the first scene.
struct Embree {
#define EMBREE(function) decltype(&::function) function = nullptr;
#include "light/render/embree_functions.def"
#undef EMBREE
};

Embree open_embree() {
  Embree out;
  LazyLibrary library("libembree3.so.3");
#define EMBREE(function) library.find(out.function, #function);
#include "light/render/embree_functions.def"
#undef EMBREE
  if (!library.fault().empty())
    throw std::runtime_error("Embree, which traces rays, cannot be used: " + library.fault());
  return out;
}

const Embree& opened_embree() {
  static const Embree embree = open_embree();
  return embree;
}

/// What Embree takes as a ray; others may end the program.
bool acceptable(const RTCRay& r) {
  constexpr float largest = 1e18f;
  auto small = [](float v) { return std::fabs(v) < largest; };
  return small(r.org_x) && small(r.org_y) && small(r.org_z) && small(r.dir_x) && small(r.dir_y) && small(r.dir_z) &&
         r.tnear < r.tfar;
}

/// The elements of one use, within a batch.
struct Part {
  std::uint32_t first_element, use;
  bool flipped;  // mirrored: corners 1 and 2 are exchanged, so that the front stays counter-clockwise
};

/// Elements in world coordinates that one Embree geometry holds.
struct Batch {
  RTCGeometryType type;
  int width;  // floats of a vertex
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
  std::uint32_t n_elements = 0;
  std::vector<std::uint32_t> part_number;  // by element

  const Part& part_of(std::uint32_t element) const { return parts[part_number[element]]; }
};

struct Found {
  std::uint32_t geometry, element, instance;
  bool back;
};

}  // namespace

struct RayScene::State {
  enum BatchKind { solid, two_sided, lines, points, clear_solid, clear_two_sided };

  const Stage& stage;
  const MeshPool& meshes;
  std::span<const std::uint32_t> mesh_of;
  RayOptions options;
  V3 centre{};  // world; all single-precision coordinates are relative to it
  double radius = 0;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  Batch batches[6] = {
      {RTC_GEOMETRY_TYPE_TRIANGLE, 3, {}, {}, {}},          {RTC_GEOMETRY_TYPE_TRIANGLE, 3, {}, {}, {}},
      {RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE, 4, {}, {}, {}}, {RTC_GEOMETRY_TYPE_DISC_POINT, 4, {}, {}, {}},
      {RTC_GEOMETRY_TYPE_TRIANGLE, 3, {}, {}, {}},          {RTC_GEOMETRY_TYPE_TRIANGLE, 3, {}, {}, {}}};
  std::vector<const Batch*> batch_of{};  // by Embree's geometry number; null: an instance
  std::vector<std::uint32_t> use_of{};   // the same, of instances
  std::vector<RTCScene> instanced{};     // by mesh
  std::vector<char> held{};              // by use
  const Embree& embree = opened_embree();

  ~State();
  double width_of(std::uint32_t use) const { return use < options.widths.size() ? options.widths[use] : 1; }
  bool is_clear(std::uint32_t use) const { return use < options.clear.size() && options.clear[use]; }
  BatchKind kind_of(std::uint32_t use) const;
  bool is_instanced(std::uint32_t use, std::span<const std::uint32_t> n_uses) const;
  void place_centre();
  void measure();
  RTCRay embree_ray(const Ray& ray, double after, float before) const;
  void place_uses(Diagnostics& diag);
  void flatten(std::uint32_t use);
  void add_vertices(Batch& to, const Affine& frame, const PooledMesh& mesh);
  void add_ribbons(Batch& to, const Affine& frame, const PooledMesh& mesh, double by);
  void add_discs(Batch& to, const Affine& frame, const PooledMesh& mesh, double by);
  void add_dot(Batch& to, const Pen::Dot& dot) const;
  void instance(std::uint32_t use);
  RTCScene scene_of(std::uint32_t mesh);
  void attach(Batch& batch, bool culled, Mask mask);
  unsigned attach_to_top(RTCGeometry g);
  RTCScene new_scene(std::size_t elements) const;
  RTCFilterFunctionN filter(bool culled) const;
  std::pair<std::uint32_t, std::uint32_t> resolve(const Found& f) const;
  /// Which of two things at one distance counts as nearer.
  bool before(const Found& a, const Found& b) const {
    if (options.fronts_first && a.back != b.back) return b.back;
    return resolve(a) < resolve(b);
  }
};

namespace {

/// What the filter remembers of the nearest thing so far.
struct Context {
  RTCIntersectContext base;
  const void* state;
  float distance;
  Found found;
  Found left;  // a back at the same distance as a front
  bool leaves;
};

bool is_back(const RTCFilterFunctionNArguments* a) {
  double across = double{RTCHitN_Ng_x(a->hit, a->N, 0)} * RTCRayN_dir_x(a->ray, a->N, 0) +
                  double{RTCHitN_Ng_y(a->hit, a->N, 0)} * RTCRayN_dir_y(a->ray, a->N, 0) +
                  double{RTCHitN_Ng_z(a->hit, a->N, 0)} * RTCRayN_dir_z(a->ray, a->N, 0);
  return across > 0;
}

/// Of things at the same distance one stays whatever order Embree meets them in: that order depends on the number of
/// threads that built its tree. Solid surfaces that are culled cannot be seen from behind.
template <class State, bool culled>
void keep(const RTCFilterFunctionNArguments* a) {
  auto& context = *reinterpret_cast<Context*>(a->context);
  float distance = RTCRayN_tfar(a->ray, a->N, 0);
  Found f{RTCHitN_geomID(a->hit, a->N, 0), RTCHitN_primID(a->hit, a->N, 0), RTCHitN_instID(a->hit, a->N, 0, 0),
          is_back(a)};
  if (culled && f.back) {
    a->valid[0] = 0;
    return;
  }
  if (distance == context.distance) {
    if (context.found.back != f.back) {
      context.leaves = true;
      context.left = f.back ? f : context.found;
    }
    if (static_cast<const State*>(context.state)->before(context.found, f)) {
      a->valid[0] = 0;
      return;
    }
  } else {
    context.leaves = false;
  }
  context.distance = distance;
  context.found = f;
}

}  // namespace

RayScene::State::~State() {
  for (auto s : instanced)
    if (s) embree.rtcReleaseScene(s);
  if (top) embree.rtcReleaseScene(top);
  if (device) embree.rtcReleaseDevice(device);
}

std::pair<std::uint32_t, std::uint32_t> RayScene::State::resolve(const Found& f) const {
  if (f.instance != RTC_INVALID_GEOMETRY_ID) return {use_of[f.instance], f.element};
  const Part& p = batch_of[f.geometry]->part_of(f.element);
  return {p.use, f.element - p.first_element};
}

RTCFilterFunctionN RayScene::State::filter(bool culled) const {
  return culled ? keep<State, true> : keep<State, false>;
}

/// The middle of all boxes, so that single precision is spent on the world and not on its distance from the origin.
void RayScene::State::place_centre() {
  Box all;
  for (std::size_t u = 0; u < mesh_of.size(); ++u) {
    const PooledMesh& m = meshes[mesh_of[u]];
    V3 p = stage.frames[stage.uses[u].frame].point(m.origin);
    if (m.n_elements && finite(p)) all.add(p);
  }
  if (all.empty() || !finite(all.centre())) return;
  centre = all.centre();
}

RTCRay RayScene::State::embree_ray(const Ray& ray, double after, float before) const {
  V3 origin = ray.origin - centre;
  RTCRay r{};
  r.org_x = static_cast<float>(origin.x);
  r.org_y = static_cast<float>(origin.y);
  r.org_z = static_cast<float>(origin.z);
  r.dir_x = static_cast<float>(ray.direction.x);
  r.dir_y = static_cast<float>(ray.direction.y);
  r.dir_z = static_cast<float>(ray.direction.z);
  r.tnear = after > 0 ? std::nextafter(static_cast<float>(after), infinity) : 0;
  r.tfar = before;
  return r;
}

/// How far the world goes from its centre, by what Embree made of it.
void RayScene::State::measure() {
  RTCBounds b;
  embree.rtcGetSceneBounds(top, &b);
  for (float v : {b.lower_x, b.lower_y, b.lower_z, b.upper_x, b.upper_y, b.upper_z})
    if (std::isfinite(v)) radius = std::max(radius, double{std::fabs(v)});
}

bool RayScene::State::is_instanced(std::uint32_t use, std::span<const std::uint32_t> n_uses) const {
  const PooledMesh& m = meshes[mesh_of[use]];
  if (m.kind != Mesh::Kind::faces || m.n_elements <= small_mesh || n_uses[mesh_of[use]] < 2) return false;
  return finite(stage.frames[stage.uses[use].frame].inverse());
}

void RayScene::State::place_uses(Diagnostics& diag) {
  std::vector<std::uint32_t> n_uses(meshes.size());
  std::size_t all = 0, flat = 0;
  for (auto m : mesh_of) {
    ++n_uses[m];
    all += meshes[m].n_elements;
  }
  std::unordered_set<Placement, PlacementHash> placed;
  held.resize(mesh_of.size());
  for (std::uint32_t u = 0; u < mesh_of.size(); ++u) {
    const PooledMesh& m = meshes[mesh_of[u]];
    const Affine& frame = stage.frames[stage.uses[u].frame];
    if (!m.n_elements || !finite(frame) || (m.kind != Mesh::Kind::faces && !options.pen)) continue;
    if (n_uses[mesh_of[u]] > 1 && !placed.insert({mesh_of[u], frame}).second) continue;
    bool instanced = all > options.all_flat && is_instanced(u, n_uses);
    flat += instanced ? 0 : m.n_elements;
    if (flat > MeshPool::most_elements)
      return diag.report(Diag::expansion_limit, {}, MeshPool::most_elements, "triangles");
    held[u] = true;
    instanced ? instance(u) : flatten(u);
  }
}

RayScene::State::BatchKind RayScene::State::kind_of(std::uint32_t use) const {
  const PooledMesh& m = meshes[mesh_of[use]];
  if (m.kind == Mesh::Kind::lines) return lines;
  if (m.kind == Mesh::Kind::points) return points;
  if (is_clear(use)) return m.solid ? clear_solid : clear_two_sided;
  return m.solid ? solid : two_sided;
}

void RayScene::State::flatten(std::uint32_t use) {
  const PooledMesh& m = meshes[mesh_of[use]];
  const Affine& frame = stage.frames[stage.uses[use].frame];
  bool lines_or_points = m.kind != Mesh::Kind::faces;
  Batch& to = batches[kind_of(use)];
  bool flipped = !lines_or_points && frame.determinant() < 0;
  to.part_number.resize(to.part_number.size() + m.n_elements, static_cast<std::uint32_t>(to.parts.size()));
  to.parts.push_back({to.n_elements, use, flipped});
  to.n_elements += m.n_elements;
  if (m.kind == Mesh::Kind::lines) return add_ribbons(to, frame, m, width_of(use));
  if (m.kind == Mesh::Kind::points) return add_discs(to, frame, m, width_of(use));
  auto base = static_cast<std::uint32_t>(to.vertices.size() / 3);
  add_vertices(to, frame, m);
  const std::uint32_t* c = meshes.corners.data() + m.first_corner;
  for (std::size_t e = 0; e < m.n_elements; ++e, c += 3)
    to.indices.insert(to.indices.end(), {base + c[0], base + c[flipped ? 2 : 1], base + c[flipped ? 1 : 2]});
}

void RayScene::State::add_vertices(Batch& to, const Affine& frame, const PooledMesh& mesh) {
  V3 origin = frame.point(mesh.origin) - centre;
  for (std::uint32_t i = 0; i < mesh.n_points; ++i) {
    const float* p = meshes.point(mesh, i);
    V3 v = frame.vector({p[0], p[1], p[2]}) + origin;
    to.vertices.insert(to.vertices.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  }
}

void RayScene::State::add_dot(Batch& to, const Pen::Dot& dot) const {
  V3 p = dot.at - centre;
  bool visible = dot.radius > 0 && finite(p);
  to.vertices.insert(to.vertices.end(), {visible ? static_cast<float>(p.x) : nowhere, static_cast<float>(p.y),
                                         static_cast<float>(p.z), static_cast<float>(dot.radius)});
}

void RayScene::State::add_ribbons(Batch& to, const Affine& frame, const PooledMesh& mesh, double by) {
  for (std::size_t e = 0; e < mesh.n_elements; ++e) {
    to.indices.push_back(static_cast<std::uint32_t>(to.vertices.size() / 4));
    V3 a = frame.point(meshes.position(mesh, e, 0) + mesh.origin),
       b = frame.point(meshes.position(mesh, e, 1) + mesh.origin);
    for (const Pen::Dot& d : options.pen->line(a, b, by)) add_dot(to, d);
  }
}

void RayScene::State::add_discs(Batch& to, const Affine& frame, const PooledMesh& mesh, double by) {
  for (std::size_t e = 0; e < mesh.n_elements; ++e)
    add_dot(to, options.pen->point(frame.point(meshes.position(mesh, e, 0) + mesh.origin), by));
}

RTCScene RayScene::State::new_scene(std::size_t elements) const {
  RTCScene s = embree.rtcNewScene(device);
  embree.rtcSetSceneFlags(
      s, RTC_SCENE_FLAG_ROBUST);  // no cracks between triangles, and things at one distance are all met
  embree.rtcSetSceneBuildQuality(s, elements > fast_build ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
  return s;
}

RTCScene RayScene::State::scene_of(std::uint32_t mesh) {
  if (instanced.empty()) instanced.resize(meshes.size());
  if (instanced[mesh]) return instanced[mesh];
  const PooledMesh& m = meshes[mesh];
  RTCGeometry g = embree.rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* v = embree.rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, m.n_points);
  void* i = embree.rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, m.n_elements);
  if (v && i) {
    std::copy_n(meshes.point(m, 0), m.n_points * 3, static_cast<float*>(v));
    std::copy_n(meshes.corners.data() + m.first_corner, std::size_t{m.n_elements} * 3, static_cast<std::uint32_t*>(i));
  }
  embree.rtcSetGeometryIntersectFilterFunction(g, filter(m.solid && options.cull));
  embree.rtcSetGeometryMask(g, opaque | clear);
  embree.rtcCommitGeometry(g);
  RTCScene s = instanced[mesh] = new_scene(m.n_elements);
  embree.rtcAttachGeometry(s, g);
  embree.rtcReleaseGeometry(g);
  embree.rtcCommitScene(s);
  return s;
}

/// Embree says by the number that it had no memory.
unsigned RayScene::State::attach_to_top(RTCGeometry g) {
  unsigned id = embree.rtcAttachGeometry(top, g);
  embree.rtcReleaseGeometry(g);
  if (id == RTC_INVALID_GEOMETRY_ID) throw std::bad_alloc();
  return id;
}

void RayScene::State::instance(std::uint32_t use) {
  const PooledMesh& m = meshes[mesh_of[use]];
  const Affine& f = stage.frames[stage.uses[use].frame];
  V3 t = f.point(m.origin) - centre;
  auto n = [](double v) { return static_cast<float>(v); };
  float columns[12] = {n(f.x.x), n(f.x.y), n(f.x.z), n(f.y.x), n(f.y.y), n(f.y.z),
                       n(f.z.x), n(f.z.y), n(f.z.z), n(t.x),   n(t.y),   n(t.z)};
  RTCGeometry g = embree.rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  embree.rtcSetGeometryInstancedScene(g, scene_of(mesh_of[use]));
  embree.rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  embree.rtcSetGeometryMask(g, is_clear(use) ? clear : opaque);
  embree.rtcCommitGeometry(g);
  unsigned id = attach_to_top(g);
  use_of.resize(std::max<std::size_t>(use_of.size(), id + 1));
  use_of[id] = use;
}

void RayScene::State::attach(Batch& b, bool culled, Mask mask) {
  if (!b.n_elements) return;
  b.vertices.resize(b.vertices.size() + 4);  // Embree reads 16 bytes a vertex, beyond the last one too
  RTCGeometry g = embree.rtcNewGeometry(device, b.type);
  std::size_t stride = sizeof(float) * b.width;
  embree.rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, b.width == 3 ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_FLOAT4,
                                    b.vertices.data(), 0, stride, (b.vertices.size() - 4) / b.width);
  bool triangles = b.type == RTC_GEOMETRY_TYPE_TRIANGLE;
  if (b.type != RTC_GEOMETRY_TYPE_DISC_POINT)
    embree.rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, triangles ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT,
                                      b.indices.data(), 0, triangles ? 12 : 4, b.n_elements);
  embree.rtcSetGeometryIntersectFilterFunction(g, filter(culled));
  embree.rtcSetGeometryMask(g, mask);
  embree.rtcCommitGeometry(g);
  unsigned id = attach_to_top(g);
  batch_of.resize(std::max<std::size_t>(batch_of.size(), id + 1));
  batch_of[id] = &b;
}

RayScene::RayScene(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of,
                   const RayOptions& options, Diagnostics& diag)
    : state_(new State{.stage = stage, .meshes = meshes, .mesh_of = mesh_of, .options = options}) {
  State& s = *state_;
  s.device = s.embree.rtcNewDevice(only_one_thread() ? "threads=1" : nullptr);
  if (!s.device) throw std::bad_alloc();
  std::size_t elements = 0;
  for (auto m : mesh_of) elements += meshes[m].n_elements;
  s.top = s.new_scene(elements);
  s.place_centre();
  s.place_uses(diag);
  s.attach(s.batches[State::solid], options.cull, opaque);
  for (auto kind : {State::two_sided, State::lines, State::points}) s.attach(s.batches[kind], false, opaque);
  s.attach(s.batches[State::clear_solid], options.cull, clear);
  s.attach(s.batches[State::clear_two_sided], false, clear);
  s.embree.rtcCommitScene(s.top);
  if (s.embree.rtcGetDeviceError(s.device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  s.measure();
  s.options.pen = nullptr;
  s.options.widths = {};
  s.options.clear = {};
}

RayScene::~RayScene() = default;

const V3& RayScene::centre() const { return state_->centre; }
double RayScene::radius() const { return state_->radius; }
bool RayScene::holds(std::uint32_t use) const { return state_->held[use]; }

bool RayScene::nearest(const Ray& ray, double after, Hit& hit) const {
  const State& s = *state_;
  Context context{{}, &s, -1, {}, {}, false};
  rtcInitIntersectContext(&context.base);
  RTCRayHit r{s.embree_ray(ray, after, infinity), {}};
  r.ray.mask = opaque | clear;
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  if (!acceptable(r.ray)) return false;
  s.embree.rtcIntersect1(s.top, &context.base, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.distance = r.ray.tfar;
  hit.back = context.found.back;
  hit.leaves = context.leaves && !hit.back ? s.resolve(context.left).first : Hit::none;
  bool flipped = false;
  hit.across = {r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z};
  if (r.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    hit.use = s.use_of[r.hit.instID[0]];
    hit.element = r.hit.primID;
    hit.across = s.stage.frames[s.stage.uses[hit.use].frame].normal(hit.across);
  } else {
    const Part& p = s.batch_of[r.hit.geomID]->part_of(r.hit.primID);
    hit.use = p.use;
    hit.element = r.hit.primID - p.first_element;
    flipped = p.flipped;
  }
  double u = flipped ? r.hit.v : r.hit.u, v = flipped ? r.hit.u : r.hit.v;
  auto kind = s.meshes[s.mesh_of[hit.use]].kind;
  if (kind == Mesh::Kind::points) u = v = 0;
  if (kind == Mesh::Kind::lines) v = 0;
  hit.weights[0] = 1 - u - v;
  hit.weights[1] = u;
  hit.weights[2] = v;
  return true;
}

bool RayScene::occluded(const Ray& ray, double after, double before) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay r = state_->embree_ray(ray, after, static_cast<float>(before));
  r.mask = opaque;
  if (!acceptable(r)) return false;
  state_->embree.rtcOccluded1(state_->top, &context, &r);
  return r.tfar < 0;
}

}  // namespace wrlkit::drawing
