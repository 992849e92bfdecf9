// How files of VRML and X3D are written.
#pragma once
#include <string>

#include "scenegraph/resources.h"
#include "writers/led_urls.h"

namespace wrlkit {

struct TextOptions {
  int precision = 0;        // significant digits of real numbers; 0: as many as it takes to read the same number back
  bool own_fields = false;  // those of the table that no standard has: for inspection, and for wrlkit itself
  std::string
      file;  // that is written: relative urls are led from its folder. Empty: they stay as they are for the input's
  PlaceMade place;  // names the files that passes have made; none: their urls stay
  CopyOfUrl copy;   // of files that come along; none: urls lead to where files are
};

}  // namespace wrlkit
