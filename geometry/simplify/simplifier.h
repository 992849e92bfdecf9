// What stands behind a Collapser: the engine, or another library as a baseline.
#pragma once
#include "geometry/simplify/collapse.h"
#include "geometry/simplify/recorder.h"
#include "geometry/simplify/surface.h"
#include "geometry/simplify/wedges.h"

namespace wrlkit::simplify {

class Simplifier {
 public:
  explicit Simplifier(const Mesh& mesh) : surface_(mesh), wedges_(mesh, surface_) {}
  virtual ~Simplifier() = default;

  virtual void run_to(std::size_t n_faces, double max_error) = 0;
  virtual std::size_t n_faces() const = 0;
  virtual std::optional<EdgeCollapse> next() { return {}; }
  virtual std::optional<double> cost(std::uint32_t /*from*/, std::uint32_t /*to*/) { return {}; }

  double error() const { return error_; }
  const CollapseRecord& record() const { return recorder_.record(); }
  /// Appends the faces that are left, with what they use.
  void write(Mesh& mesh) const;

 protected:
  Surface surface_;
  Wedges wedges_;
  Recorder recorder_;
  double error_ = 0;
};

std::unique_ptr<Simplifier> make_simplifier(const Mesh& mesh, const CollapseOptions& options);

/// A criterion that simplifies by itself.
struct OwnSimplifier {
  std::unique_ptr<Simplifier> (*make)(const Mesh& mesh, const CollapseOptions& options);
  std::string_view missing = {};  // as in CriterionInfo
};
#define PRICER(name)
#define SIMPLIFIER(name) extern const OwnSimplifier name;
#include "geometry/simplify/criteria.def"

}  // namespace wrlkit::simplify
