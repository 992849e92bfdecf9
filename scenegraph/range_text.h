#pragma once
#include <cstdio>
#include <string>

#include "scenegraph/node_table.h"

namespace wrlkit {

/// What numbers a field may have, as mathematics writes it: "[0,1]", "(0,inf)".
inline std::string range_text(const FieldRange& r) {
  char text[80];
  std::snprintf(text, sizeof text, "%c%g,%g%c", r.low_open ? '(' : '[', r.low, r.high, r.high_open ? ')' : ']');
  return text;
}

}  // namespace wrlkit
