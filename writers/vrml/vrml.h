// A scene as VRML97 text.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "base/io/sink.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct VrmlOptions {
  int precision = 0;        // significant digits of real numbers; 0: as many as it takes to read the same number back
  bool own_fields = false;  // those of the table that no standard has: for people who look, and for wrlkit itself
  std::string
      file;  // that is written: relative urls are led from its folder. Empty: they stay as they are for the input's
  PlaceMade place;  // names the files that passes have made; none: their urls stay
};

/// Canonical VRML97 (ISO/IEC 14772-1): fields in the order of the node table, values that equal their default left out,
/// prototypes first and ROUTEs last in their scope, numbers as short as they can be, UTF-8, LF. DEF names stay unless a
/// USE or ROUTE would mean another node then. What was read from VRML97 reads back as the same scene. O(scene).
void write_vrml(const Scene&, const VrmlOptions&, const Sink&, Diagnostics&);

}  // namespace wrlkit
