// A scene as X3D in its XML encoding.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "base/io/sink.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct X3dOptions {
  int precision = 0;        // significant digits of real numbers; 0: as many as it takes to read the same number back
  bool own_fields = false;  // those of the table that no standard has: for people who look, and for wrlkit itself
  std::string
      file;  // that is written: relative urls are led from its folder. Empty: they stay as they are for the input's
  PlaceMade place;  // names the files that passes have made; none: their urls stay
};

/// X3D 4.0 (ISO/IEC 19775-1 and 19776-1): the smallest of the profiles Interchange and Immersive that has the nodes,
/// with the components and levels that they need beyond it; fields in the order of the node table, those that say what
/// the default says left out. What was read reads back as the same scene, but for unknown fields whose names are no
/// names of XML (no-x3d-value). O(scene).
void write_x3d(const Scene&, const X3dOptions&, const Sink&, Diagnostics&);

}  // namespace wrlkit
