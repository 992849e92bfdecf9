// What compare-lod has found out, and the page that shows it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "geometry/simplify/world.h"

namespace wrlkit {

struct ComparedCriterion {
  std::string name;
  std::vector<InteractionPoint> points;  // the model itself too, where its number is asked for
  std::vector<Image> pictures;           // one a point
};

struct Comparison {
  std::string model;
  std::size_t n_faces = 0;
  Image picture;  // of the model
  std::vector<std::size_t>
      counts;  // numbers of triangles that were asked for, falling; a criterion may not get to the last
  std::vector<ComparedCriterion> criteria;
};

/// One HTML file that needs no other and no script: charts, pictures, figures; light and dark, narrow and wide. Null,
/// and why, when a picture cannot be encoded.
std::optional<std::string> comparison_page(const Comparison&, std::string& why);

/// All pictures of the criteria in one, four in a row; each criterion begins a row.
Image comparison_sheet(const Comparison&);

}  // namespace wrlkit
