// Text of scripts whose letters join or run from right to left: Arabic, Hebrew, Devanagari and others. Letters are put
// into shape by HarfBuzz, and into the order of the line by FriBidi (Unicode Standard Annex #9). Both are opened for
// the first such text; a build without them, or a system, shows each letter by itself, as text_mesh does for all
// others.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// Is it a letter of a script that needs more than one glyph after the other, from left to right?
bool needs_shaping(char32_t);

/// Are both libraries there?
bool can_shape();
/// What is not, in words, and the Debian packages that have it; both empty when all is.
struct MissingLibraries {
  std::string names, packages;
};
MissingLibraries missing_for_shaping();

/// Letters of one script and one direction.
struct TextRun {
  std::size_t begin, end;  // into the line, in the order in which it is read
  bool right_to_left;
};

/// The runs of a line as they follow one another from left to right. A new one also begins where `kinds` changes, one
/// of each letter, and after at most 1024 letters. `right_to_left`: of the whole line; none: that of its first letter
/// that has a direction.
std::vector<TextRun> visual_runs(std::u32string_view line, const std::vector<std::uint32_t>& kinds,
                                 std::optional<bool> right_to_left);

/// ISO 15924, as a number of HarfBuzz; letters of no script have that of the one before.
std::vector<std::uint32_t> scripts_of(std::u32string_view line);

struct ShapedGlyph {
  std::uint32_t index;
  double advance, dx, dy;  // em
};

class ShapingFont {
 public:
  /// The first font of a file.
  explicit ShapingFont(const std::string& path);
  ~ShapingFont();
  ShapingFont(const ShapingFont&) = delete;
  ShapingFont& operator=(const ShapingFont&) = delete;

  /// Where the clusters of a run begin: letters with their marks, syllables of Indian scripts.
  std::vector<std::size_t> clusters(std::u32string_view run, bool right_to_left) const;
  /// Glyphs of one run, from left to right. At worst quadratic in its length.
  std::vector<ShapedGlyph> shape(std::u32string_view run, bool right_to_left) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace wrlkit
