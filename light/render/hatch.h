// Hatches of FillProperties (ISO/IEC 19775-1, 12.4.2): lines of one colour over a surface, in the plane of the picture.
#pragma once
#include <optional>

#include "light/render/linear.h"
#include "scenegraph/scene.h"

namespace wrlkit::drawing {

struct Hatch {
  bool is_filled = true;  // what is between the lines is seen
  V3 color{1};
  int style = 0;  // 0: no lines

  /// Whether a line covers a place in the picture, in sixtieths of its height. Styles 1 to 6 of the register of
  /// ISO/IEC 9973: horizontal, vertical, rising, falling, squares, diamonds; all others rise.
  bool covers(double x, double y) const;
};

/// Of a node FillProperties; nothing where it changes nothing.
std::optional<Hatch> read_hatch(const Scene&, NodeId fill_properties);

}  // namespace wrlkit::drawing
