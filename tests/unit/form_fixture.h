// A form that stands somewhere, turned.
#pragma once
#include <utility>

#include "geometry/forms/form.h"

namespace wrlkit {

inline Form form_of(Form::Shape shape, int segments = 0, int rings = 0) {
  Form form;
  form.shape = std::move(shape);
  form.frame = translation_matrix({3, -2, 7}) * rotation_matrix({1, 2, 3, 0.7});
  form.segments = segments;
  form.rings = rings;
  return form;
}

}  // namespace wrlkit
