// What is left of a form when its sizes go into a scale: pipes of any radius and length are one cylinder.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/forms/form.h"

namespace wrlkit::instancing {

struct UnitForm {
  Form form;     // of unit size, in its own frame
  Vec3 scale{};  // along the axes of that frame
  /// What has to agree exactly: kind, caps, segments.
  std::uint64_t key = 0;
  /// What may differ by a tolerance: ratios that no scale changes. Times the largest scale it is a length.
  std::vector<double> ratios;
};

/// Walls across and along the axes are scaled along each of them; what leans or is curved along Y by one factor, for
/// some programs turn normals as they turn points. Nothing for round forms without segments of their own, which are cut
/// by their size.
std::optional<UnitForm> unit_form(const Form& form, bool solid);

}  // namespace wrlkit::instancing
