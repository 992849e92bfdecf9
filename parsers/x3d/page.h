// X3D inside of a page, as x3dom and x_ite have it: HTML, which is not XML and does not know small letters from
// capitals.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit::x3d {

struct PageWorld {
  std::string xml;    // as long as what it was made of, so that every place is still the same
  std::size_t begin;  // in the page
};

/// The first x3d element of a HTML page, as XML: elements and attributes spelled as the node table has them, those
/// without quotes or value, and handlers of events, blanked. None: the text is not a page, or has no such element.
/// O(text).
std::optional<PageWorld> world_of_page(std::string_view text);

}  // namespace wrlkit::x3d
