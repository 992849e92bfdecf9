// Rays and baking, in CPU seconds.
//   light_bench rays IN.wrl [N]
//     rays a second: nearest and occluded, of the library and of Embree alone, over the same triangles and the same
//     rays, in one run
//   light_bench bake IN.wrl TEXELS RAYS,... [SPP]
//     irradiance at about TEXELS points spread over all faces: CPU seconds and error against path tracing with SPP rays
//     a point (default 8192)
#include <embree3/rtcore.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "base/math/random.h"
#include "base/parallel.h"
#include "bench/loaded_world.h"
#include "bench/process_cost.h"
#include "light/flux.h"
#include "light/integrator.h"

namespace {

using namespace wrlkit;
using namespace wrlkit::light;

struct Loaded : LoadedWorld {
  std::unique_ptr<LightWorld> world;

  explicit Loaded(const char* path, const LightOptions& options = {}) : LoadedWorld(path, "picture") {
    double t = cpu_seconds();
    world = std::make_unique<LightWorld>(file->scene, meshes, nullptr, options, diag);
    std::printf("%s: %zu uses, world %.3f CPU s, peak %.0f MB\n", path, world->stage().uses.size(), cpu_seconds() - t,
                peak_megabytes());
  }
};

/// Every triangle that is met: use, element and its corners in the world.
template <class F>
void each_triangle(const LightWorld& w, F&& f) {
  for (std::uint32_t u = 0; u < w.mesh_of().size(); ++u) {
    const auto& m = w.meshes()[w.mesh_of()[u]];
    if (m.kind != Mesh::Kind::faces) continue;
    const auto& frame = w.stage().frames[w.stage().uses[u].frame];
    for (std::uint32_t e = 0; e < m.n_elements; ++e) {
      V3 p[3];
      for (int k = 0; k < 3; ++k) p[k] = frame.point(w.meshes().position(m, e, k) + m.origin);
      f(u, m, p);
    }
  }
}

/// Points on all faces, on a grid in each triangle, as the texels of a lightmap of about that many; of triangles that
/// are smaller than a texel some have one.
std::vector<Point> points_over(const LightWorld& w, double n) {
  double area = 0;
  each_triangle(
      w, [&](std::uint32_t, const auto&, const V3* p) { area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0])); });
  double step = std::sqrt(area / n);
  auto point = [](const V3& at, const V3& face, std::uint32_t use, const V3* p) {
    return Point{at, face, face, use, std::max(length(p[1] - p[0]), length(p[2] - p[0]))};
  };
  double due = 0;
  std::vector<Point> out;
  each_triangle(w, [&](std::uint32_t use, const auto&, const V3* p) {
    V3 a = p[1] - p[0], b = p[2] - p[0], c = cross(a, b), face = unit(c), right = unit(a), up = cross(face, right);
    double width = length(a), height = length(c) / width, shift = dot(b, right);
    if (std::min(width, height) < step) {
      due += 0.5 * width * height / (step * step);
      if (due >= 1) out.push_back(point((1. / 3) * (p[0] + p[1] + p[2]), face, use, p)), due -= 1;
      return;
    }
    for (double y = 0.5 * step; y < height; y += step)
      for (double x = shift * y / height + 0.5 * step; x < shift * y / height + width * (1 - y / height); x += step)
        out.push_back(point(p[0] + x * right + y * up, face, use, p));
  });
  return out;
}

// ---- rays ----------------------------------------------------------------------------------------------------------

/// Embree and nothing else: all triangles in one geometry.
struct Bare {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  explicit Bare(const LightWorld& w) {
    std::vector<float> v;
    each_triangle(w, [&](std::uint32_t, const auto&, const V3* p) {
      for (int k = 0; k < 3; ++k) {
        V3 q = p[k] - w.centre();
        v.insert(v.end(), {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
      }
    });
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::memcpy(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, v.size() / 3), v.data(),
                v.size() * 4);
    auto* index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, v.size() / 9));
    for (std::uint32_t i = 0; i < v.size() / 3; ++i) index[i] = i;
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcCommitScene(scene);
  }
  ~Bare() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

RTCRay bare_ray(const V3& o, const V3& d) {
  RTCRay r{};
  r.org_x = static_cast<float>(o.x);
  r.org_y = static_cast<float>(o.y);
  r.org_z = static_cast<float>(o.z);
  r.dir_x = static_cast<float>(d.x);
  r.dir_y = static_cast<float>(d.y);
  r.dir_z = static_cast<float>(d.z);
  r.tfar = INFINITY;
  r.mask = ~0u;
  return r;
}

template <class F>
double measure(const char* what, std::size_t n, F&& f) {
  std::size_t hits = 0;
  double t = cpu_seconds();
  for (std::size_t i = 0; i < n; ++i) hits += f(i);
  t = cpu_seconds() - t;
  double rate = static_cast<double>(n) / t * 1e-6;
  std::printf("  %-22s %6.2f million rays a CPU s, %.1f %% hit\n", what, rate,
              100. * static_cast<double>(hits) / static_cast<double>(n));
  return rate;
}

void bench_rays(const char* path, std::size_t n) {
  ThreadLimit one(1);
  Loaded l(path);
  const LightWorld& w = *l.world;
  Bare bare(w);
  auto points = points_over(w, 1e5);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < n; ++i) {
    const Point& p = points[i * points.size() / n];
    auto [u, v] = Lattice<2>(i / 16)[static_cast<std::uint32_t>(i)];
    rays.push_back({w.off_surface(p.position, p.face, p.extent), cosine_direction(p.normal, u, v)});
  }
  RTCIntersectContext c;
  rtcInitIntersectContext(&c);
  double a = measure("Embree, nearest", n, [&](std::size_t i) {
    RTCRayHit r{bare_ray(rays[i].origin - w.centre(), rays[i].direction), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(bare.scene, &c, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  });
  double b = measure("library, nearest", n, [&](std::size_t i) {
    Hit h;
    return w.nearest(rays[i], 0, h);
  });
  double s = measure("library, with surface", n, [&](std::size_t i) {
    Hit h;
    return w.nearest(rays[i], 0, h) && w.surface(h).alpha > 0;
  });
  double d = measure("Embree, occluded", n, [&](std::size_t i) {
    RTCRay r = bare_ray(rays[i].origin - w.centre(), rays[i].direction);
    rtcOccluded1(bare.scene, &c, &r);
    return r.tfar < 0;
  });
  double e = measure("library, occluded", n, [&](std::size_t i) { return w.transmittance(rays[i], INFINITY) == 0; });
  std::printf("  library / Embree: nearest %.2f, with surface %.2f, occluded %.2f\n", b / a, s / a, e / d);
}

// ---- bake ----------------------------------------------------------------------------------------------------------

double relative_rmse(const std::vector<Irradiance>& a, const std::vector<Irradiance>& b) {
  double square = 0, mean = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      double x = a[i].direct[c] + a[i].gathered[c], y = b[i].direct[c] + b[i].gathered[c];
      square += (x - y) * (x - y);
      mean += y;
    }
  double n = 3. * static_cast<double>(a.size());
  return std::sqrt(square / n) / (mean / n);
}

void bench_bake(const char* path, double texels, const char* rays, int spp) {
  Loaded l(path);
  auto points = points_over(*l.world, texels);
  std::printf("  %zu points\n", points.size());
  double t = cpu_seconds();
  auto reference =
      Integrator(*l.world, points, {.mode = IntegratorOptions::Mode::path, .rays = spp, .seed = 99}).irradiance(points);
  std::printf("  path, %d rays: %.2f CPU s\n", spp, cpu_seconds() - t);
  std::istringstream in(rays);
  for (std::string r; std::getline(in, r, ',');)
    for (auto mode : {IntegratorOptions::Mode::cached, IntegratorOptions::Mode::path}) {
      t = cpu_seconds();
      Integrator integrator(*l.world, points, {.mode = mode, .rays = std::atoi(r.c_str())});
      double prepared = cpu_seconds() - t;
      auto e = integrator.irradiance(points);
      std::printf("  %s, %5s rays: %7.3f CPU s (%.3f cache), %.2f %% rRMSE\n",
                  mode == IntegratorOptions::Mode::path ? "path  " : "cached", r.c_str(), cpu_seconds() - t, prepared,
                  100 * relative_rmse(e, reference));
    }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc >= 3 && !std::strcmp(argv[1], "rays"))
    bench_rays(argv[2], argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1'000'000);
  else if (argc >= 5 && !std::strcmp(argv[1], "bake"))
    bench_bake(argv[2], std::atof(argv[3]), argv[4], argc > 5 ? std::atoi(argv[5]) : 8192);
  else {
    std::fprintf(stderr, "light_bench rays|bake ...: see the head of light_bench.cpp\n");
    return 2;
  }
}
