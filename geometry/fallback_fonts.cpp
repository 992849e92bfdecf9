#include "geometry/fallback_fonts.h"

#include <algorithm>
#include <iterator>

namespace wrlkit {
namespace {

using Files = std::array<const char*, 4>;

constexpr Files cjk{"NotoSansCJK-Regular.ttc", "wqy-microhei.ttc", "wqy-zenhei.ttc", "DroidSansFallbackFull.ttf"};
constexpr const char *noto_cjk = "fonts-noto-cjk", *noto = "fonts-noto-core";

/// Blocks of the Unicode Standard.
constexpr FallbackFonts table[] = {
    {0x0590, 0x05ff, {"NotoSansHebrew-Regular.ttf"}, noto},
    {0x0600, 0x06ff, {"NotoSansArabic-Regular.ttf", "NotoNaskhArabic-Regular.ttf"}, noto},
    {0x0700, 0x074f, {"NotoSansSyriac-Regular.ttf"}, noto},
    {0x0750, 0x077f, {"NotoSansArabic-Regular.ttf", "NotoNaskhArabic-Regular.ttf"}, noto},
    {0x0780, 0x07bf, {"NotoSansThaana-Regular.ttf"}, noto},
    {0x08a0, 0x08ff, {"NotoSansArabic-Regular.ttf", "NotoNaskhArabic-Regular.ttf"}, noto},
    {0x0900, 0x097f, {"NotoSansDevanagari-Regular.ttf"}, noto},
    {0x0980, 0x09ff, {"NotoSansBengali-Regular.ttf"}, noto},
    {0x0a00, 0x0a7f, {"NotoSansGurmukhi-Regular.ttf"}, noto},
    {0x0a80, 0x0aff, {"NotoSansGujarati-Regular.ttf"}, noto},
    {0x0b80, 0x0bff, {"NotoSansTamil-Regular.ttf"}, noto},
    {0x0c00, 0x0c7f, {"NotoSansTelugu-Regular.ttf"}, noto},
    {0x0c80, 0x0cff, {"NotoSansKannada-Regular.ttf"}, noto},
    {0x0d00, 0x0d7f, {"NotoSansMalayalam-Regular.ttf"}, noto},
    {0x0e00, 0x0e7f, {"NotoSansThai-Regular.ttf"}, noto},
    {0x1100, 0x11ff, cjk, noto_cjk},
    {0x2e80, 0x9fff, cjk, noto_cjk},  // radicals, kana, bopomofo, ideographs
    {0xa960, 0xa97f, cjk, noto_cjk},
    {0xac00, 0xd7ff, cjk, noto_cjk},  // hangul
    {0xf900, 0xfaff, cjk, noto_cjk},
    {0xfb1d, 0xfb4f, {"NotoSansHebrew-Regular.ttf"}, noto},
    {0xfb50, 0xfdff, {"NotoSansArabic-Regular.ttf", "NotoNaskhArabic-Regular.ttf"}, noto},
    {0xfe30, 0xfe4f, cjk, noto_cjk},
    {0xfe70, 0xfefc, {"NotoSansArabic-Regular.ttf", "NotoNaskhArabic-Regular.ttf"}, noto},
    {0xff00, 0xffef, cjk, noto_cjk},  // full and half width
    {0x20000, 0x323af, cjk, noto_cjk},
};

}  // namespace

const FallbackFonts* fallback_fonts(char32_t c) {
  const auto* row = std::ranges::find_if(table, [c](const FallbackFonts& f) { return c >= f.first && c <= f.last; });
  return row == std::end(table) ? nullptr : row;
}

}  // namespace wrlkit
