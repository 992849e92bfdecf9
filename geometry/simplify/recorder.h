// Writes the CollapseRecord while the engine works: what a step changes is recorded before it is changed.
#pragma once
#include "geometry/simplify/collapse.h"
#include "geometry/simplify/surface.h"
#include "geometry/simplify/wedges.h"

namespace wrlkit::simplify {

class Recorder {
 public:
  void begin(const Surface& surface, const Wedges& wedges);
  void remove_face(std::uint32_t face) { record_.removed_faces.push_back(face); }
  void change_corner(std::uint32_t corner, std::uint32_t before, std::uint32_t after) {
    record_.corners.push_back({corner, before, after});
  }
  /// The wedge has these values now.
  void change_wedge(std::uint32_t wedge, const float* values);
  void end_step(const EdgeCollapse& collapse, const Vec3& old_from, const Vec3& old_to, double error);

  const CollapseRecord& record() const { return record_; }

 private:
  CollapseRecord record_;
  std::vector<std::uint32_t> row_;  // of each wedge, in the values of the record
};

}  // namespace wrlkit::simplify
