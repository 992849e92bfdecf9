// Glyphs as triangles, for Text. The three families of VRML are mapped to fonts that are installed, in a fixed order of
// preference; outlines are taken without hinting, so that a glyph has one shape for every size.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "geometry/polygon.h"
#include "geometry/shaping.h"

struct FT_FaceRec_;
struct FT_LibraryRec_;

namespace wrlkit {

/// In em: 1 is the size of the font. The origin is on the baseline.
struct Glyph {
  double advance = 0;
  std::vector<Vec2> points;
  std::vector<std::uint32_t> triangles;  // three indices each, anticlockwise; empty: a blank
};

/// A glyph where it stands in a line, in em: how far it moves the pen, and where it is from there.
struct PlacedGlyph {
  const Glyph* glyph;
  double advance, dx = 0, dy = 0;
};

/// One font file. Glyphs are made when they are first asked for, and stay where they are.
class Font {
 public:
  ~Font();

  /// Null when the font has no such character.
  const Glyph* glyph(char32_t character);
  /// The glyphs of a run of letters, from left to right (geometry/shaping.h).
  std::vector<PlacedGlyph> shape(std::u32string_view run, bool right_to_left);
  /// Where its clusters begin: letters with their marks, syllables.
  std::vector<std::size_t> clusters(std::u32string_view run, bool right_to_left);
  /// What stands for characters that no font has.
  const Glyph& missing();
  /// Part of the height of a line that is above the baseline; the rest is below it.
  double ascent() const { return ascent_; }

 private:
  friend class Fonts;
  Font(std::string path, FT_FaceRec_* face, double slant, std::mutex& mutex);
  const ShapingFont& shaping();
  const Glyph& by_index(std::uint32_t index);

  std::string path_;
  FT_FaceRec_* face_;
  std::mutex& mutex_;
  std::unique_ptr<ShapingFont> shaping_;  // null: nothing has been shaped
  double slant_, ascent_;
  std::unordered_map<std::uint32_t, Glyph> glyphs_;
};

enum class FontFamily : std::uint8_t { serif, sans, typewriter };

/// The fonts in some folders. May be used by several threads at once.
class Fonts {
 public:
  /// Folders are searched in that order, not what is below them.
  explicit Fonts(std::vector<std::string> folders);
  ~Fonts();
  /// Those of the folders that the environment variable WRLKIT_FONTS names, separated by ':', then those of the usual
  /// ones. Made when first asked for.
  static Fonts& installed();

  /// The font that comes closest; null when there is none at all. An italic that is not installed is the upright font,
  /// slanted.
  Font* find(FontFamily family, bool bold, bool italic);
  /// A font for a letter that those do not have, by its script (geometry/fallback_fonts.h); null when none is
  /// installed.
  Font* find_for(char32_t character);

 private:
  Font* find_file(FontFamily family, bool bold, bool italic, double slant);
  Font* load(const std::string& path, double slant);

  std::vector<std::string> folders_;
  std::mutex mutex_;  // of everything: FreeType's faces share their library
  FT_LibraryRec_* library_ = nullptr;
  std::map<std::pair<std::string, double>, std::unique_ptr<Font>> fonts_;  // by path and slant; null: cannot be used
};

}  // namespace wrlkit
