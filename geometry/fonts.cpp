#include "geometry/fonts.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "base/lazy_library.h"
#include "geometry/fallback_fonts.h"
#include "geometry/outline.h"

namespace wrlkit {
namespace {

constexpr double chord_tolerance = 0.004;  // em: what a printed letter of 10 points would show as 0.014 mm

constexpr double oblique = 0.2;  // x by y of an italic made of an upright font

constexpr const char* usual_folders[] = {
    "/usr/share/fonts/truetype/dejavu",
    "/usr/share/fonts/truetype/liberation",
    "/usr/share/fonts/truetype/liberation2",
    "/usr/share/fonts/dejavu",
    "/usr/share/fonts/dejavu-serif-fonts",
    "/usr/share/fonts/dejavu-sans-fonts",
    "/usr/share/fonts/dejavu-sans-mono-fonts",
    "/usr/share/fonts/TTF",
    "/usr/share/fonts/liberation",
    "/usr/local/share/fonts",
    "/opt/homebrew/share/fonts",
    "/Library/Fonts",
    "C:/Windows/Fonts",
    "/usr/share/fonts/truetype/noto",
    "/usr/share/fonts/opentype/noto",
    "/usr/share/fonts/truetype/wqy",
    "/usr/share/fonts/truetype/droid",
};

/// By family; plain, bold, italic, both; in the order of preference.
constexpr const char* files[3][4][2] = {
    {{"DejaVuSerif.ttf", "LiberationSerif-Regular.ttf"},
     {"DejaVuSerif-Bold.ttf", "LiberationSerif-Bold.ttf"},
     {"DejaVuSerif-Italic.ttf", "LiberationSerif-Italic.ttf"},
     {"DejaVuSerif-BoldItalic.ttf", "LiberationSerif-BoldItalic.ttf"}},
    {{"DejaVuSans.ttf", "LiberationSans-Regular.ttf"},
     {"DejaVuSans-Bold.ttf", "LiberationSans-Bold.ttf"},
     {"DejaVuSans-Oblique.ttf", "LiberationSans-Italic.ttf"},
     {"DejaVuSans-BoldOblique.ttf", "LiberationSans-BoldItalic.ttf"}},
    {{"DejaVuSansMono.ttf", "LiberationMono-Regular.ttf"},
     {"DejaVuSansMono-Bold.ttf", "LiberationMono-Bold.ttf"},
     {"DejaVuSansMono-Oblique.ttf", "LiberationMono-Italic.ttf"},
     {"DejaVuSansMono-BoldOblique.ttf", "LiberationMono-BoldItalic.ttf"}},
};

/// FreeType, which is opened for the first text. Without it there are no fonts.
struct FreeType {
#define FREETYPE(function) decltype(&::function) function = nullptr;
#include "geometry/freetype_functions.def"
#undef FREETYPE
  bool is_there = false;
};

FreeType open_freetype() {
  FreeType out;
  LazyLibrary library("libfreetype.so.6");
#define FREETYPE(function) library.find(out.function, #function);
#include "geometry/freetype_functions.def"
#undef FREETYPE
  out.is_there = library.fault().empty();
  return out;
}

const FreeType& freetype() {
  static const FreeType functions = open_freetype();
  return functions;
}

std::vector<std::string> installed_folders() {
  std::vector<std::string> out;
  const char* own = std::getenv("WRLKIT_FONTS");
  std::istringstream list(own ? own : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) out.push_back(folder);
  out.insert(out.end(), std::begin(usual_folders), std::end(usual_folders));
  return out;
}

/// Hands FreeType's outline over to ours, in em.
struct Pen {
  Outline outline{chord_tolerance};
  double scale, slant;

  static Pen& self(void* pen) { return *static_cast<Pen*>(pen); }
  Vec2 at(const FT_Vector* v) const {
    double x = static_cast<double>(v->x), y = static_cast<double>(v->y);
    return {(x + slant * y) * scale, y * scale};
  }

  static int move_to(const FT_Vector* p, void* pen) {
    self(pen).outline.move_to(self(pen).at(p));
    return 0;
  }
  static int line_to(const FT_Vector* p, void* pen) {
    self(pen).outline.line_to(self(pen).at(p));
    return 0;
  }
  static int conic_to(const FT_Vector* c, const FT_Vector* p, void* pen) {
    self(pen).outline.conic_to(self(pen).at(c), self(pen).at(p));
    return 0;
  }
  static int cubic_to(const FT_Vector* c, const FT_Vector* d, const FT_Vector* p, void* pen) {
    self(pen).outline.cubic_to(self(pen).at(c), self(pen).at(d), self(pen).at(p));
    return 0;
  }
};

/// Blank when the font is broken there.
Glyph make_glyph(FT_Face face, FT_UInt index, double slant) {
  Glyph glyph;
  if (freetype().FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP)) return glyph;
  Pen pen{.scale = 1.0 / face->units_per_EM, .slant = slant};
  glyph.advance = std::max(0.0, static_cast<double>(face->glyph->metrics.horiAdvance) * pen.scale);
  if (face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return glyph;
  const FT_Outline_Funcs functions{Pen::move_to, Pen::line_to, Pen::conic_to, Pen::cubic_to, 0, 0};
  if (freetype().FT_Outline_Decompose(&face->glyph->outline, &functions, &pen) == 0)
    pen.outline.cut(glyph.points, glyph.triangles);
  return glyph;
}

}  // namespace

// -- a font

Font::Font(std::string path, FT_FaceRec_* face, double slant, std::mutex& mutex)
    : path_(std::move(path)), face_(face), mutex_(mutex), slant_(slant) {
  double above = face->ascender, height = above - face->descender;
  ascent_ = above > 0 && height >= above ? above / height : 0.8;
}

Font::~Font() { freetype().FT_Done_Face(face_); }

const Glyph* Font::glyph(char32_t character) {
  std::lock_guard lock(mutex_);
  auto index = freetype().FT_Get_Char_Index(face_, character);
  return index ? &by_index(index) : nullptr;
}

const Glyph& Font::missing() {
  std::lock_guard lock(mutex_);
  return by_index(0);
}

std::vector<PlacedGlyph> Font::shape(std::u32string_view run, bool right_to_left) {
  std::lock_guard lock(mutex_);
  std::vector<PlacedGlyph> out;
  for (const auto& [index, advance, dx, dy] : shaping().shape(run, right_to_left))
    out.push_back({&by_index(index), advance, dx, dy});
  return out;
}

std::vector<std::size_t> Font::clusters(std::u32string_view run, bool right_to_left) {
  std::lock_guard lock(mutex_);
  return shaping().clusters(run, right_to_left);
}

const ShapingFont& Font::shaping() {
  if (!shaping_) shaping_ = std::make_unique<ShapingFont>(path_);
  return *shaping_;
}

const Glyph& Font::by_index(std::uint32_t index) {
  auto i = glyphs_.find(index);
  if (i == glyphs_.end()) i = glyphs_.emplace(index, make_glyph(face_, index, slant_)).first;
  return i->second;
}

// -- all of them

Fonts::Fonts(std::vector<std::string> folders) : folders_(std::move(folders)) {
  if (!freetype().is_there || freetype().FT_Init_FreeType(&library_)) library_ = nullptr;
}

Fonts::~Fonts() {
  fonts_.clear();
  if (library_) freetype().FT_Done_FreeType(library_);
}

Fonts& Fonts::installed() {
  static Fonts fonts(installed_folders());
  return fonts;
}

Font* Fonts::find(FontFamily family, bool bold, bool italic) {
  if (!library_) return nullptr;
  std::lock_guard lock(mutex_);
  for (auto f : {family, FontFamily::sans, FontFamily::serif, FontFamily::typewriter}) {
    if (auto* font = find_file(f, bold, italic, 0)) return font;
    if (auto* font = italic ? find_file(f, bold, false, oblique) : nullptr) return font;
    if (auto* font = find_file(f, false, false, 0)) return font;
    if (auto* font = find_file(f, true, false, 0)) return font;
  }
  return nullptr;
}

Font* Fonts::find_for(char32_t character) {
  const auto* known = fallback_fonts(character);
  if (!known || !library_) return nullptr;
  for (const char* file : known->files)
    for (const auto& folder : folders_) {
      if (!file) return nullptr;
      Font* font = nullptr;
      {
        std::lock_guard lock(mutex_);
        font = load(folder + "/" + file, 0);
      }
      if (font && font->glyph(character)) return font;
    }
  return nullptr;
}

Font* Fonts::find_file(FontFamily family, bool bold, bool italic, double slant) {
  for (auto* file : files[static_cast<std::size_t>(family)][(bold ? 1 : 0) + (italic ? 2 : 0)])
    for (auto& folder : folders_)
      if (auto* font = load(folder + "/" + file, slant)) return font;
  return nullptr;
}

Font* Fonts::load(const std::string& path, double slant) {
  auto [i, is_new] = fonts_.try_emplace({path, slant});
  FT_Face face;
  if (!is_new || freetype().FT_New_Face(library_, path.c_str(), 0, &face)) return i->second.get();
  if (FT_IS_SCALABLE(face) && face->units_per_EM > 0)
    i->second.reset(new Font(path, face, slant, mutex_));
  else
    freetype().FT_Done_Face(face);
  return i->second.get();
}

}  // namespace wrlkit
