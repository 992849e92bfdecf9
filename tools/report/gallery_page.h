// A page of many scenes: their pictures and figures.
#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

struct GalleryWorld {
  std::string name, link;  // link: a reference to the file, relative to the page
  std::string picture;     // JPEG as base64; empty: none could be drawn
  std::string no_picture;  // why the picture could not be stored; empty: it could
  std::string fault;       // why it could not be read; empty: it could
  std::uint64_t triangles = 0, parts = 0, bytes = 0;
  std::size_t errors = 0, warnings = 0, lost = 0;
  std::set<std::string_view> messages = {};  // the names of these
};

struct Gallery {
  std::string title;
  int width = 0, height = 0;  // of the pictures, in pixels
  std::vector<GalleryWorld> worlds;
  std::size_t n_left_out = 0;  // by the limit
};

/// One HTML file that needs no other and asks for nothing of a network; what it links to are the scenes.
std::string gallery_page(const Gallery&);

}  // namespace wrlkit
