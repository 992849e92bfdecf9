// meshoptimizer's meshopt_simplify behind the interface of the collapser. It knows no steps: every run begins with the
// mesh that came in.
#include <meshoptimizer.h>

#include <algorithm>

#include "geometry/simplify/simplifier.h"

namespace wrlkit::simplify {
namespace {

/// Vertices are wedges, so that meshoptimizer sees the seams.
class Meshopt final : public Simplifier {
 public:
  explicit Meshopt(const Mesh& mesh, bool lock_borders)
      : Simplifier(mesh), n_faces_(surface_.n_faces()), lock_borders_(lock_borders) {
    for (std::uint32_t f = 0; f < surface_.n_slots(); ++f)
      for (int k = 0; surface_.alive(f) && k < 3; ++k) {
        std::uint32_t v = surface_.face[f].v[k], w = wedges_.present() ? wedges_.of_face[f][k] : v;
        index_.push_back(w);
        if (w >= vertex_of_.size()) vertex_of_.resize(w + 1);
        vertex_of_[w] = v;
      }
    for (std::uint32_t v : vertex_of_)
      for (int i = 0; i < 3; ++i)
        points_.push_back(static_cast<float>(surface_.position(v)[i] - surface_.position(0)[i]));
  }

  void run_to(std::size_t n_faces, double max_error) override {
    if (n_faces >= n_faces_) return;
    const double scale = meshopt_simplifyScale(points_.data(), vertex_of_.size(), 3 * sizeof(float));
    const auto limit = static_cast<float>(std::min(max_error / scale, 1e9));
    float error = 0;
    std::vector<std::uint32_t> out(index_.size());
    out.resize(meshopt_simplify(out.data(), index_.data(), index_.size(), points_.data(), vertex_of_.size(),
                                3 * sizeof(float), 3 * n_faces, limit, lock_borders_ ? meshopt_SimplifyLockBorder : 0,
                                &error));
    n_faces_ = out.size() / 3;
    error_ = error * scale;
    for (std::uint32_t f = 0; f < surface_.n_slots(); ++f) {
      surface_.face[f].v[0] = none;
      for (int k = 0; f < n_faces_ && k < 3; ++k) {
        std::uint32_t w = out[3 * std::size_t{f} + k];
        surface_.face[f].v[k] = vertex_of_[w];
        if (wedges_.present()) wedges_.of_face[f][k] = w;
      }
    }
  }

  std::size_t n_faces() const override { return n_faces_; }

 private:
  std::size_t n_faces_;
  bool lock_borders_;  // it cannot hold single vertices
  std::vector<std::uint32_t> index_, vertex_of_;
  std::vector<float> points_;
};

}  // namespace

const OwnSimplifier meshopt{[](const Mesh& mesh, const CollapseOptions& options) -> std::unique_ptr<Simplifier> {
  return std::make_unique<Meshopt>(mesh, !options.fixed.empty());
}};

}  // namespace wrlkit::simplify
