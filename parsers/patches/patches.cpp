#include "parsers/patches/patches.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/text/length_unit.h"
#include "base/text/utf8.h"
#include "parsers/vrml/number.h"
#include "parsers/x3d/xml.h"

namespace wrlkit {
namespace {

namespace word = patch_words;

bool is_utf16(std::string_view s) { return s.starts_with("\xff\xfe") || s.starts_with("\xfe\xff"); }

std::string_view without_bom(std::string_view s) { return s.starts_with("\xef\xbb\xbf") ? s.substr(3) : s; }

class PatchParser {
 public:
  PatchParser(std::string_view text, std::uint32_t base, Diagnostics& diag) : xml_(text, base, diag), diag_(diag) {
    set_.printed = {0, 0, 1};
  }

  std::optional<PatchSet> parse() {
    const XmlTag* tag = &xml_.next();
    while (tag->kind == XmlTag::Kind::close) tag = &xml_.next();
    if (tag->name != word::patches) {
      diag_.report(
          Diag::no_patches, tag->where,
          tag->name.empty() ? "there is no element in it" : "its first element is '" + std::string(tag->name) + "'");
      return std::nullopt;
    }
    for (; tag->kind != XmlTag::Kind::end; tag = &xml_.next()) {
      if (tag->kind == XmlTag::Kind::close)
        close(*tag);
      else
        open(*tag);
    }
    for (; depth_ > 0; --depth_)
      diag_.report(Diag::unclosed, levels_[depth_ - 1].where, name_of(levels_[depth_ - 1].element));
    return std::move(set_);
  }

 private:
  // Elements nest in this order and in no other; unknown ones are counted until they are closed again.
  enum Element : std::uint8_t { patches, shape, triangle, patch, other };
  struct Level {
    Element element;
    Span where;
  };

  static std::string_view name_of(Element e) {
    constexpr std::string_view names[] = {word::patches, word::shape, word::triangle, word::patch, ""};
    return names[e];
  }
  static Element element_of(std::string_view name) {
    for (auto e : {patch, triangle, shape, patches})
      if (name == name_of(e)) return e;
    return other;
  }
  Element innermost() const { return depth_ > 0 ? levels_[depth_ - 1].element : other; }

  void open(const XmlTag& tag) {
    const auto e = element_of(tag.name);
    const bool closed = tag.kind == XmlTag::Kind::empty || e == patch;  // a patch has no content
    if (skipping_ > 0) {
      skipping_ += tag.kind == XmlTag::Kind::open;
      return;
    }
    if (e == other || (e == patches && depth_ > 0)) {
      diag_.report(Diag::unknown_element, tag.where, tag.name);
      skipping_ += !closed;
      return;
    }
    // What has not been closed and cannot hold this one is over.
    while (depth_ > 0 && levels_[depth_ - 1].element >= e) leave();
    quiet_ = !tag.sound;
    begin(e, tag);
    quiet_ = false;
    if (!closed)
      levels_[depth_++] = {e, tag.where};
    else
      ended(e);
  }

  void leave() {
    diag_.report(Diag::unclosed_element, levels_[depth_ - 1].where, name_of(innermost()));
    ended(levels_[--depth_].element);
  }

  void close(const XmlTag& tag) {
    if (skipping_ > 0) {
      --skipping_;
      return;
    }
    const auto e = element_of(tag.name);
    if (e == patch) return;
    if (e == other || std::none_of(levels_, levels_ + depth_, [&](const Level& l) { return l.element == e; }))
      return diag_.report(Diag::xml_syntax, tag.where, "'" + std::string(tag.name) + "' is not open");
    while (innermost() != e) leave();
    ended(levels_[--depth_].element);
  }

  /// Patches that follow do not belong to the triangle or shape that was closed.
  void ended(Element e) {
    if (e <= triangle) in_triangle_ = false;
    if (e <= shape) in_shape_ = false;
  }

  void begin(Element e, const XmlTag& tag) {
    check_attributes(e, tag);
    if (e == patches) begin_patches(tag);
    if (e == shape) begin_shape(tag);
    if (e == triangle) begin_triangle(tag);
    if (e == patch) add_patch(tag);
  }

  void check_attributes(Element e, const XmlTag& tag) {
    using Words = std::initializer_list<std::string_view>;
    static const Words known[] = {{word::version, word::source, word::unit, word::method, word::samples},
                                  {word::name, word::index},
                                  {word::index, word::v},
                                  {word::v, word::rgb, word::side}};
    std::uint32_t met = 0;  // of these keywords
    for (auto& a : tag.attributes) {
      const auto word = std::ranges::find(known[e], a.name);
      const std::uint32_t bit = 1u << (word - known[e].begin());
      if (word == known[e].end())
        say(Diag::unknown_attribute, a.where, name_of(e), a.name);
      else if (met & bit)
        say(Diag::duplicate_field, a.where, a.name, "the first one is taken");
      met |= bit;
    }
  }

  /// A value that is read by people.
  std::string text(const XmlTag::Attribute& a) {
    if (is_utf8(a.value)) return std::string(a.value);
    say(Diag::encoding_repaired, a.where, "Latin-1");
    return latin1_to_utf8(a.value);
  }

  void begin_patches(const XmlTag& tag) {
    if (auto* a = tag.find(word::version); a && a->value != "1") say(Diag::patch_version, a->where, a->value);
    if (auto* a = tag.find(word::source)) set_.source = text(*a);
    if (auto* a = tag.find(word::method)) set_.method = text(*a);
    if (auto* a = tag.find(word::unit)) set_.printed.unit = metres_of(*a);
    if (auto n = count(tag, word::samples); n != PatchSet::unknown) set_.samples = n;
  }

  void begin_shape(const XmlTag& tag) {
    auto* name = tag.find(word::name);
    set_.add_shape(name ? text(*name) : std::string(), count(tag, word::index));
    in_shape_ = true;
    in_triangle_ = false;
  }

  void begin_triangle(const XmlTag& tag) {
    need_shape();
    Corners v;
    const auto index = count(tag, word::index);
    if (tag.find(word::v) && corners(tag, v))
      set_.add_triangle(index, v);
    else
      set_.add_loose_triangle();
    set_.triangles.back().index = index;
    in_triangle_ = true;
  }

  void add_patch(const XmlTag& tag) {
    Patch p;
    double rgb[3];
    if (!corners(tag, p.corners)) return;
    const auto* light = tag.find(word::rgb);
    const auto n = light ? numbers(*light, rgb) : 0;
    if (n == 0) return say(Diag::bad_patch, light ? light->where : tag.where, word::rgb);
    if (n != 3) say(Diag::short_value, light->where, word::rgb);
    for (std::size_t i = 0; i < 3; ++i) p.rgb[i] = radiance(i < n ? rgb[i] : 0, light->where);
    if (auto* side = tag.find(word::side)) {
      p.back = side->value == word::back;
      if (!p.back && side->value != word::front)
        say(Diag::unknown_word, side->where, side->value, word::patch, word::side);
    }
    need_shape();
    if (!in_triangle_) {
      set_.add_loose_triangle();
      in_triangle_ = true;
    }
    set_.patches.push_back(p);
  }

  /// What stands directly below the root is in a shape without name, all that follows each other in one.
  void need_shape() {
    if (!in_shape_) {
      set_.add_shape({}, PatchSet::unknown);
      in_shape_ = true;
      in_triangle_ = false;
    }
  }

  float radiance(double v, Span where) {
    constexpr double most = std::numeric_limits<float>::max();
    if (!(v >= 0 && v <= most)) say(Diag::out_of_range, where, word::patch, word::rgb, v, "[0, inf)");
    return static_cast<float>(std::clamp(v, 0.0, most));
  }

  bool corners(const XmlTag& tag, Corners& out) {
    double v[9];
    const auto* a = tag.find(word::v);
    if (!a || numbers(*a, v, true) < 9) {
      say(Diag::bad_patch, a ? a->where : tag.where, word::v);
      return false;
    }
    for (std::size_t i = 0; i < 9; ++i) out[i / 3][i % 3] = v[i] * set_.printed.unit;
    return true;
  }

  /// Notes the digits of a coordinate.
  void note_digits(std::string_view number) {
    auto& most = set_.printed;
    int decimals = 0, digits = 0, exponent = 0;
    bool behind_point = false;
    for (std::size_t i = 0; i < number.size(); ++i) {
      const char c = number[i];
      if (c == '.')
        behind_point = true;
      else if (c == 'e' || c == 'E') {
        auto from = number.data() + i + 1, end = number.data() + number.size();
        std::from_chars(from + (from < end && *from == '+'), end, exponent);
        break;
      } else if (c >= '0' && c <= '9') {
        decimals += behind_point;
        digits += digits > 0 || c != '0';
      }
    }
    most.decimals = std::max(most.decimals, std::min(decimals - exponent, 17));
    most.digits = std::max(most.digits, std::min(digits, 17));
  }

  /// Reads up to N numbers and returns how many there were; what comes behind them is reported.
  template <std::size_t N>
  std::size_t numbers(const XmlTag::Attribute& a, double (&out)[N], bool is_place = false) {
    const char *p = a.value.data(), *end = p + a.value.size();
    for (std::size_t n = 0;; ++n) {
      while (p < end && (static_cast<unsigned char>(*p) <= ' ' || *p == ',')) ++p;
      if (p == end) return n;
      const Span rest{a.where.begin + static_cast<std::uint32_t>(p - a.value.data()),
                      static_cast<std::uint32_t>(end - p)};
      if (n == N) {
        say(Diag::extra_values, rest, a.name, N);
        return n;
      }
      const char* from = p;
      const auto result = vrml::read_double(p, end, out[n]);
      if (result == vrml::NumberResult::none) {
        say(Diag::bad_value, rest, "'" + std::string(from, end) + "'", "number");
        return n;
      }
      if (result == vrml::NumberResult::repaired) say(Diag::number_repaired, rest, std::string(from, p), out[n]);
      if (is_place) note_digits({from, p});
    }
  }

  /// A number from 0; `unknown` when there is none.
  std::uint32_t count(const XmlTag& tag, std::string_view attribute) {
    const auto* a = tag.find(attribute);
    if (!a) return PatchSet::unknown;
    const char* p = a->value.data();
    std::int32_t v = -1;
    const auto result = vrml::read_int32(p, p + a->value.size(), v);
    if (result == vrml::NumberResult::exact && v >= 0 && p == a->value.data() + a->value.size())
      return static_cast<std::uint32_t>(v);
    say(Diag::bad_value, a->where, "'" + std::string(a->value) + "'", "number from 0");
    return PatchSet::unknown;
  }

  double metres_of(const XmlTag::Attribute& a) {
    if (const auto metres = metres_in(a.value)) return *metres;
    say(Diag::unknown_unit, a.where, a.value);
    return 1;
  }

  template <class... A>
  void say(Diag id, Span where, const A&... args) {
    if (!quiet_) diag_.report(id, where, args...);
  }

  XmlReader xml_;
  Diagnostics& diag_;
  PatchSet set_;
  Level levels_[3];
  std::size_t depth_ = 0, skipping_ = 0;
  bool in_shape_ = false, in_triangle_ = false;
  bool quiet_ = false;  // the tag has a fault that was reported
};

std::optional<PatchSet> parse_text(std::string_view text, std::uint32_t base, Diagnostics& diag) {
  std::string converted;
  if (is_utf16(text)) {
    diag.report(Diag::encoding_repaired, Span{base, 0}, "UTF-16");
    text = converted = utf16_to_utf8(text);
  }
  const auto body = without_bom(text);
  return PatchParser(body, base + static_cast<std::uint32_t>(text.size() - body.size()), diag).parse();
}

}  // namespace

bool is_patch_file(std::string_view text) {
  constexpr std::size_t enough = 1 << 16;  // for a declaration and comments
  if (is_utf16(text)) return first_element(utf16_to_utf8(text.substr(0, enough))) == patch_words::patches;
  return first_element(text) == patch_words::patches;
}

std::optional<PatchSet> parse_patches(const FileText& file, Diagnostics& diag) {
  return parse_text(file.view(), file.base, diag);
}

std::optional<PatchSet> read_patches(const std::string& path, const ReadLimits& limits, Diagnostics& diag) {
  const auto file = read_file(path, limits, diag);
  return file ? parse_patches(*file, diag) : std::nullopt;
}

std::optional<PatchSet> parse_patches(std::string_view text, std::string name, Diagnostics& diag) {
  auto kept = std::make_shared<std::string>(text);
  const auto base = diag.sources().add(std::move(name), text.size(), [kept] { return Sources::Loaded{*kept, kept}; });
  if (base == Span::nowhere) {
    diag.report(Diag::too_large, {}, "the text", "4 GiB", text.size());
    return std::nullopt;
  }
  return parse_text(*kept, base, diag);
}

}  // namespace wrlkit
