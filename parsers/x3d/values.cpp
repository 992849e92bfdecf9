#include "parsers/x3d/values.h"

#include <charconv>

#include "base/text/blanks.h"
#include "base/text/utf8.h"

namespace wrlkit::x3d {
// ---- text ----------------------------------------------------------------------------------------------------------

std::string_view AttributeValues::utf8_of(std::string_view raw) {
  if (latin1_ && !is_utf8(raw)) return scene_.keep(latin1_to_utf8(raw));
  return utf8(raw, span_of(raw));
}

std::string_view AttributeValues::plain(std::string_view raw, bool attribute) {
  auto s = utf8_of(raw);
  if (s.find_first_of(attribute ? "&\n\r\t" : "&\r") == s.npos) return s;
  std::string out;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] == '&')
      entity(s, i, out);
    else if (s[i] == '\r')
      out += i + 1 < s.size() && s[i + 1] == '\n' ? "" : attribute ? " " : "\n";
    else if (attribute && (s[i] == '\n' || s[i] == '\t'))
      out += ' ';
    else
      out += s[i];
  }
  return scene_.keep(out);
}

/// The entity at `at`, which is left on its ';'. One that is not XML's own stays as it is: nothing is expanded that a
/// file declares, so that nothing can explode.
void AttributeValues::entity(std::string_view s, std::size_t& at, std::string& out) {
  constexpr std::size_t longest = 12;
  const auto end = s.substr(at, longest).find(';');
  if (end == s.npos) {
    out += '&';
    return;
  }
  const auto name = s.substr(at + 1, end - 1);
  constexpr std::pair<std::string_view, char> known[] = {
      {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
  for (auto [n, c] : known)
    if (n == name) {
      out += c;
      at += end;
      return;
    }
  if (name.starts_with('#')) {
    const bool hex = name.starts_with("#x");
    const auto digits = name.substr(hex ? 2 : 1);
    std::uint32_t c = 0;
    auto r = std::from_chars(digits.data(), digits.data() + digits.size(), c, hex ? 16 : 10);
    if (r.ec == std::errc{} && r.ptr == digits.data() + digits.size() && c > 0 && c < 0x110000 &&
        (c < 0xd800 || c > 0xdfff)) {
      append_utf8(out, c);
      at += end;
      return;
    }
  }
  const bool in_text = s.data() >= text_.data() && s.data() < text_.data() + text_.size();
  diag_.report(Diag::xml_entity, in_text ? span_of(s.substr(at, end + 1)) : Span{text_base_, 0}, name);
  out += '&';
}

// ---- values --------------------------------------------------------------------------------------------------------

std::string_view AttributeValues::enter(std::string_view attribute, std::string_view says) {
  lex_ = vrml::Lexer(says);
  base_ = span_of(attribute).begin;
  return says;
}

bool AttributeValues::at_end(std::string_view type) {
  auto t = lex_.peek();
  if (t.kind == vrml::Kind::end) return true;
  diag_.report(Diag::bad_value, span(t), describe(t), type);
  return false;
}

bool AttributeValues::value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback,
                            std::string_view attribute, Value& out) {
  const auto& t = info(type);
  if (t.element == Element::node) {
    diag_.report(Diag::bad_value, span_of(attribute), "'" + std::string(attribute.substr(0, 60)) + "'", t.name);
    return false;
  }
  if (t.element == Element::text && !t.multiple) {
    out = scene_.make(type, slot, plain(attribute));
    return true;
  }
  if (t.element == Element::text) {
    strings(slot, attribute, out);
    return true;
  }
  const bool entities = attribute.find('&') != attribute.npos;
  enter(attribute, entities ? plain(attribute) : attribute);
  if (t.element == Element::image) {
    const bool read = image(type, slot, out);
    if (read) at_end(t.name);
    return read;
  }
  if (type == FieldType::SFBool || type == FieldType::MFBool) return booleans(type, slot, field, attribute, out);
  const bool of_text = attribute.data() >= text_.data() && attribute.data() < text_.data() + text_.size();
  const char* const end = text_.data() + text_.size();  // what follows an attribute may be looked at while it is read
  if (t.multiple && of_text && !entities && plain_list(attribute, end, type, slot, out)) return true;
  return numbers_of(type, slot, field, fallback, attribute, out);
}

bool AttributeValues::numbers_of(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback,
                                 std::string_view attribute, Value& out) {
  const auto& t = info(type);
  const bool real = t.element == Element::number;
  numbers_.clear();
  integers_.clear();
  bool bracket = take(vrml::Kind::open_bracket);  // of the other encoding
  // No comment, as in the other encoding: x3dom's pages write colours so.
  if (const auto at = attribute.find('#'); at != attribute.npos)
    diag_.report(Diag::bad_value, span_of(attribute.substr(at)), "'" + std::string(attribute.substr(at, 60)) + "'",
                 t.name);
  read_numbers(type, 0);
  if (bracket && take(vrml::Kind::close_bracket)) diag_.report(Diag::extra_bracket, span_of(attribute), field);
  at_end(t.name);
  const std::size_t count = real ? numbers_.size() : integers_.size();
  if (count == 0 && !t.multiple) {
    if (trim(attribute).empty()) diag_.report(Diag::bad_value, span_of(attribute), "''", t.name);
    return false;
  }
  if (!t.multiple && count < t.arity) fix_arity(t.arity, fallback, field, span_of(attribute));
  if (t.multiple ? count % t.arity : count > t.arity)
    diag_.report(Diag::missing_values, span_of(attribute), count, field, static_cast<int>(t.arity));
  if (real) numbers_.resize(t.multiple ? count - count % t.arity : t.arity);
  out = value_of_numbers(type, slot);
  return true;
}

// true and false; the keywords of the other encoding are read as well.
bool AttributeValues::booleans(FieldType type, std::uint16_t slot, std::string_view field, std::string_view attribute,
                               Value& out) {
  integers_.clear();
  for (auto t = lex_.next(); t.kind == vrml::Kind::word; t = lex_.next()) {
    auto w = text(t);
    const bool yes = w == "true" || w == "TRUE" || w == "True" || w == "1",
               no = w == "false" || w == "FALSE" || w == "False" || w == "0";
    if (!yes && !no) {
      diag_.report(Diag::bad_value, span(t), describe(t), "SFBool");
      continue;
    }
    if (w != "true" && w != "false") diag_.report(Diag::bool_repaired, span(t), w, yes ? "true" : "false");
    integers_.push_back(yes);
  }
  if (type == FieldType::MFBool) {
    out = scene_.make(type, slot, std::span<const std::int32_t>(integers_));
    return true;
  }
  if (integers_.empty()) return false;
  if (integers_.size() > 1) diag_.report(Diag::missing_values, span_of(attribute), integers_.size(), field, 1);
  out = scene_.make(type, slot, integers_[0] != 0);
  return true;
}

// "one" "two"; text without quotes is one string, as hand-written files have it.
void AttributeValues::strings(std::uint16_t slot, std::string_view attribute, Value& out) {
  const auto says = plain(attribute);
  std::vector<std::string_view> list;
  if (auto s = trim(says); !s.empty() && s[0] != '"') {
    diag_.report(Diag::string_repaired, span_of(attribute), s);
    list.push_back(s);
  } else {
    enter(attribute, says);
    std::string_view string;
    while (string_token(string)) list.push_back(string);
    at_end("MFString");
  }
  out = scene_.make(FieldType::MFString, slot, list);
}

}  // namespace wrlkit::x3d
